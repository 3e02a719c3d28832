#include "mesh/linearize.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/added_points.h"
#include "mesh/cell_shapes.h"
#include "mesh/cut_lattice-inl.h"
#include "mesh/lagrange_lattice.h"

namespace tetraglass::mesh {
namespace {

using Index = std::array<int, 3>;

bool is_lagrange(CellType type) {
  return type == CellType::lagrange_tetra || type == CellType::lagrange_hexahedron ||
         type == CellType::lagrange_wedge;
}

bool is_quadratic(CellType type) {
  return type == CellType::quadratic_tetra || type == CellType::quadratic_hexahedron ||
         type == CellType::biquadratic_quadratic_hexahedron ||
         type == CellType::triquadratic_hexahedron || type == CellType::quadratic_wedge ||
         type == CellType::quadratic_linear_wedge ||
         type == CellType::biquadratic_quadratic_wedge || type == CellType::quadratic_pyramid ||
         type == CellType::triquadratic_pyramid;
}

constexpr auto kMiddles = std::to_array<std::array<std::size_t, 2>>({{0, 1},
                                                                     {1, 2},
                                                                     {2, 3},
                                                                     {3, 0},
                                                                     {4, 5},
                                                                     {5, 6},
                                                                     {6, 7},
                                                                     {7, 4},
                                                                     {0, 4},
                                                                     {1, 5},
                                                                     {2, 6},
                                                                     {3, 7}});

/// A quadrilateral of a cell: its corners, and the points in the middle of its sides.
struct Side {
  std::array<std::size_t, 8> at;
  std::size_t middle;  ///< where cells that have a point in the middle of it have that
};

// In the order of the points in the middle of them: -x +x -y +y -z +z.
constexpr auto kHexahedronSides = std::to_array<Side>({{{0, 4, 7, 3, 16, 15, 19, 11}, 20},
                                                       {{1, 2, 6, 5, 9, 18, 13, 17}, 21},
                                                       {{0, 1, 5, 4, 8, 17, 12, 16}, 22},
                                                       {{3, 7, 6, 2, 19, 14, 18, 10}, 23},
                                                       {{0, 3, 2, 1, 11, 10, 9, 8}, 24},
                                                       {{4, 5, 6, 7, 12, 13, 14, 15}, 25}});
constexpr auto kWedgeSides = std::to_array<Side>({{{0, 1, 4, 3, 6, 13, 9, 12}, 15},
                                                  {{1, 2, 5, 4, 7, 14, 10, 13}, 16},
                                                  {{2, 0, 3, 5, 8, 12, 11, 14}, 17}});
constexpr Side kPyramidBase = {{0, 1, 2, 3, 5, 6, 7, 8}, 13};

/// The quadrilaterals of a quadratic cell that have a point in their middle, in the file or added.
std::span<const Side> sides_of(CellType type) {
  switch (type) {
    case CellType::quadratic_hexahedron:
    case CellType::biquadratic_quadratic_hexahedron:
    case CellType::triquadratic_hexahedron:
      return kHexahedronSides;
    case CellType::quadratic_wedge:
    case CellType::biquadratic_quadratic_wedge:
      return kWedgeSides;
    case CellType::quadratic_pyramid:
    case CellType::triquadratic_pyramid:
      return std::span(&kPyramidBase, 1);
    default:
      return {};
  }
}

/// Whether cells of a type have a point in the middle of a side.
bool has_middle(CellType type, const Side& side) {
  return side.middle < static_cast<std::size_t>(find_shape(type)->points);
}

std::array<std::uint32_t, 4> sorted_corners(std::span<const std::uint32_t> cell, const Side& side) {
  std::array<std::uint32_t, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = cell[side.at[i]];
  std::ranges::sort(corners);
  return corners;
}

class Linearizer {
 public:
  Linearizer(MeshData data, bool quadratic)
      : data_(std::move(data)), quadratic_(quadratic), added_(data_.points.size()) {}

  Linearization linearize();

 private:
  void check(std::size_t cell) const;
  void share_given_middles();
  void cut_cell(std::size_t cell);
  void cut_lagrange(std::size_t cell);
  void cut_quadratic_tetra(std::span<const std::uint32_t> p);
  void cut_quadratic_hexahedron(std::span<const std::uint32_t> p);
  void cut_quadratic_wedge(std::span<const std::uint32_t> p);
  void cut_quadratic_linear_wedge(std::span<const std::uint32_t> p);
  void add(CellType type, std::initializer_list<std::uint32_t> points);
  [[nodiscard]] auto adder() {
    return
        [this](CellType type, std::initializer_list<std::uint32_t> points) { add(type, points); };
  }
  std::uint32_t middle(std::span<const std::uint32_t> cell, const Side& side);
  std::uint32_t centre(std::span<const std::uint32_t> hexahedron);
  void spread_cell_values();

  MeshData data_;
  bool quadratic_;
  Linearization out_;
  std::vector<std::size_t> parents_;                               ///< of each cell of the result
  std::size_t cell_ = 0;                                           ///< the one being cut
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> middles_;  ///< by sorted corners
  AddedPoints added_;
};

Linearization Linearizer::linearize() {
  out_.mesh.types.reserve(data_.cell_count());
  if (quadratic_) share_given_middles();
  for (cell_ = 0; cell_ < data_.cell_count(); ++cell_) {
    const CellType type = data_.types[cell_];
    if (is_lagrange(type) || (quadratic_ && is_quadratic(type))) {
      check(cell_);
      const std::size_t before = out_.mesh.cell_count();
      cut_cell(cell_);
      ++out_.cut;
      out_.pieces += out_.mesh.cell_count() - before;
    } else {
      out_.mesh.add_cell(type, data_.cell(cell_));
      parents_.push_back(cell_);
    }
  }
  out_.added = added_.count();
  added_.append_to(data_.points, data_.fields);
  spread_cell_values();
  out_.mesh.points = std::move(data_.points);
  out_.mesh.fields = std::move(data_.fields);
  out_.mesh.notes = std::move(data_.notes);
  return std::move(out_);
}

void Linearizer::check(std::size_t cell) const {
  const CellShape& shape = *find_shape(data_.types[cell]);
  const std::span<const std::uint32_t> points = data_.cell(cell);
  if (points.size() < static_cast<std::size_t>(std::max(shape.points, shape.corners))) {
    throw base::InputError(fmt::format("cell {} ({}) has {} points instead of {}", cell, shape.name,
                                       points.size(), std::max(shape.points, shape.corners)));
  }
  for (const std::uint32_t i : points) {
    if (i >= data_.points.size()) {
      throw base::InputError(fmt::format("cell {} ({}) names point {}, but there are {} points",
                                         cell, shape.name, i, data_.points.size()));
    }
  }
}

/// Where some cells have points in the middle of their quadrilaterals and others lack them, they
/// share those that are there.
void Linearizer::share_given_middles() {
  bool some_lack = false;
  bool some_have = false;
  const auto for_each_side = [&](const auto& f) {
    for (std::size_t cell = 0; cell < data_.cell_count(); ++cell) {
      if (!is_quadratic(data_.types[cell])) continue;
      check(cell);
      for (const Side& side : sides_of(data_.types[cell]))
        f(data_.types[cell], data_.cell(cell), side);
    }
  };
  for_each_side([&](CellType type, const auto&, const Side& side) {
    (has_middle(type, side) ? some_have : some_lack) = true;
  });
  if (!some_lack || !some_have) return;
  for_each_side([&](CellType type, auto cell, const Side& side) {
    if (has_middle(type, side)) {
      middles_.try_emplace(sorted_corners(cell, side), cell[side.middle]);
    }
  });
}

void Linearizer::cut_cell(std::size_t cell) {
  const std::span<const std::uint32_t> p = data_.cell(cell);
  const CellType type = data_.types[cell];
  if (is_lagrange(type)) return cut_lagrange(cell);
  switch (type) {
    case CellType::quadratic_tetra:
      return cut_quadratic_tetra(p);
    case CellType::quadratic_hexahedron:
    case CellType::biquadratic_quadratic_hexahedron:
    case CellType::triquadratic_hexahedron:
      return cut_quadratic_hexahedron(p);
    case CellType::quadratic_wedge:
    case CellType::biquadratic_quadratic_wedge:
      return cut_quadratic_wedge(p);
    case CellType::quadratic_linear_wedge:
      return cut_quadratic_linear_wedge(p);
    default:
      return cut_pyramid(p, middle(p, kPyramidBase), adder());
  }
}

void Linearizer::cut_lagrange(std::size_t cell) {
  const LagrangeLattice lattice(data_, cell);
  switch (data_.types[cell]) {
    case CellType::lagrange_tetra:
      return cut_tetra(lattice.orders()[0], lattice, adder());
    case CellType::lagrange_wedge:
      return cut_wedge(lattice.orders(), lattice, adder());
    default:
      return cut_box(lattice.orders(), lattice, adder());
  }
}

void Linearizer::cut_quadratic_tetra(std::span<const std::uint32_t> p) {
  constexpr auto kPlaces = std::to_array<Index>({{0, 0, 0},
                                                 {2, 0, 0},
                                                 {0, 2, 0},
                                                 {0, 0, 2},
                                                 {1, 0, 0},
                                                 {1, 1, 0},
                                                 {0, 1, 0},
                                                 {0, 0, 1},
                                                 {1, 0, 1},
                                                 {0, 1, 1}});
  const auto at = [&](int i, int j, int k) {
    return p[static_cast<std::size_t>(std::ranges::find(kPlaces, Index{i, j, k}) -
                                      kPlaces.begin())];
  };
  cut_tetra(2, at, adder());
}

void Linearizer::cut_quadratic_hexahedron(std::span<const std::uint32_t> p) {
  constexpr auto kCorners = std::to_array<Index>(
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}});
  constexpr auto kMiddlesOfSides =
      std::to_array<Index>({{0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}});
  std::array<std::uint32_t, 27> lattice{};
  const auto place = [&](Index i) -> std::uint32_t& {
    return lattice[static_cast<std::size_t>((i[2] * 3 + i[1]) * 3 + i[0])];
  };
  for (std::size_t i = 0; i < 8; ++i) place(kCorners[i]) = p[i];
  for (std::size_t i = 0; i < kMiddles.size(); ++i) {
    Index between{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      between[axis] = (kCorners[kMiddles[i][0]][axis] + kCorners[kMiddles[i][1]][axis]) / 2;
    }
    place(between) = p[8 + i];
  }
  for (std::size_t i = 0; i < 6; ++i) place(kMiddlesOfSides[i]) = middle(p, kHexahedronSides[i]);
  place({1, 1, 1}) = centre(p);
  const auto at = [&](int i, int j, int k) { return place({i, j, k}); };
  cut_box({2, 2, 2}, at, adder());
}

/// The points of a triangle's lattice of order 2: corners, then middles.
std::size_t place_in_triangle(int i, int j) {
  constexpr auto kPlaces =
      std::to_array<std::array<int, 2>>({{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}});
  return static_cast<std::size_t>(std::ranges::find(kPlaces, std::array{i, j}) - kPlaces.begin());
}

void Linearizer::cut_quadratic_wedge(std::span<const std::uint32_t> p) {
  // The lattices of the three triangles, from the first one up.
  const std::array<std::array<std::uint32_t, 6>, 3> levels = {
      {{p[0], p[1], p[2], p[6], p[7], p[8]},
       {p[12], p[13], p[14], middle(p, kWedgeSides[0]), middle(p, kWedgeSides[1]),
        middle(p, kWedgeSides[2])},
       {p[3], p[4], p[5], p[9], p[10], p[11]}}};
  const auto at = [&](int i, int j, int k) {
    return levels[static_cast<std::size_t>(k)][place_in_triangle(i, j)];
  };
  cut_wedge({2, 2, 2}, at, adder());
}

void Linearizer::cut_quadratic_linear_wedge(std::span<const std::uint32_t> p) {
  const std::array<std::array<std::uint32_t, 6>, 2> levels = {
      {{p[0], p[1], p[2], p[6], p[7], p[8]}, {p[3], p[4], p[5], p[9], p[10], p[11]}}};
  const auto at = [&](int i, int j, int k) {
    return levels[static_cast<std::size_t>(k)][place_in_triangle(i, j)];
  };
  cut_wedge({2, 2, 1}, at, adder());
}

void Linearizer::add(CellType type, std::initializer_list<std::uint32_t> points) {
  out_.mesh.add_cell(type, std::span(points.begin(), points.size()));
  parents_.push_back(cell_);
}

/// The point in the middle of a side: the cell's own, or that which it shares with its neighbour.
std::uint32_t Linearizer::middle(std::span<const std::uint32_t> cell, const Side& side) {
  if (has_middle(data_.types[cell_], side)) return cell[side.middle];
  const auto [entry, is_new] = middles_.try_emplace(sorted_corners(cell, side), 0);
  if (is_new) {
    AddedPoints::Weights weights;
    for (std::size_t i = 0; i < 8; ++i) weights.emplace_back(cell[side.at[i]], i < 4 ? -0.25 : 0.5);
    entry->second = added_.add(std::move(weights));
  }
  return entry->second;
}

/// The point in the middle of a hexahedron, by the shape functions of the points that it has.
std::uint32_t Linearizer::centre(std::span<const std::uint32_t> hexahedron) {
  AddedPoints::Weights weights;
  switch (data_.types[cell_]) {
    case CellType::triquadratic_hexahedron:
      return hexahedron[26];
    case CellType::biquadratic_quadratic_hexahedron:
      for (std::size_t i = 16; i < 20; ++i) weights.emplace_back(hexahedron[i], -0.25);
      for (std::size_t i = 20; i < 24; ++i) weights.emplace_back(hexahedron[i], 0.5);
      break;
    default:
      for (std::size_t i = 0; i < 8; ++i) weights.emplace_back(hexahedron[i], -0.25);
      for (std::size_t i = 8; i < 20; ++i) weights.emplace_back(hexahedron[i], 0.25);
      break;
  }
  return added_.add(std::move(weights));
}

void Linearizer::spread_cell_values() {
  for (Field& field : data_.fields) {
    const auto n = static_cast<std::size_t>(std::max(field.components, 1));
    if (field.location != Location::cell || field.values.size() != data_.cell_count() * n) continue;
    std::vector<double> values;
    values.reserve(parents_.size() * n);
    for (const std::size_t parent : parents_) {
      const auto first = field.values.begin() + static_cast<std::ptrdiff_t>(parent * n);
      values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(n));
    }
    field.values = std::move(values);
  }
}

}  // namespace

Linearization linearize(MeshData data, bool quadratic) {
  const bool has_curved = std::ranges::any_of(data.types, [&](CellType type) {
    return is_lagrange(type) || (quadratic && is_quadratic(type));
  });
  if (has_curved) return Linearizer(std::move(data), quadratic).linearize();
  Linearization untouched;
  untouched.mesh = std::move(data);
  return untouched;
}

}  // namespace tetraglass::mesh
