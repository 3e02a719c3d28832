#pragma once

#include <cstddef>
#include <vector>

namespace tetraglass::project {

/// Linear, premultiplied RGBA, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgba;  ///< 4 per pixel, row by row

  Image() = default;
  Image(int w, int h)
      : width(w), height(h), rgba(4 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  [[nodiscard]] float* pixel(int x, int y) { return rgba.data() + 4 * index(x, y); }
  [[nodiscard]] const float* pixel(int x, int y) const { return rgba.data() + 4 * index(x, y); }

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

}  // namespace tetraglass::project
