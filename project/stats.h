#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "project/effect.h"

namespace tetraglass::project {

/// What an effect took where it can be told apart from the drawing itself.
struct Work {
  std::size_t bytes = 0;
  double ms = 0;
};

/// What drawing one picture took. Times in milliseconds.
struct Stats {
  double tables_ms = 0;
  double sort_ms = 0;
  double project_ms = 0;
  std::uint64_t fragments = 0;  ///< ray segments that were integrated
  std::string sort_method = "none";
  bool sort_exact = true;  ///< true also where the mode needs no order
  std::uint64_t cycles = 0;
  std::size_t parts = 1;         ///< in which the mesh was drawn one after the other (gl)
  std::string context = "none";  ///< "osmesa: <renderer string>" or "none"
  int threads = 1;
  /// Of the effects that something was stored or computed for; those of slices, grids and the
  /// reference are not counted.
  std::map<Effect, Work> work;

  void add(Effect effect, std::size_t bytes, double ms = 0) {
    Work& sum = work[effect];
    sum.bytes += bytes;
    sum.ms += ms;
  }
};

}  // namespace tetraglass::project
