#pragma once

#include <string>

#include "project/accuracy_study.h"
#include "project/image_file.h"

namespace tetraglass::apps {

/// One self-contained page: error against time as SVG with the Pareto front, a table, and every
/// picture with its difference from the reference as data URIs. Nothing is loaded from elsewhere.
/// `title` and `description`: text, not HTML.
[[nodiscard]] std::string accuracy_html(const project::Study& study, const std::string& title,
                                        const std::string& description,
                                        const project::Background& background);

/// The same numbers, a line per case under a line of names.
[[nodiscard]] std::string accuracy_csv(const project::Study& study);

}  // namespace tetraglass::apps
