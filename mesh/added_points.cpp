#include "mesh/added_points.h"

#include <algorithm>
#include <limits>

#include "base/errors.h"

namespace tetraglass::mesh {

std::uint32_t AddedPoints::add(Weights weights) {
  const std::size_t number = given_ + weights_.size();
  if (number >= std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(
        "more points than can be numbered in 32 bits, with those that are added");
  }
  weights_.push_back(std::move(weights));
  return static_cast<std::uint32_t>(number);
}

void AddedPoints::append_to(std::vector<Eigen::Vector3d>& points,
                            std::vector<Field>& fields) const {
  for (const Weights& weights : weights_) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [point, weight] : weights) sum += weight * points[point];
    points.push_back(sum);
  }
  for (Field& field : fields) {
    const auto n = static_cast<std::size_t>(std::max(field.components, 1));
    if (field.location != Location::point || field.values.size() != given_ * n) continue;
    for (const Weights& weights : weights_) {
      for (std::size_t c = 0; c < n; ++c) {
        double sum = 0;
        for (const auto& [point, weight] : weights) sum += weight * field.values[point * n + c];
        field.values.push_back(sum);
      }
    }
  }
}

}  // namespace tetraglass::mesh
