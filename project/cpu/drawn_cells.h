#pragma once

#include <cstdint>
#include <vector>

#include "project/scene.h"

namespace tetraglass::project::cpu {

/// Takes a field's range to [-1, 1], where floats are finest. Monotonic: equal values stay equal
/// and greater ones at least as great.
class ValueScale {
 public:
  explicit ValueScale(const mesh::ScalarField& field);

  /// Finite for every finite value, whatever its distance from the range.
  [[nodiscard]] float scaled(double value) const;

  /// The inverse.
  [[nodiscard]] double value(double scaled) const { return middle_ + half_range_ * scaled; }

 private:
  double middle_;
  double half_range_;  // > 0
};

/// The cells of a scene that can show anything, as the kernels read them; what no view changes.
struct DrawnCells {
  /// Takes the drawable cells that show something: in mode iso those that a surface crosses; in
  /// full, emission and absorption those with a value where the extinction is not 0; else all.
  explicit DrawnCells(const Scene& scene);

  [[nodiscard]] std::size_t size() const { return vertices.size(); }

  ValueScale scale;

  /// Four point indices, ascending: both cells at a face then do the same arithmetic with the same
  /// numbers, and agree on it to the last bit.
  std::vector<mesh::Cell> vertices;

  std::vector<std::uint32_t> numbers;  ///< in the mesh

  /// 1 where ascending order turns the cell inside out, else 0.
  std::vector<std::uint8_t> mirrored;

  std::vector<float> point_values;  ///< scaled; empty for a cell field
  std::vector<float> cell_values;   ///< scaled, of each drawn cell; empty for a point field
};

}  // namespace tetraglass::project::cpu
