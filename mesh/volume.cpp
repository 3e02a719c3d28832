#include "mesh/volume.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/errors.h"
#include "mesh/memory.h"

namespace tetraglass::mesh {
namespace {

template <typename T>
void decode(std::string_view bytes, bool swapped, std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes.data() + i * sizeof(T), sizeof(T));
    if (swapped) std::ranges::reverse(raw);
    values[i] = static_cast<double>(std::bit_cast<T>(raw));
  }
}

/// Whether the axes are those of space, so that the cells are voxels.
bool is_straight(const Eigen::Matrix3d& axes) {
  return axes.isDiagonal(0) && (axes.diagonal().array() > 0).all();
}

}  // namespace

std::size_t size_of(ValueType type) {
  constexpr std::array<std::size_t, 10> kSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t checked_value_count(const Volume& volume) {
  const auto& [nx, ny, nz] = volume.size;
  if (nx < 2 || ny < 2 || nz < 2) {
    throw base::InputError(
        fmt::format("holds {} x {} x {} points, which is no volume: two along each axis are needed",
                    nx, ny, nz));
  }
  if (!volume.axes.allFinite() || !volume.origin.allFinite() || volume.axes.determinant() == 0) {
    throw base::InputError("its axes or its spacing do not span space");
  }
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (nx > kMost / ny || nx * ny > kMost / nz) {
    throw base::InputError(
        fmt::format("{} x {} x {} points are more than can be numbered in 32 bits", nx, ny, nz));
  }
  constexpr int kMostComponents = 1 << 16;
  if (volume.components < 1 || volume.components > kMostComponents) {
    throw base::InputError(fmt::format("{} values at each point cannot be", volume.components));
  }
  // A point is counted with six numbers.
  check_mesh_fits(volume.points(), (nx - 1) * (ny - 1) * (nz - 1));
  check_mesh_fits(volume.points() * static_cast<std::size_t>(volume.components) / 6, 0);
  return volume.points() * static_cast<std::size_t>(volume.components);
}

std::vector<double> decode_values(std::string_view bytes, ValueType type, bool swapped) {
  std::vector<double> values(bytes.size() / size_of(type));
  switch (type) {
    case ValueType::int8:
      decode<std::int8_t>(bytes, swapped, values);
      break;
    case ValueType::uint8:
      decode<std::uint8_t>(bytes, swapped, values);
      break;
    case ValueType::int16:
      decode<std::int16_t>(bytes, swapped, values);
      break;
    case ValueType::uint16:
      decode<std::uint16_t>(bytes, swapped, values);
      break;
    case ValueType::int32:
      decode<std::int32_t>(bytes, swapped, values);
      break;
    case ValueType::uint32:
      decode<std::uint32_t>(bytes, swapped, values);
      break;
    case ValueType::int64:
      decode<std::int64_t>(bytes, swapped, values);
      break;
    case ValueType::uint64:
      decode<std::uint64_t>(bytes, swapped, values);
      break;
    case ValueType::float32:
      decode<float>(bytes, swapped, values);
      break;
    case ValueType::float64:
      decode<double>(bytes, swapped, values);
      break;
  }
  return values;
}

MeshData volume_mesh(Volume volume) {
  const auto& [nx, ny, nz] = volume.size;
  MeshData mesh;
  mesh.notes = std::move(volume.notes);
  mesh.points.reserve(volume.points());
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      const Eigen::Vector3d row = volume.origin + static_cast<double>(j) * volume.axes.col(1) +
                                  static_cast<double>(k) * volume.axes.col(2);
      for (std::size_t i = 0; i < nx; ++i) {
        mesh.points.emplace_back(row + static_cast<double>(i) * volume.axes.col(0));
      }
    }
  }
  const std::size_t cells = (nx - 1) * (ny - 1) * (nz - 1);
  mesh.types.reserve(cells);
  mesh.offsets.reserve(cells + 1);
  mesh.connectivity.reserve(8 * cells);
  const CellType type = is_straight(volume.axes) ? CellType::voxel : CellType::hexahedron;
  // The corners of a hexahedron go round; left-handed axes have its bottom and top exchanged.
  constexpr std::array<std::array<std::size_t, 8>, 3> kOrders = {
      {{0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 3, 2, 4, 5, 7, 6}, {4, 5, 7, 6, 0, 1, 3, 2}}};
  const std::array<std::size_t, 8>& order =
      kOrders[type == CellType::voxel ? 0 : (volume.axes.determinant() > 0 ? 1 : 2)];
  for (std::size_t k = 0; k + 1 < nz; ++k) {
    for (std::size_t j = 0; j + 1 < ny; ++j) {
      for (std::size_t i = 0; i + 1 < nx; ++i) {
        std::array<std::uint32_t, 8> cell{};
        for (std::size_t v = 0; v < 8; ++v) {
          const std::size_t bits = order[v];
          cell[v] = static_cast<std::uint32_t>(
              ((k + (bits >> 2U)) * ny + j + (bits >> 1U & 1U)) * nx + i + (bits & 1U));
        }
        mesh.add_cell(type, cell);
      }
    }
  }
  mesh.fields.push_back(
      {volume.name, Location::point, volume.components, std::move(volume.values)});
  return mesh;
}

}  // namespace tetraglass::mesh
