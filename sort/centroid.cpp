#include "sort/centroid.h"

#include <algorithm>
#include <cmath>

#include "sort/depth_keys.h"

namespace tetraglass::sort {
namespace {

using Eigen::Vector3d;

// Quarters are added before the reference is taken away: the rounding of the sum is no larger than
// that of the coordinates themselves.
Vector3d centroid(const mesh::TetMesh& mesh, std::uint32_t index) {
  const mesh::Cell& cell = mesh.cells[index];
  const auto quarter = [&](std::size_t i) -> Vector3d { return 0.25 * mesh.points[cell[i]]; };
  return (quarter(0) + quarter(1)) + (quarter(2) + quarter(3));
}

// The depth in perspective is the squared distance from the eye, |v + w|^2 - |w|^2 = v . v + 2 w .
// v with w the way from the eye to the middle, divided by |w| if that is more than one: it does not
// cancel, nor overflow, however far the eye is.
DepthKeys depth_of(const View& view, const Vector3d& middle, double unit) {
  DepthKeys keys;
  keys.linear = view.direction;
  if (view.parallel) return keys;
  const Vector3d half_way = 0.5 * middle - 0.5 * view.eye;
  const double distance = 2 * (half_way.stableNorm() / unit);
  if (distance <= 1) {
    keys.square = 1;
    keys.linear = 4 * (half_way / unit);
  } else {
    keys.square = 1 / distance;
    keys.linear = 2 * half_way.stableNormalized();
  }
  return keys;
}

// The steps of the keys, so that the depths in the box from -half to half have as many as there
// are.
void set_steps(const Vector3d& half, DepthKeys& keys) {
  constexpr double kLast = 4294967295.0;  // 2^32 - 1
  double nearest = 0;
  keys.farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = std::abs(keys.linear[axis]);
    const double lowest =
        2 * keys.square * half[axis] <= slope ? half[axis] : slope / (2 * keys.square);
    nearest += (keys.square * lowest - slope) * lowest;
    keys.farthest += (keys.square * half[axis] + slope) * half[axis];
  }
  // A mesh without extent has one depth.
  keys.scale = keys.farthest > nearest ? kLast / (keys.farthest - nearest) : 0;
}

}  // namespace

CentroidSorter::CentroidSorter(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells)
    : cells_(cells.begin(), cells.end()), middle_(Vector3d::Zero()), half_(Vector3d::Zero()) {
  const mesh::Box box = mesh::bounds(mesh);
  if (!box.isEmpty()) {
    middle_ = 0.5 * box.min() + 0.5 * box.max();
    half_ = 0.5 * box.max() - 0.5 * box.min();
    int exponent = 0;
    std::frexp(half_.maxCoeff(), &exponent);
    unit_ = std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
    half_ /= unit_;
  }
  const auto has_no_depth = [&](std::uint32_t cell) { return !centroid(mesh, cell).allFinite(); };
  const auto with_depth = std::stable_partition(cells_.begin(), cells_.end(), has_no_depth);
  without_depth_ = static_cast<std::size_t>(with_depth - cells_.begin());
  const Chunks chunks(cells_.size() - without_depth_);
  for (auto* numbers : {&x_, &y_, &z_}) numbers->resize(chunks.total);
  chunks.for_each([&](std::size_t chunk) {
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      const Vector3d v = (centroid(mesh, cells_[without_depth_ + i]) - middle_) / unit_;
      x_[i] = in_steps(v.x());
      y_[i] = in_steps(v.y());
      z_[i] = in_steps(v.z());
    }
  });
  order_.method = "centroid";
}

const Order& CentroidSorter::sort(const View& view) {
  DepthKeys keys = depth_of(view, middle_, unit_);
  set_steps(half_, keys);
  const auto write = [&](std::size_t begin, std::size_t count, KeyedItem* target) {
    write_entries(keys, {x_.data() + begin, y_.data() + begin, z_.data() + begin},
                  cells_.data() + without_depth_ + begin, count, target);
  };
  order_.cells.resize(cells_.size());
  std::copy_n(cells_.begin(), without_depth_, order_.cells.begin());
  std::uint32_t* target = order_.cells.data() + without_depth_;
  sorter_.sort(x_.size(), write, [&](std::span<const KeyedItem> entries, std::size_t place) {
    std::transform(entries.begin(), entries.end(), target + place, item_of);
  });
  return order_;
}

Order sort_centroid(const mesh::TetMesh& mesh, std::span<const std::uint32_t> cells,
                    const View& view) {
  return CentroidSorter(mesh, cells).sort(view);
}

}  // namespace tetraglass::sort
