#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "project/cpu/drawn_cells.h"

namespace tetraglass::project::cpu {

/// An interval of values on which the transfer function is linear: extinction and color at its low
/// end, and what is added up to its high end.
struct MediumInterval {
  float low = 0;  ///< scaled values
  float high = 0;
  float inverse_width = 0;
  float extinction = 0;  ///< per half diagonal of the mesh
  float extinction_rise = 0;
  std::array<float, 3> color = {};
  std::array<float, 3> color_rise = {};

  /// Neither takes nor gives light.
  [[nodiscard]] bool clear() const { return extinction == 0 && extinction_rise == 0; }
};

/// Neighbouring intervals [first, last] of a medium.
struct IntervalRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

/// A transfer function over a field's range, in floats.
class Medium {
 public:
  /// `radius`: the unit of length (see Projection). Intervals narrower than floats can tell are
  /// left out. Extinctions are bounded by 1e30.
  Medium(const preint::TransferFunction& tf, const ValueScale& scale, double radius);

  /// Ascending, from -1 to 1; at least one.
  [[nodiscard]] const std::vector<MediumInterval>& intervals() const { return intervals_; }

  /// The intervals that hold the values from `low` to `high` (low <= high, scaled): of a value
  /// where two meet, the upper one. Cost: logarithmic.
  [[nodiscard]] IntervalRange range(float low, float high) const;

  /// The color of a scaled value.
  [[nodiscard]] std::array<float, 3> color(float value) const;

 private:
  std::vector<MediumInterval> intervals_;
};

/// The coefficients of light (preint::Material) over an interval: at its low end, and what is added
/// up to its high end.
struct MaterialInterval {
  std::array<float, 4> low = {};  ///< ambient, diffuse, specular, shininess
  std::array<float, 4> rise = {};
};

/// Of each interval of the medium of these.
[[nodiscard]] std::vector<MaterialInterval> material_intervals(const preint::TransferFunction& tf,
                                                               const ValueScale& scale);

/// For each drawn cell, the intervals of its values.
[[nodiscard]] std::vector<IntervalRange> cell_intervals(const Medium& medium,
                                                        const DrawnCells& cells);

}  // namespace tetraglass::project::cpu
