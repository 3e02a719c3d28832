#include "project/reference/ray_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/predicates.h"

namespace tetraglass::project {
namespace {

constexpr int kTile = 16;  // pixels each way

/// Grows [low, high] by where a projective coordinate a / w can lie on the part of an edge in front
/// of the eye.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// The edge passes through the plane of the eye: its image runs off to infinity on one side, or
  /// on either where rounding leaves the side open.
  void include_crossing(double a0, double w0, double a1, double w1) {
    const double numerator = a0 * w1 - a1 * w0;
    const double at_eye_plane = w1 > w0 ? numerator : -numerator;
    const double uncertainty =
        4 * std::numeric_limits<double>::epsilon() * (std::abs(a0 * w1) + std::abs(a1 * w0));
    if (at_eye_plane >= -uncertainty) high = std::numeric_limits<double>::infinity();
    if (at_eye_plane <= uncertainty) low = -std::numeric_limits<double>::infinity();
  }
};

}  // namespace

RayCells::RayCells(const Scene& scene)
    : scene_(scene),
      frame_(make_frame(scene)),
      tiles_x_((frame_.width() + kTile - 1) / kTile),
      tiles_y_((frame_.height() + kTile - 1) / kTile) {
  points_.reserve(scene.mesh->points.size());
  for (const Eigen::Vector3d& point : scene.mesh->points)
    points_.push_back(frame_.to_camera(point));
  tile_cells_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
  bin_cells();
}

Eigen::Vector3d RayCells::projective(std::uint32_t point) const {
  const Eigen::Vector3d& p = points_[point];
  return {p.x(), p.y(), frame_.parallel() ? 1.0 : p.z()};
}

void RayCells::bin_cells() {
  constexpr std::array<std::array<int, 2>, 6> kEdges = {
      {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  for (const std::uint32_t cell : scene_.drawable.cells) {
    std::array<Eigen::Vector3d, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) corner[i] = projective(scene_.mesh->cells[cell][i]);
    Range u;
    Range v;
    for (const Eigen::Vector3d& p : corner) {
      if (!(p.z() > 0)) continue;
      u.include(p.x() / p.z());
      v.include(p.y() / p.z());
    }
    for (const auto& [from, to] : kEdges) {
      const Eigen::Vector3d& a = corner[static_cast<std::size_t>(from)];
      const Eigen::Vector3d& b = corner[static_cast<std::size_t>(to)];
      if ((a.z() > 0) == (b.z() > 0)) continue;
      u.include_crossing(a.x(), a.z(), b.x(), b.z());
      v.include_crossing(a.y(), a.z(), b.y(), b.z());
    }
    if (u.low > u.high) continue;  // behind the eye
    // One pixel more on every side covers the rounding of the projection.
    const Eigen::Vector2d first = frame_.pixel({u.low, v.high}).array() - 1;
    const Eigen::Vector2d last = frame_.pixel({u.high, v.low}).array() + 1;
    const auto within = [](double pixel, int count) {
      return static_cast<std::int32_t>(std::clamp(pixel, -1.0, static_cast<double>(count)));
    };
    const TileCell bounds = {
        cell, std::max(0, within(std::floor(first.x()), frame_.width())),
        std::max(0, within(std::floor(first.y()), frame_.height())),
        std::min(within(std::ceil(last.x()), frame_.width()), frame_.width() - 1),
        std::min(within(std::ceil(last.y()), frame_.height()), frame_.height() - 1)};
    if (bounds.first_x > bounds.last_x || bounds.first_y > bounds.last_y) continue;
    for (int y = bounds.first_y / kTile; y <= bounds.last_y / kTile; ++y) {
      for (int x = bounds.first_x / kTile; x <= bounds.last_x / kTile; ++x) {
        tile_cells_[static_cast<std::size_t>(y * tiles_x_ + x)].push_back(bounds);
      }
    }
  }
}

/// On which side of the edge the ray passes: the sign of det [from, to, ray], decided exactly, with
/// ties broken as if the ray were moved by (epsilon, epsilon^2) to the right and up: the
/// derivatives of the determinant by the ray's coordinates. 0 only for an edge that the whole moved
/// ray misses (it projects to a point). In perspective that may be an edge that the eye is on.
int RayCells::edge_side(std::uint32_t from, std::uint32_t to, const Eigen::Vector2d& plane) const {
  if (from > to) return -edge_side(to, from, plane);  // both cells at an edge compute the same
  const Eigen::Vector3d p = projective(from);
  const Eigen::Vector3d q = projective(to);
  const int sign = mesh::sign_of_determinant(p, q, Eigen::Vector3d(plane.x(), plane.y(), 1));
  if (sign != 0) return sign;
  const int by_x =
      mesh::sign_of_determinant(Eigen::Vector2d(p.y(), p.z()), Eigen::Vector2d(q.y(), q.z()));
  if (by_x != 0) return by_x;
  const int by_y =
      mesh::sign_of_determinant(Eigen::Vector2d(p.z(), p.x()), Eigen::Vector2d(q.z(), q.x()));
  if (by_y != 0 || frame_.parallel()) return by_y;
  return edge_side_at_eye(p, q, plane);
}

/// Of an edge in line with the eye (p x q = 0 exactly): decided as if the eye e were moved too, by
/// far less, by (epsilon, epsilon^2, epsilon^3), so that a vertex or an edge at the eye does not
/// hide the cells around it. What is left of det [p - e, q - e, ray] is then e . ((p - q) x ray).
int RayCells::edge_side_at_eye(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                               const Eigen::Vector2d& plane) const {
  // p - q is parallel to the longer of the two; its direction is decided without rounding.
  int axis = 0;
  while (axis < 2 && p[axis] == q[axis]) ++axis;
  const bool along_p = p.cwiseAbs()[axis] > q.cwiseAbs()[axis];
  const Eigen::Vector3d& longer = along_p ? p : q;
  const int turn = (p[axis] < q[axis]) == (longer[axis] < 0) ? 1 : -1;
  for (const Eigen::Vector3d& ray : {Eigen::Vector3d(plane.x(), plane.y(), 1),
                                     Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      const int sign = mesh::sign_of_determinant(Eigen::Vector2d(longer[j], longer[k]),
                                                 Eigen::Vector2d(ray[j], ray[k]));
      if (sign != 0) return turn * sign;
    }
  }
  return 0;  // the two points are one
}

bool RayCells::intersect(std::uint32_t cell_index, const Eigen::Vector2d& plane,
                         RaySegment& segment) const {
  const mesh::Cell& cell = scene_.mesh->cells[cell_index];
  std::array<std::array<int, 4>, 4> side{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      side[i][j] = edge_side(cell[i], cell[j], plane);
      side[j][i] = -side[i][j];
    }
  }
  std::array<double, 2> depth{};
  std::array<Eigen::Vector4d, 2> weights;
  std::size_t hits = 0;
  for (const auto& face : mesh::kFaceVertices) {
    // By point index, so that both cells at a face do the same arithmetic and agree to the last
    // bit.
    std::array<std::size_t, 3> v = {static_cast<std::size_t>(face[0]),
                                    static_cast<std::size_t>(face[1]),
                                    static_cast<std::size_t>(face[2])};
    std::sort(v.begin(), v.end(), [&](std::size_t i, std::size_t j) { return cell[i] < cell[j]; });
    const auto [a, b, c] = v;
    const int turn = side[a][b];
    if (turn == 0 || side[b][c] != turn || side[c][a] != turn) continue;
    // In coordinates relative to the ray the determinant is that of two 2-vectors, without
    // cancellation.
    std::array<Eigen::Vector2d, 3> relative;
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Vector3d p = projective(cell[v[k]]);
      relative[k] = p.head<2>() - plane * p.z();
    }
    Eigen::Vector3d w;
    for (int k = 0; k < 3; ++k) {
      const auto next = static_cast<std::size_t>((k + 1) % 3);
      const auto last = static_cast<std::size_t>((k + 2) % 3);
      const double area =
          relative[next].x() * relative[last].y() - relative[last].x() * relative[next].y();
      w[k] = std::max(
          0.0, turn * area);  // a sign that rounding got wrong stands for a weight of nearly zero
    }
    if (!(w.sum() > 0)) w.setOnes();  // a face smaller than the rounding: any of its points will do
    w /= w.sum();
    weights[hits].setZero();
    for (std::size_t k = 0; k < 3; ++k) {
      weights[hits][static_cast<int>(v[k])] = w[static_cast<int>(k)];
      depth[hits] += w[static_cast<int>(k)] * points_[cell[v[k]]].z();
    }
    if (++hits == 2) break;
  }
  if (hits < 2) return false;
  const std::size_t near = depth[0] <= depth[1] ? 0 : 1;
  segment.entry = depth[near];
  segment.exit = depth[1 - near];
  segment.entry_weights = weights[near];
  segment.exit_weights = weights[1 - near];
  segment.cell = cell_index;
  if (!frame_.parallel()) {
    if (!(segment.exit > 0)) return false;  // behind the eye
    if (segment.entry < 0) {                // the eye is in this cell
      const double t = -segment.entry / (segment.exit - segment.entry);
      segment.entry_weights += t * (segment.exit_weights - segment.entry_weights);
      segment.entry = 0;
    }
  }
  const std::vector<double>& values = scene_.field.values;
  if (scene_.field.location == mesh::Location::cell) {
    segment.front = segment.back = values[cell_index];
  } else {
    // Summed in the order of the point indices, so that both cells at a face get the same value.
    std::array<std::size_t, 4> order = {0, 1, 2, 3};
    std::sort(order.begin(), order.end(),
              [&](std::size_t i, std::size_t j) { return cell[i] < cell[j]; });
    // As differences from the first that counts: exact where the field is constant, and as fine as
    // doubles allow where it nearly is.
    const auto interpolated = [&](const Eigen::Vector4d& at) {
      const auto counts = [&](std::size_t i) { return at[static_cast<int>(i)] != 0; };
      const double first = values[cell[*std::find_if(order.begin(), order.end(), counts)]];
      double rise = 0;
      for (const std::size_t i : order) {
        if (counts(i)) rise += at[static_cast<int>(i)] * (values[cell[i]] - first);
      }
      return first + rise;
    };
    segment.front = interpolated(segment.entry_weights);
    segment.back = interpolated(segment.exit_weights);
  }
  return true;
}

void RayCells::segments(int x, int y, std::vector<RaySegment>& result) const {
  result.clear();
  const Eigen::Vector2d plane = frame_.image_plane(x, y);
  RaySegment segment;
  const auto tile = static_cast<std::size_t>((y / kTile) * tiles_x_ + x / kTile);
  for (const TileCell& entry : tile_cells_[tile]) {
    if (x < entry.first_x || x > entry.last_x || y < entry.first_y || y > entry.last_y) continue;
    if (intersect(entry.cell, plane, segment)) result.push_back(segment);
  }
  std::stable_sort(result.begin(), result.end(), [](const RaySegment& a, const RaySegment& b) {
    return a.entry + a.exit < b.entry + b.exit;
  });
}

}  // namespace tetraglass::project
