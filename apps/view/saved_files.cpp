#include "apps/view/saved_files.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "project/image_file.h"

namespace tetraglass::apps::view {

std::string free_name(const std::string& name, const std::vector<std::string>& extensions) {
  for (int i = 1;; ++i) {
    std::string numbered = fmt::format("{}-{}", name, i);
    const bool taken = std::ranges::any_of(extensions, [&](const std::string& extension) {
      std::error_code ignored;
      return std::filesystem::exists(numbered + extension, ignored);
    });
    if (!taken) return numbered;
  }
}

void save_pixels(const std::vector<std::uint8_t>& pixels, int width, int height,
                 const std::string& file) {
  project::Image image(width, height);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    image.rgba[i] = i % 4 == 3 ? 1.0F : static_cast<float>(project::srgb_decode(pixels[i] / 255.0));
  }
  project::write_image(image, file);
}

void print_result(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace tetraglass::apps::view
