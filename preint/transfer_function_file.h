#pragma once

#include <string>

#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// Writes what `read_transfer_function` reads back as the same function. Throws WriteError.
void write_transfer_function(const TransferFunction& tf, const std::string& file);

}  // namespace tetraglass::preint
