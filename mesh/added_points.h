#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// Points that are weighted sums of points of a mesh, to be added to it.
class AddedPoints {
 public:
  /// The points of a sum, with their weights.
  using Weights = std::vector<std::pair<std::uint32_t, double>>;

  /// `given`: how many points the mesh has.
  explicit AddedPoints(std::size_t given) : given_(given) {}

  /// The number that the point will have. Throws InputError where 32 bits do not suffice.
  std::uint32_t add(Weights weights);

  [[nodiscard]] std::size_t count() const { return weights_.size(); }

  /// Appends the points, with the same sums of the values of all point fields.
  void append_to(std::vector<Eigen::Vector3d>& points, std::vector<Field>& fields) const;

 private:
  std::size_t given_;
  std::vector<Weights> weights_;
};

}  // namespace tetraglass::mesh
