#pragma once

#include <string>

#include "project/light/lights.h"

namespace tetraglass::project {

/// Writes what `read_lights` reads, to the last bit. Throws WriteError.
void write_lights(const Lights& lights, const std::string& file);

}  // namespace tetraglass::project
