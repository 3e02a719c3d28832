#include "project/reference/ray_voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace tetraglass::project {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

/// The cubic c at from + t (to - from), as a cubic of t.
Vector4d restricted(const Vector4d& c, double from, double to) {
  const double h = to - from;
  return {c[0] + from * (c[1] + from * (c[2] + from * c[3])),
          h * (c[1] + from * (2 * c[2] + 3 * from * c[3])), h * h * (c[2] + 3 * from * c[3]),
          h * h * h * c[3]};
}

/// Where the cubic turns within (0, 1), ascending; the count first.
std::pair<int, std::array<double, 2>> turns(const Vector4d& cubic) {
  // Scaled: squares of very large or small coefficients would not be numbers of use.
  const double largest = cubic.tail<3>().cwiseAbs().maxCoeff();
  const Vector4d c = largest > 0 ? Vector4d(cubic / largest) : cubic;
  std::array<double, 2> roots{};
  int count = 0;
  const auto add = [&](double t) {
    if (t > 0 && t < 1) roots[static_cast<std::size_t>(count++)] = t;
  };
  const double a = 3 * c[3];
  const double b = c[2];  // half of the derivative's linear coefficient
  const double discriminant = b * b - a * c[1];
  if (discriminant > 0) {
    // The form without cancellation.
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    if (a != 0) add(q / a);
    if (q != 0) add(c[1] / q);
    if (count == 2 && roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  }
  return {count, roots};
}

}  // namespace

double MonotonePiece::position(double value_there) const {
  const bool rising = value(1) > value(0);
  double low = 0;
  double high = 1;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    ((value(middle) < value_there) == rising ? low : high) = middle;
  }
}

RayVoxels::RayVoxels(const Scene& scene)
    : scene_(scene),
      frame_(make_frame(scene)),
      to_coordinates_(scene.grid->axes.inverse() * frame_.axes().transpose()),
      eye_(scene.grid->axes.inverse() * (frame_.eye() - scene.grid->origin)),
      low_corner_(frame_.to_camera(scene.mesh->points.front())),
      high_corner_(frame_.to_camera(scene.mesh->points.back())) {}

Vector3d RayVoxels::coordinate(const Eigen::Vector2d& plane, double depth) const {
  return eye_ + to_coordinates_ * (frame_.ray_origin(plane) + depth * frame_.ray_direction(plane));
}

bool RayVoxels::passes_between(Eigen::Index axis, const Eigen::Vector2d& plane) const {
  const auto across = to_coordinates_.row(axis);
  // From the corners themselves, whose differences to the ray are exact where they are 0.
  const double above = across.dot(frame_.ray_origin(plane) - low_corner_);
  const double below = across.dot(high_corner_ - frame_.ray_origin(plane));
  const double drift = across[0] != 0 ? across[0] : across[1];
  return (above > 0 || (above == 0 && drift > 0)) && (below > 0 || (below == 0 && drift < 0));
}

void RayVoxels::pieces(int x, int y, std::vector<MonotonePiece>& result) const {
  result.clear();
  const mesh::RectilinearGrid& grid = *scene_.grid;
  const Eigen::Vector2d plane = frame_.image_plane(x, y);
  const Vector3d start = coordinate(plane, 0);
  const Vector3d slope = to_coordinates_ * frame_.ray_direction(plane);
  const DepthRange kept = clipped_ray(scene_.clip, frame_, plane);
  double near = frame_.parallel() ? kept.near : std::max(0.0, kept.near);
  double far = kept.far;
  std::vector<double> depths;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double>& row = grid.coordinates[k];
    const auto axis = static_cast<Eigen::Index>(k);
    if (slope[axis] == 0) {
      if (!passes_between(axis, plane)) return;
      continue;
    }
    const double first = (row.front() - start[axis]) / slope[axis];
    const double last = (row.back() - start[axis]) / slope[axis];
    near = std::max(near, std::min(first, last));
    far = std::min(far, std::max(first, last));
    for (const double at : row) depths.push_back((at - start[axis]) / slope[axis]);
  }
  if (!(near < far)) return;
  depths.push_back(near);
  depths.push_back(far);
  std::erase_if(depths, [&](double depth) { return depth < near || depth > far; });
  std::ranges::sort(depths);
  for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
    if (!(depths[i] < depths[i + 1])) continue;
    add_voxel(start + depths[i] * slope, start + depths[i + 1] * slope, depths[i], depths[i + 1],
              result);
  }
}

void RayVoxels::add_voxel(const Vector3d& from, const Vector3d& to, double entry, double exit,
                          std::vector<MonotonePiece>& result) const {
  const mesh::RectilinearGrid& grid = *scene_.grid;
  const Vector3d middle = grid.index_at(0.5 * (from + to));
  std::array<std::size_t, 3> low{};
  Vector3d a;  // the part of the voxel along each axis at the front ...
  Vector3d b;  // ... and how much it grows
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    low[k] = std::min(static_cast<std::size_t>(middle[axis]), grid.size(k) - 2);
    const double width = grid.coordinates[k][low[k] + 1] - grid.coordinates[k][low[k]];
    a[axis] = std::clamp((from[axis] - grid.coordinates[k][low[k]]) / width, 0.0, 1.0);
    b[axis] = std::clamp((to[axis] - grid.coordinates[k][low[k]]) / width, 0.0, 1.0) - a[axis];
  }
  // Relative to one of the corners, so that what is constant stays so to the last bit.
  const auto value_at = [&](const std::array<std::size_t, 3>& point) {
    return scene_.field.values[(point[2] * grid.size(1) + point[1]) * grid.size(0) + point[0]];
  };
  const double base = value_at(low);
  Vector4d cubic = Vector4d::Zero();
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Vector4d weight(1, 0, 0, 0);
    std::array<std::size_t, 3> at = low;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      const bool up = (corner >> k & 1U) == 1;
      at[k] += up ? 1 : 0;
      const double c0 = up ? a[axis] : 1 - a[axis];
      const double c1 = up ? b[axis] : -b[axis];
      weight = c0 * weight + c1 * Vector4d(0, weight[0], weight[1], weight[2]);
    }
    cubic += weight * (value_at(at) - base);
  }
  cubic[0] += base;
  const auto [count, roots] = turns(cubic);
  double begin = 0;
  for (int i = 0; i <= count; ++i) {
    const double end = i < count ? roots[static_cast<std::size_t>(i)] : 1;
    const double piece_entry = entry + begin * (exit - entry);
    const double piece_exit = i < count ? entry + end * (exit - entry) : exit;
    if (piece_entry < piece_exit) {
      result.push_back({piece_entry, piece_exit, restricted(cubic, begin, end)});
    }
    begin = end;
  }
}

}  // namespace tetraglass::project
