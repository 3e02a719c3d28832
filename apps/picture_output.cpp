#include "apps/picture_output.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "apps/mesh_input.h"
#include "project/image_file.h"

namespace tetraglass::apps {
namespace {

using project::Mode;

float largest_length(const project::Image& image) {
  float longest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) longest = std::max(longest, image.rgba[i]);
  return longest;
}

}  // namespace

project::Image scaled_for_8_bits(const project::Image& image, Mode mode) {
  project::Image scaled = image;
  if (mode != Mode::thickness) return scaled;
  const float longest = largest_length(image);
  if (longest > 0) {
    for (std::size_t i = 0; i < scaled.rgba.size(); ++i) {
      if (i % 4 != 3) scaled.rgba[i] /= longest;
    }
  }
  return scaled;
}

void write_pictures(const RenderArguments& arguments, Mode mode, const project::Image& image) {
  const project::Background background = make_background(arguments, mode);
  for (const std::string& output : arguments.outputs) {
    const bool png =
        output.size() > 4 && CLI::detail::to_lower(output.substr(output.size() - 4)) == ".png";
    const project::WriteReport report =
        project::write_image(png ? scaled_for_8_bits(image, mode) : image, output, background);
    if (png && mode == Mode::thickness) {
      fmt::print(stderr, "thickness in .png: white is {:.6g}\n", largest_length(image));
    }
    if (report.clipped_pixels > 0) {
      warn(fmt::format(
          "{}: {} pixels are brighter than white and were clipped; .exr and .npy keep them", output,
          report.clipped_pixels));
    }
  }
}

}  // namespace tetraglass::apps
