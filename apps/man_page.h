#pragma once

#include <string>
#include <vector>

#include "apps/described_commands.h"

namespace tetraglass::apps {

/// The page tetraglass(1), in the macros of man(7).
[[nodiscard]] std::string man_page(const std::vector<DescribedCommand>& commands,
                                   const std::string& version);

}  // namespace tetraglass::apps
