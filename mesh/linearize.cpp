#include "mesh/linearize.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>

#include "base/errors.h"
#include "mesh/cell_shapes.h"

namespace tetraglass::mesh {
namespace {

using Index = std::array<int, 3>;

constexpr int kMostOrder = 64;  // VTK's own limit is 10

bool is_lagrange(CellType type) {
  return type == CellType::lagrange_tetra || type == CellType::lagrange_hexahedron ||
         type == CellType::lagrange_wedge;
}

bool is_quadratic(CellType type) {
  return type == CellType::quadratic_tetra || type == CellType::quadratic_hexahedron ||
         type == CellType::triquadratic_hexahedron || type == CellType::quadratic_wedge ||
         type == CellType::biquadratic_quadratic_wedge || type == CellType::quadratic_pyramid;
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
};

// In the order of the points in the middle of them: -x +x -y +y -z +z.
constexpr auto kHexahedronSides = std::to_array<Side>({{{0, 4, 7, 3, 16, 15, 19, 11}},
                                                       {{1, 2, 6, 5, 9, 18, 13, 17}},
                                                       {{0, 1, 5, 4, 8, 17, 12, 16}},
                                                       {{3, 7, 6, 2, 19, 14, 18, 10}},
                                                       {{0, 3, 2, 1, 11, 10, 9, 8}},
                                                       {{4, 5, 6, 7, 12, 13, 14, 15}}});
constexpr auto kWedgeSides = std::to_array<Side>(
    {{{0, 1, 4, 3, 6, 13, 9, 12}}, {{1, 2, 5, 4, 7, 14, 10, 13}}, {{2, 0, 3, 5, 8, 12, 11, 14}}});
constexpr Side kPyramidBase = {{0, 1, 2, 3, 5, 6, 7, 8}};

class Linearizer {
 public:
  Linearizer(MeshData data, bool quadratic) : data_(std::move(data)), quadratic_(quadratic) {}

  Linearization linearize();

 private:
  void check(std::size_t cell) const;
  void cut_cell(std::size_t cell);
  [[noreturn]] void fail_count(std::size_t cell) const;
  [[nodiscard]] std::optional<Index> degrees(std::size_t cell) const;
  [[nodiscard]] Index box_orders(std::size_t cell) const;
  [[nodiscard]] Index wedge_orders(std::size_t cell) const;
  void cut_lagrange_tetra(std::size_t cell);
  void cut_quadratic_tetra(std::span<const std::uint32_t> p);
  void cut_quadratic_hexahedron(std::span<const std::uint32_t> p, bool has_middles);
  void cut_quadratic_wedge(std::span<const std::uint32_t> p, bool has_middles);
  void cut_quadratic_pyramid(std::span<const std::uint32_t> p);
  template <typename At>
  void cut_tetra(int order, const At& at);
  template <typename At>
  void cut_box(Index orders, const At& at);
  template <typename At>
  void cut_wedge(Index orders, const At& at);
  void add(CellType type, std::initializer_list<std::uint32_t> points);
  std::uint32_t middle(std::span<const std::uint32_t> cell, const Side& side);
  std::uint32_t add_point(std::vector<std::pair<std::uint32_t, double>> weights);
  void add_point_values();
  void spread_cell_values();

  MeshData data_;
  bool quadratic_;
  Linearization out_;
  std::vector<std::size_t> parents_;                               ///< of each cell of the result
  std::size_t cell_ = 0;                                           ///< the one being cut
  std::map<std::array<std::uint32_t, 4>, std::uint32_t> middles_;  ///< by sorted corners
  std::vector<std::vector<std::pair<std::uint32_t, double>>> weights_;  ///< of the added points
};

Linearization Linearizer::linearize() {
  out_.mesh.types.reserve(data_.cell_count());
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
  out_.added = weights_.size();
  add_point_values();
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
    fail_count(cell);
  }
  for (const std::uint32_t i : points) {
    if (i >= data_.points.size()) {
      throw base::InputError(fmt::format("cell {} ({}) names point {}, but there are {} points",
                                         cell, shape.name, i, data_.points.size()));
    }
  }
}

void Linearizer::fail_count(std::size_t cell) const {
  throw base::InputError(fmt::format("cell {} ({}) has {} points, which is no number of its type",
                                     cell, to_string(data_.types[cell]), data_.cell(cell).size()));
}

/// What the field HigherOrderDegrees says.
std::optional<Index> Linearizer::degrees(std::size_t cell) const {
  for (const Field& field : data_.fields) {
    if (field.name != "HigherOrderDegrees" || field.location != Location::cell ||
        field.components != 3 || field.values.size() != 3 * data_.cell_count()) {
      continue;
    }
    Index degrees{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = field.values[3 * cell + i];
      if (!(value >= 1 && value <= kMostOrder)) return std::nullopt;
      degrees[i] = static_cast<int>(value);
    }
    return degrees;
  }
  return std::nullopt;
}

Index Linearizer::box_orders(std::size_t cell) const {
  const auto count = static_cast<int>(std::min<std::size_t>(data_.cell(cell).size(), 1U << 24U));
  for (int n = 1; n <= kMostOrder; ++n) {
    if ((n + 1) * (n + 1) * (n + 1) == count) return {n, n, n};
  }
  const auto told = degrees(cell);
  if (!told || ((*told)[0] + 1) * ((*told)[1] + 1) * ((*told)[2] + 1) != count) fail_count(cell);
  return *told;
}

Index Linearizer::wedge_orders(std::size_t cell) const {
  const auto count = static_cast<int>(std::min<std::size_t>(data_.cell(cell).size(), 1U << 24U));
  for (int n = 1; n <= kMostOrder; ++n) {
    if ((n + 1) * (n + 2) / 2 * (n + 1) == count) return {n, n, n};
  }
  const auto told = degrees(cell);
  if (!told || (*told)[0] != (*told)[1] ||
      ((*told)[0] + 1) * ((*told)[0] + 2) / 2 * ((*told)[2] + 1) != count) {
    fail_count(cell);
  }
  return *told;
}

void Linearizer::cut_cell(std::size_t cell) {
  const std::span<const std::uint32_t> p = data_.cell(cell);
  switch (data_.types[cell]) {
    case CellType::lagrange_tetra:
      cut_lagrange_tetra(cell);
      break;
    case CellType::lagrange_hexahedron: {
      const Index orders = box_orders(cell);
      cut_box(orders, [&](int i, int j, int k) {
        return p[static_cast<std::size_t>(
            vtkHigherOrderHexahedron::PointIndexFromIJK(i, j, k, orders.data()))];
      });
      break;
    }
    case CellType::lagrange_wedge: {
      const Index orders = wedge_orders(cell);
      const std::array<int, 4> vtk_orders = {orders[0], orders[1], orders[2],
                                             static_cast<int>(p.size())};
      // Its first triangle is seen from inside, the linear wedge's from outside.
      cut_wedge(orders, [&](int i, int j, int k) {
        return p[static_cast<std::size_t>(
            vtkHigherOrderWedge::PointIndexFromIJK(i, j, orders[2] - k, vtk_orders.data()))];
      });
      break;
    }
    case CellType::quadratic_tetra:
      cut_quadratic_tetra(p);
      break;
    case CellType::quadratic_hexahedron:
    case CellType::triquadratic_hexahedron:
      cut_quadratic_hexahedron(p, data_.types[cell] == CellType::triquadratic_hexahedron);
      break;
    case CellType::quadratic_wedge:
    case CellType::biquadratic_quadratic_wedge:
      cut_quadratic_wedge(p, data_.types[cell] == CellType::biquadratic_quadratic_wedge);
      break;
    default:
      cut_quadratic_pyramid(p);
      break;
  }
}

void Linearizer::cut_lagrange_tetra(std::size_t cell) {
  const std::span<const std::uint32_t> p = data_.cell(cell);
  int order = 1;
  const auto points = [](int n) {
    return static_cast<std::size_t>((n + 1) * (n + 2) * (n + 3) / 6);
  };
  while (order < kMostOrder && points(order) < p.size()) ++order;
  if (points(order) != p.size()) fail_count(cell);
  cut_tetra(order, [&](int i, int j, int k) {
    const std::array<vtkIdType, 4> barycentric = {i, j, k, order - i - j - k};
    return p[static_cast<std::size_t>(vtkHigherOrderTetra::Index(barycentric.data(), order))];
  });
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
  cut_tetra(2, [&](int i, int j, int k) {
    return p[static_cast<std::size_t>(std::ranges::find(kPlaces, Index{i, j, k}) -
                                      kPlaces.begin())];
  });
}

/// Small tetrahedra at the points of the lattice, with octahedra and tetrahedra upside down between
/// them. The triangles on the sides do not depend on how octahedra are cut.
template <typename At>
void Linearizer::cut_tetra(int order, const At& at) {
  for (int k = 0; k < order; ++k) {
    for (int j = 0; j + k < order; ++j) {
      for (int i = 0; i + j + k < order; ++i) {
        const std::uint32_t x = at(i + 1, j, k);
        const std::uint32_t y = at(i, j + 1, k);
        const std::uint32_t z = at(i, j, k + 1);
        add(CellType::tetra, {at(i, j, k), x, y, z});
        if (i + j + k > order - 2) continue;
        const std::uint32_t xy = at(i + 1, j + 1, k);
        const std::uint32_t yz = at(i, j + 1, k + 1);
        const std::uint32_t xz = at(i + 1, j, k + 1);
        add(CellType::tetra, {x, yz, y, z});  // the octahedron, around its diagonal x yz
        add(CellType::tetra, {x, yz, xy, y});
        add(CellType::tetra, {x, yz, xz, xy});
        add(CellType::tetra, {x, yz, z, xz});
        if (i + j + k > order - 3) continue;
        add(CellType::tetra, {xy, yz, xz, at(i + 1, j + 1, k + 1)});
      }
    }
  }
}

template <typename At>
void Linearizer::cut_box(Index orders, const At& at) {
  for (int k = 0; k < orders[2]; ++k) {
    for (int j = 0; j < orders[1]; ++j) {
      for (int i = 0; i < orders[0]; ++i) {
        add(CellType::hexahedron,
            {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
             at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
    }
  }
}

template <typename At>
void Linearizer::cut_wedge(Index orders, const At& at) {
  for (int k = 0; k < orders[2]; ++k) {
    for (int j = 0; j < orders[0]; ++j) {
      for (int i = 0; i + j < orders[0]; ++i) {
        add(CellType::wedge, {at(i, j, k), at(i + 1, j, k), at(i, j + 1, k), at(i, j, k + 1),
                              at(i + 1, j, k + 1), at(i, j + 1, k + 1)});
        if (i + j > orders[0] - 2) continue;
        add(CellType::wedge, {at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                              at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
    }
  }
}

void Linearizer::cut_quadratic_hexahedron(std::span<const std::uint32_t> p, bool has_middles) {
  constexpr auto kCorners = std::to_array<Index>(
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}});
  constexpr auto kSides = std::to_array<Index>(
      {{0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}, {1, 1, 1}});
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
  for (std::size_t i = 0; i < 6; ++i) {
    place(kSides[i]) = has_middles ? p[20 + i] : middle(p, kHexahedronSides[i]);
  }
  if (has_middles) {
    place(kSides[6]) = p[26];
  } else {
    std::vector<std::pair<std::uint32_t, double>> weights;
    for (std::size_t i = 0; i < 8; ++i) weights.emplace_back(p[i], -0.25);
    for (std::size_t i = 8; i < 20; ++i) weights.emplace_back(p[i], 0.25);
    place(kSides[6]) = add_point(std::move(weights));
  }
  cut_box({2, 2, 2}, [&](int i, int j, int k) { return place({i, j, k}); });
}

void Linearizer::cut_quadratic_wedge(std::span<const std::uint32_t> p, bool has_middles) {
  std::array<std::uint32_t, 3> sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    sides[i] = has_middles ? p[15 + i] : middle(p, kWedgeSides[i]);
  }
  // The lattices of the three triangles, from the first one up: corners, then middles.
  const std::array<std::array<std::uint32_t, 6>, 3> levels = {
      {{p[0], p[1], p[2], p[6], p[7], p[8]},
       {p[12], p[13], p[14], sides[0], sides[1], sides[2]},
       {p[3], p[4], p[5], p[9], p[10], p[11]}}};
  constexpr auto kPlaces =
      std::to_array<std::array<int, 2>>({{0, 0}, {2, 0}, {0, 2}, {1, 0}, {1, 1}, {0, 1}});
  cut_wedge({2, 2, 2}, [&](int i, int j, int k) {
    const auto* found = std::ranges::find(kPlaces, std::array{i, j});
    return levels[static_cast<std::size_t>(k)][static_cast<std::size_t>(found - kPlaces.begin())];
  });
}

void Linearizer::cut_quadratic_pyramid(std::span<const std::uint32_t> p) {
  const std::uint32_t c = middle(p, kPyramidBase);
  add(CellType::pyramid, {p[0], p[5], c, p[8], p[9]});
  add(CellType::pyramid, {p[5], p[1], p[6], c, p[10]});
  add(CellType::pyramid, {c, p[6], p[2], p[7], p[11]});
  add(CellType::pyramid, {p[8], c, p[7], p[3], p[12]});
  add(CellType::pyramid, {p[9], p[10], p[11], p[12], p[4]});
  add(CellType::pyramid, {p[12], p[11], p[10], p[9], c});
  for (std::size_t i = 0; i < 4; ++i) {  // below the sides
    add(CellType::tetra, {p[5 + i], c, p[9 + i], p[9 + (i + 1) % 4]});
  }
}

void Linearizer::add(CellType type, std::initializer_list<std::uint32_t> points) {
  out_.mesh.add_cell(type, std::span(points.begin(), points.size()));
  parents_.push_back(cell_);
}

/// The point in the middle of a side of eight points, which the neighbour shares.
std::uint32_t Linearizer::middle(std::span<const std::uint32_t> cell, const Side& side) {
  std::array<std::uint32_t, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) corners[i] = cell[side.at[i]];
  std::ranges::sort(corners);
  if (const auto found = middles_.find(corners); found != middles_.end()) return found->second;
  std::vector<std::pair<std::uint32_t, double>> weights;
  for (std::size_t i = 0; i < 8; ++i) weights.emplace_back(cell[side.at[i]], i < 4 ? -0.25 : 0.5);
  return middles_[corners] = add_point(std::move(weights));
}

std::uint32_t Linearizer::add_point(std::vector<std::pair<std::uint32_t, double>> weights) {
  const std::size_t number = data_.points.size() + weights_.size();
  if (number >= std::numeric_limits<std::uint32_t>::max()) {
    throw base::InputError(
        "more points than can be numbered in 32 bits, with those that are added");
  }
  weights_.push_back(std::move(weights));
  return static_cast<std::uint32_t>(number);
}

void Linearizer::add_point_values() {
  const std::size_t given = data_.points.size();
  for (const auto& weights : weights_) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [point, weight] : weights) sum += weight * data_.points[point];
    data_.points.push_back(sum);
  }
  for (Field& field : data_.fields) {
    const auto n = static_cast<std::size_t>(std::max(field.components, 1));
    if (field.location != Location::point || field.values.size() != given * n) continue;
    for (const auto& weights : weights_) {
      for (std::size_t c = 0; c < n; ++c) {
        double sum = 0;
        for (const auto& [point, weight] : weights) sum += weight * field.values[point * n + c];
        field.values.push_back(sum);
      }
    }
  }
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
