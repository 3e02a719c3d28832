#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace tetraglass::mesh {

/// Arrays of plain values as one block of bytes, on their way from a process to its parent
/// (run_apart.h). They are taken out in the order in which they were put in.
class Parcel {
 public:
  explicit Parcel(std::string content = {}) : bytes(std::move(content)) {}

  template <typename T>
  void put(const T* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  template <typename T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), bytes.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
    return values;
  }
  std::string bytes;

 private:
  std::size_t at_ = 0;
};

}  // namespace tetraglass::mesh
