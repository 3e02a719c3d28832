#include "mesh/decompose.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/cell_shapes.h"
#include "mesh/predicates.h"

namespace tetraglass::mesh {
namespace {

/// A face by the positions of its corners in the cell, counter-clockwise from outside.
struct FaceShape {
  int size;
  std::array<int, 4> at;
};

constexpr auto kHexahedronFaces = std::to_array<FaceShape>({{4, {0, 4, 7, 3}},
                                                            {4, {1, 2, 6, 5}},
                                                            {4, {0, 1, 5, 4}},
                                                            {4, {3, 7, 6, 2}},
                                                            {4, {0, 3, 2, 1}},
                                                            {4, {4, 5, 6, 7}}});
constexpr auto kWedgeFaces = std::to_array<FaceShape>(
    {{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}});
constexpr auto kPyramidFaces = std::to_array<FaceShape>(
    {{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}});

/// The corners of cell types that are numbered unlike the shape whose faces they share.
constexpr std::array<int, 8> kVoxelCorners = {0, 1, 3, 2, 4, 5, 7, 6};
/// VTK's wedge has its first triangle seen from outside; its wedges of arbitrary order, from
/// inside.
constexpr std::array<int, 6> kHigherOrderWedgeCorners = {3, 4, 5, 0, 1, 2};

class Splitter {
 public:
  explicit Splitter(const MeshData& data)
      : data_(data),
        finite_(std::ranges::all_of(data.points, [](const auto& p) { return p.allFinite(); })) {}

  Decomposition split();

 private:
  void check_sizes() const;
  void check_indices(std::size_t cell, std::span<const std::uint32_t> points) const;
  void split_cell(std::size_t cell);
  void split_around_smallest(std::span<const std::uint32_t> corners,
                             std::span<const FaceShape> faces);
  void split_hexahedron(std::span<const std::uint32_t> corners);
  void star_prism(std::span<const std::uint32_t> corners);
  void star_polyhedron(std::size_t cell);
  std::uint32_t add_mean_point(std::span<const std::uint32_t> points);
  void star_face(std::uint32_t center, std::span<const std::uint32_t> face);
  void add_part(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  void add(Cell cell, bool count_inverted);
  [[nodiscard]] const Eigen::Vector3d& point(std::uint32_t i) const {
    return i < data_.points.size() ? data_.points[i] : added_[i - data_.points.size()];
  }
  void gather_points();
  void gather_fields();

  const MeshData& data_;
  const bool finite_;  ///< all coordinates are
  Decomposition out_;
  std::size_t cell_ = 0;                ///< the cell being split
  std::vector<std::size_t> parents_;    ///< of each tetrahedron, the cell it is part of
  std::vector<Eigen::Vector3d> added_;  ///< centers of starred cells, numbered after the points
  std::vector<std::vector<std::uint32_t>> stars_;  ///< of each added point, those it is the mean of
  std::vector<std::uint32_t> kept_;  ///< of each point of the result, its number before
};

Decomposition Splitter::split() {
  check_sizes();
  parents_.reserve(data_.cell_count());
  out_.mesh.cells.reserve(data_.cell_count());
  for (cell_ = 0; cell_ < data_.cell_count(); ++cell_) split_cell(cell_);
  if (parents_.empty()) {
    const std::size_t solids = data_.cell_count() - out_.skipped - out_.unknown;
    throw base::InputError(fmt::format(
        "there is no cell of dimension 3 to split into tetrahedra ({} cells: {} of lower "
        "dimension, {} of unknown type, {} collapsed)",
        data_.cell_count(), out_.skipped, out_.unknown, solids));
  }
  gather_points();
  gather_fields();
  return std::move(out_);
}

void Splitter::check_sizes() const {
  if (data_.points.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(
        fmt::format("{} points are more than can be numbered in 32 bits", data_.points.size()));
  }
  for (const Field& field : data_.fields) {
    const bool at_points = field.location == Location::point;
    const std::size_t places = at_points ? data_.points.size() : data_.cell_count();
    if (field.components < 1 ||
        field.values.size() != places * static_cast<std::size_t>(field.components)) {
      throw base::InputError(fmt::format("the field '{}' has {} values of {} components for {} {}",
                                         field.name, field.values.size(), field.components, places,
                                         at_points ? "points" : "cells"));
    }
  }
}

void Splitter::check_indices(std::size_t cell, std::span<const std::uint32_t> points) const {
  for (const std::uint32_t i : points) {
    if (i >= data_.points.size()) {
      throw base::InputError(fmt::format("cell {} ({}) names point {}, but there are {} points",
                                         cell, to_string(data_.types[cell]), i,
                                         data_.points.size()));
    }
  }
}

void Splitter::split_cell(std::size_t cell) {
  const CellType type = data_.types[cell];
  const CellShape* shape = find_shape(type);
  if (shape == nullptr) {
    ++out_.unknown;
    return;
  }
  if (shape->dimension < 3) {
    ++out_.skipped;
    return;
  }
  if (type == CellType::polyhedron) {
    star_polyhedron(cell);
    return;
  }
  const std::span<const std::uint32_t> points = data_.cell(cell);
  const auto corner_count = static_cast<std::size_t>(shape->corners);
  // More are met with: writers that call a quadratic cell by the name of the linear one.
  const int least = std::max(shape->points, shape->corners);
  if (points.size() < static_cast<std::size_t>(least)) {
    throw base::InputError(fmt::format("cell {} ({}) has {} points instead of {}", cell,
                                       shape->name, points.size(), least));
  }
  check_indices(cell, points);
  if (points.size() > corner_count) ++out_.nonlinear[type];

  std::array<std::uint32_t, 12> corners{};
  std::ranges::copy(points.first(corner_count), corners.begin());
  if (type == CellType::voxel) {
    for (std::size_t i = 0; i < 8; ++i) corners[i] = points[kVoxelCorners[i]];
  } else if (type == CellType::lagrange_wedge || type == CellType::bezier_wedge) {
    for (std::size_t i = 0; i < 6; ++i) corners[i] = points[kHigherOrderWedgeCorners[i]];
  }
  switch (corner_count) {
    case 4:
      add({corners[0], corners[1], corners[2], corners[3]}, true);
      break;
    case 5:
      split_around_smallest(std::span(corners).first<5>(), kPyramidFaces);
      break;
    case 6:
      split_around_smallest(std::span(corners).first<6>(), kWedgeFaces);
      break;
    case 8:
      split_hexahedron(std::span(corners).first<8>());
      break;
    default:
      star_prism(std::span(corners).first(corner_count));
      break;
  }
}

std::size_t position_of_smallest(std::span<const std::uint32_t> values) {
  return static_cast<std::size_t>(std::ranges::min_element(values) - values.begin());
}

/// Joins the smallest corner to the triangles of the faces that it does not lie on.
void Splitter::split_around_smallest(std::span<const std::uint32_t> corners,
                                     std::span<const FaceShape> faces) {
  const std::size_t root = position_of_smallest(corners);
  for (const FaceShape& face : faces) {
    const auto at = std::span(face.at).first(static_cast<std::size_t>(face.size));
    if (std::ranges::find(at, static_cast<int>(root)) != at.end()) continue;
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < at.size(); ++i) v[i] = corners[static_cast<std::size_t>(at[i])];
    const std::size_t n = at.size();
    const std::size_t m = position_of_smallest(std::span(v).first(n));
    for (std::size_t k = 1; k + 1 < n; ++k) {
      add_part(corners[root], v[m], v[(m + k) % n], v[(m + k + 1) % n]);
    }
  }
}

/// As above, which gives 6 parts; but where the diagonals of the three faces away from the smallest
/// corner make a triangle, that triangle cuts off the opposite corner and 5 parts do.
void Splitter::split_hexahedron(std::span<const std::uint32_t> corners) {
  const std::size_t root = position_of_smallest(corners);
  constexpr std::array<std::size_t, 8> kOpposite = {6, 7, 4, 5, 2, 3, 0, 1};
  const std::size_t far = kOpposite[root];
  struct Corner {
    std::uint32_t before, beside, after;  ///< on a face away from the root, from the far corner on
  };
  std::array<Corner, 3> around{};
  std::size_t count = 0;
  bool triangle = true;
  for (const FaceShape& face : kHexahedronFaces) {
    const auto* found = std::ranges::find(face.at, static_cast<int>(far));
    if (found == face.at.end()) continue;
    const auto start = static_cast<std::size_t>(found - face.at.begin());
    std::array<std::uint32_t, 4> v{};
    for (std::size_t i = 0; i < 4; ++i) {
      v[i] = corners[static_cast<std::size_t>(face.at[(start + i) % 4])];
    }
    triangle = triangle && position_of_smallest(v) % 2 == 1;
    around[count++] = {v[1], v[2], v[3]};
  }
  if (!triangle) {
    split_around_smallest(corners, kHexahedronFaces);
    return;
  }
  for (const Corner& c : around) add_part(corners[root], c.before, c.beside, c.after);
  // Going round the far corner, each face's last neighbour of it is the next face's first.
  const std::uint32_t p = around[0].after;
  const std::uint32_t q = around[0].before;
  const std::uint32_t r = around[1].after == q ? around[1].before : around[2].before;
  add_part(corners[root], p, r, q);
  add_part(corners[far], p, q, r);
}

void Splitter::star_prism(std::span<const std::uint32_t> corners) {
  const std::uint32_t center = add_mean_point(corners);
  const std::size_t sides = corners.size() / 2;
  star_face(center, corners.first(sides));
  star_face(center, corners.last(sides));
  for (std::size_t i = 0; i < sides; ++i) {
    const std::size_t j = (i + 1) % sides;
    star_face(center, std::array{corners[i], corners[j], corners[sides + j], corners[sides + i]});
  }
}

void Splitter::star_polyhedron(std::size_t cell) {
  const std::span<const std::uint32_t> stream = data_.cell(cell);
  std::vector<std::span<const std::uint32_t>> faces;
  std::vector<std::uint32_t> points;
  std::size_t at = 1;
  const std::size_t face_count = stream.empty() ? 0 : stream[0];
  for (std::size_t i = 0; i < face_count; ++i) {
    if (at >= stream.size() || stream[at] > stream.size() - at - 1) {
      throw base::InputError(
          fmt::format("cell {} (polyhedron) ends within its face {} of {}", cell, i, face_count));
    }
    faces.push_back(stream.subspan(at + 1, stream[at]));
    at += 1 + faces.back().size();
    check_indices(cell, faces.back());
    points.insert(points.end(), faces.back().begin(), faces.back().end());
  }
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 4) return;  // no volume, and nothing to star from
  const std::uint32_t center = add_mean_point(points);
  for (const auto& face : faces) {
    if (face.size() >= 3) star_face(center, face);
  }
}

std::uint32_t Splitter::add_mean_point(std::span<const std::uint32_t> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t i : points) sum += data_.points[i];
  const std::size_t number = data_.points.size() + added_.size();
  if (number >= std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(
        "more points than can be numbered in 32 bits, with those that are added");
  }
  added_.emplace_back(sum / static_cast<double>(points.size()));
  stars_.emplace_back(points.begin(), points.end());
  return static_cast<std::uint32_t>(number);
}

void Splitter::star_face(std::uint32_t center, std::span<const std::uint32_t> face) {
  const std::size_t n = face.size();
  const std::size_t m = position_of_smallest(face);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Cell part = {center, face[m], face[(m + k) % n], face[(m + k + 1) % n]};
    if (part[1] == part[2] || part[2] == part[3] || part[1] == part[3]) {
      ++out_.collapsed;
    } else {
      add(part, false);
    }
  }
}

/// Adds the part with apex `a` over the triangle bcd, counter-clockwise from outside.
void Splitter::add_part(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  if (a == b || a == c || a == d || b == c || b == d || c == d) {
    ++out_.collapsed;
  } else {
    add({a, b, c, d}, true);
  }
}

void Splitter::add(Cell cell, bool count_inverted) {
  const auto& [a, b, c, d] = cell;
  const bool decidable =
      finite_ || std::ranges::all_of(cell, [&](auto i) { return point(i).allFinite(); });
  if (decidable && orientation(point(a), point(b), point(c), point(d)) < 0) {
    std::swap(cell[2], cell[3]);
    if (count_inverted) ++out_.inverted;
  }
  out_.mesh.cells.push_back(cell);
  parents_.push_back(cell_);
}

void Splitter::gather_points() {
  constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(data_.points.size() + added_.size(), kUnused);
  for (const Cell& cell : out_.mesh.cells) {
    for (const std::uint32_t i : cell) number[i] = 0;
  }
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == kUnused) continue;
    number[i] = static_cast<std::uint32_t>(kept_.size());
    kept_.push_back(i);
    out_.mesh.points.push_back(point(i));
  }
  for (Cell& cell : out_.mesh.cells) {
    for (std::uint32_t& i : cell) i = number[i];
  }
}

void append(std::vector<double>& values, std::span<const double> more) {
  values.insert(values.end(), more.begin(), more.end());
}

void Splitter::gather_fields() {
  for (const Field& field : data_.fields) {
    const auto n = static_cast<std::size_t>(field.components);
    const auto value = [&](std::size_t i) { return std::span(field.values).subspan(i * n, n); };
    Field out{field.name, field.location, field.components, {}};
    if (field.location == Location::cell) {
      out.values.reserve(parents_.size() * n);
      for (const std::size_t parent : parents_) append(out.values, value(parent));
    } else {
      out.values.reserve(kept_.size() * n);
      for (const std::uint32_t i : kept_) {
        if (i < data_.points.size()) {
          append(out.values, value(i));
          continue;
        }
        const std::vector<std::uint32_t>& star = stars_[i - data_.points.size()];
        for (std::size_t c = 0; c < n; ++c) {
          double sum = 0;
          for (const std::uint32_t j : star) sum += value(j)[c];
          out.values.push_back(sum / static_cast<double>(star.size()));
        }
      }
    }
    out_.mesh.fields.push_back(std::move(out));
  }
}

}  // namespace

Decomposition decompose(const MeshData& data) {
  return Splitter(data).split();
}

}  // namespace tetraglass::mesh
