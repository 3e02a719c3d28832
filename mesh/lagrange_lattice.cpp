#include "mesh/lagrange_lattice.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkHigherOrderTetra.h>
#include <vtkHigherOrderWedge.h>

#include "base/errors.h"

namespace tetraglass::mesh {
namespace {

using Orders = std::array<int, 3>;

constexpr int kMostOrder = 64;  // VTK's own limit is 10

int point_count(CellType type, const Orders& orders) {
  const auto& [p, q, r] = orders;
  switch (type) {
    case CellType::lagrange_tetra:
      return (p + 1) * (p + 2) * (p + 3) / 6;
    case CellType::lagrange_wedge:
      return (p + 1) * (p + 2) / 2 * (r + 1);
    default:
      return (p + 1) * (q + 1) * (r + 1);
  }
}

/// What the field HigherOrderDegrees says.
std::optional<Orders> told_orders(const MeshData& data, std::size_t cell) {
  for (const Field& field : data.fields) {
    if (field.name != "HigherOrderDegrees" || field.location != Location::cell ||
        field.components != 3 || field.values.size() != 3 * data.cell_count()) {
      continue;
    }
    Orders orders{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = field.values[3 * cell + i];
      if (!(value >= 1 && value <= kMostOrder)) return std::nullopt;
      orders[i] = static_cast<int>(value);
    }
    return orders;
  }
  return std::nullopt;
}

Orders find_orders(const MeshData& data, std::size_t cell) {
  const CellType type = data.types[cell];
  const std::size_t count = data.cell(cell).size();
  const auto fits = [&](const Orders& orders) {
    return static_cast<std::size_t>(point_count(type, orders)) == count;
  };
  for (int n = 1; n <= kMostOrder; ++n) {
    if (fits({n, n, n})) return {n, n, n};
  }
  const std::optional<Orders> told = told_orders(data, cell);
  const bool may_differ = type == CellType::lagrange_hexahedron ||
                          (type == CellType::lagrange_wedge && told && (*told)[0] == (*told)[1]);
  if (!told || !may_differ || !fits(*told)) {
    throw base::InputError(fmt::format("cell {} ({}) has {} points, which is no number of its type",
                                       cell, to_string(type), count));
  }
  return *told;
}

}  // namespace

LagrangeLattice::LagrangeLattice(const MeshData& data, std::size_t cell)
    : type_(data.types[cell]), points_(data.cell(cell)), orders_(find_orders(data, cell)) {}

std::uint32_t LagrangeLattice::operator()(int i, int j, int k) const {
  const auto at = [&]() -> vtkIdType {
    if (type_ == CellType::lagrange_tetra) {
      const std::array<vtkIdType, 4> barycentric = {i, j, k, orders_[0] - i - j - k};
      return vtkHigherOrderTetra::Index(barycentric.data(), orders_[0]);
    }
    if (type_ == CellType::lagrange_wedge) {
      // In VTK its first triangle is seen from inside.
      const std::array<int, 4> orders = {orders_[0], orders_[1], orders_[2],
                                         static_cast<int>(points_.size())};
      return vtkHigherOrderWedge::PointIndexFromIJK(i, j, orders_[2] - k, orders.data());
    }
    return vtkHigherOrderHexahedron::PointIndexFromIJK(i, j, k, orders_.data());
  };
  return points_[static_cast<std::size_t>(at())];
}

}  // namespace tetraglass::mesh
