#pragma once

#include <string>
#include <vector>

#include "apps/described_commands.h"

namespace tetraglass::apps {

/// A script by which a shell completes subcommands, options, the words that options offer, and
/// files. Throws UsageError for a shell other than bash, zsh and fish.
[[nodiscard]] std::string shell_completion(const std::vector<DescribedCommand>& commands,
                                           const std::string& shell);

}  // namespace tetraglass::apps
