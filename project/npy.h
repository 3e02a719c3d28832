#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tetraglass::project {

/// An array in NumPy's format, version 1.0, little-endian float32 in C order.
struct NpyArray {
  std::vector<std::size_t> shape;
  std::vector<float> values;
};

/// The bytes of the file. `values` holds as many numbers as the shape says.
[[nodiscard]] std::string to_npy(std::span<const std::size_t> shape, std::span<const float> values);

/// Takes float32 and float64, little-endian, C order, format versions 1 to 3. `file` is for
/// messages. Throws ReadError, also where the array's size and the file's disagree.
[[nodiscard]] NpyArray parse_npy(const std::string& bytes, const std::string& file);

}  // namespace tetraglass::project
