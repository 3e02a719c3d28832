#pragma once

#include <string>

#include "preint/transfer_function.h"

namespace tetraglass::apps {

/// A preset over [low, high] by its name, or a file: ours (.json), or a color map that ParaView
/// exported (.json, .xml), which is spread over [low, high] too. `diagonal` scales the opacity.
/// Throws as preint::preset and the readers do.
[[nodiscard]] preint::TransferFunction read_named_transfer_function(const std::string& name,
                                                                    double low, double high,
                                                                    double diagonal);

/// Whether `name` stands for values of its own, which a range does not move: a file in our format.
[[nodiscard]] bool has_own_values(const std::string& name);

/// Whether `name` is that of a preset rather than of a file.
[[nodiscard]] bool is_preset_name(const std::string& name);

/// The help text of --tf.
[[nodiscard]] std::string transfer_function_help();

}  // namespace tetraglass::apps
