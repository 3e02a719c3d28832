#pragma once

#include <cstdint>
#include <string>

namespace tetraglass::project {

/// What drawing one picture took. Times in milliseconds.
struct Stats {
  double tables_ms = 0;
  double sort_ms = 0;
  double project_ms = 0;
  std::uint64_t fragments = 0;  ///< ray segments that were integrated
  std::string sort_method = "none";
  bool sort_exact = true;  ///< true also where the mode needs no order
  std::uint64_t cycles = 0;
  std::string context = "none";  ///< "osmesa: <renderer string>" or "none"
  int threads = 1;
};

}  // namespace tetraglass::project
