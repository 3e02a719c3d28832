#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "mesh/mesh_data.h"

namespace tetraglass::mesh {

/// The types of values that files of volumes hold.
enum class ValueType : std::uint8_t {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

/// In bytes.
[[nodiscard]] std::size_t size_of(ValueType type);

/// A regular grid of values.
struct Volume {
  std::string name = "value";                          ///< of the field
  std::array<std::size_t, 3> size{};                   ///< points along each axis
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< the first point
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< column i: from a point to the next one
  int components = 1;
  std::vector<double> values;  ///< components fastest, then the first axis
  std::vector<std::string> notes;

  [[nodiscard]] std::size_t points() const { return size[0] * size[1] * size[2]; }
};

/// The number of values of a volume: the points times the components. Throws InputError where a
/// side has fewer than two points (there is nothing between them), where the axes do not span
/// space, and where a mesh of that size does not fit into memory.
[[nodiscard]] std::size_t checked_value_count(const Volume& volume);

/// Numbers in binary. `bytes` holds a whole number of them; `swapped`: not in this machine's byte
/// order.
[[nodiscard]] std::vector<double> decode_values(std::string_view bytes, ValueType type,
                                                bool swapped);

/// The volume as cells between its points: voxels, or hexahedra where the axes are turned.
[[nodiscard]] MeshData volume_mesh(Volume volume);

}  // namespace tetraglass::mesh
