#include "project/gl/cell_parts.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/errors.h"

namespace tetraglass::project::gl {
namespace {

constexpr std::uint32_t kElsewhere = std::numeric_limits<std::uint32_t>::max();

}  // namespace

CellCutter::CellCutter(const mesh::TetMesh& mesh, const PartLimits& limits)
    : mesh_(mesh), limits_(limits), places_(mesh.points.size(), kElsewhere) {}

std::size_t CellCutter::next(std::span<const std::uint32_t> cells) {
  for (const std::uint32_t point : points_) places_[point] = kElsewhere;
  points_.clear();
  std::size_t count = 0;
  for (; count < std::min(cells.size(), limits_.cells); ++count) {
    const std::size_t known = points_.size();
    for (const std::uint32_t point : mesh_.cells[cells[count]]) {
      if (places_[point] != kElsewhere) continue;
      places_[point] = 0;
      points_.push_back(point);
    }
    const std::size_t bytes =
        (count + 1) * limits_.cell_bytes + points_.size() * limits_.point_bytes;
    if (bytes <= limits_.bytes && points_.size() <= limits_.points) continue;
    for (std::size_t i = known; i < points_.size(); ++i) places_[points_[i]] = kElsewhere;
    points_.resize(known);
    break;
  }
  if (count == 0) {
    throw base::UnavailableError(
        fmt::format("a cell takes {} bytes and {} are given: use --gpu-memory with more of them",
                    limits_.cell_bytes + 4 * limits_.point_bytes, limits_.bytes));
  }
  std::sort(points_.begin(), points_.end());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    places_[points_[i]] = static_cast<std::uint32_t>(i);
  }
  return count;
}

}  // namespace tetraglass::project::gl
