#include "project/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <png.h>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/suggest.h"
#include "project/npy.h"

namespace tetraglass::project {
namespace {

constexpr std::array<const char*, 4> kChannels = {"R", "G", "B", "A"};

std::string extension(const std::string& file) {
  std::string result = std::filesystem::path(file).extension().string();
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::string unknown_extension(const std::string& file) {
  return base::unknown_extension(extension(file), image_extensions());
}

WriteReport write_png(const Image& image, base::OutputFile& output, const Background& background) {
  WriteReport report;
  const Image encoded = encode(image, background);
  std::vector<png_byte> bytes(encoded.rgba.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<png_byte>(std::lround(255 * std::clamp(encoded.rgba[i], 0.0F, 1.0F)));
  }
  for (std::size_t i = 0; i < encoded.rgba.size(); i += 4) {
    const float* c = encoded.rgba.data() + i;
    // A rounding error above white is no loss: half a step of the 8-bit scale is.
    if (std::max({c[0], c[1], c[2]}) > 1 + 0.5F / 255) ++report.clipped_pixels;
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGBA;
  if (png_image_write_to_file(&png, output.temporary_path().c_str(), 0, bytes.data(), 0, nullptr) ==
      0) {
    throw base::WriteError(output.path(), std::string("cannot be written: ") + png.message);
  }
  return report;
}

void write_exr(const Image& image, base::OutputFile& output) {
  try {
    Imf::Header header(image.width, image.height);
    Imf::FrameBuffer frame;
    auto* base = reinterpret_cast<char*>(const_cast<float*>(image.rgba.data()));  // only read from
    const std::size_t stride = 4 * sizeof(float);
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
      header.channels().insert(kChannels[c], Imf::Channel(Imf::FLOAT));
      frame.insert(kChannels[c], Imf::Slice(Imf::FLOAT, base + c * sizeof(float), stride,
                                            stride * static_cast<std::size_t>(image.width)));
    }
    Imf::OutputFile file(output.temporary_path().c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const std::exception& error) {
    throw base::WriteError(output.path(), std::string("cannot be written: ") + error.what());
  }
}

ReadImage read_png(const std::string& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&png, file.c_str()) == 0)
    throw base::ReadError(file, png.message);
  png.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0) {
    throw base::ReadError(file, png.message);
  }
  ReadImage result{Image(static_cast<int>(png.width), static_cast<int>(png.height)), true};
  std::transform(bytes.begin(), bytes.end(), result.image.rgba.begin(),
                 [](png_byte byte) { return static_cast<float>(byte) / 255; });
  return result;
}

ReadImage read_exr(const std::string& file) {
  try {
    Imf::InputFile input(file.c_str());
    const auto window = input.header().dataWindow();
    ReadImage result{Image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1),
                     false};
    const std::size_t stride = 4 * sizeof(float);
    const std::size_t row = stride * static_cast<std::size_t>(result.image.width);
    char* base = reinterpret_cast<char*>(result.image.rgba.data()) -
                 static_cast<std::ptrdiff_t>(stride) * window.min.x -
                 static_cast<std::ptrdiff_t>(row) * window.min.y;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < kChannels.size(); ++c) {
      const double absent = c == 3 ? 1.0 : 0.0;
      frame.insert(kChannels[c],
                   Imf::Slice(Imf::FLOAT, base + c * sizeof(float), stride, row, 1, 1, absent));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
    return result;
  } catch (const std::exception& error) {
    throw base::ReadError(file,
                          std::string("is no OpenEXR picture that can be read: ") + error.what());
  }
}

ReadImage read_npy(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  NpyArray array = parse_npy(bytes, file);
  if (array.shape.size() != 3 || array.shape[2] != 4) {
    throw base::ReadError(file, "is no picture: its shape must be height x width x 4");
  }
  ReadImage result;
  result.image.height = static_cast<int>(array.shape[0]);
  result.image.width = static_cast<int>(array.shape[1]);
  result.image.rgba = std::move(array.values);
  return result;
}

}  // namespace

std::vector<std::string> image_extensions() {
  return {".png", ".exr", ".npy"};
}

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Image encode(const Image& image, const Background& background) {
  Image result(image.width, image.height);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const double through = 1 - static_cast<double>(image.rgba[i + 3]);
    const double alpha = image.rgba[i + 3] + through * background.alpha;
    for (std::size_t c = 0; c < 3; ++c) {
      const double premultiplied =
          image.rgba[i + c] + through * background.alpha * background.rgb[c];
      // A .png is not premultiplied; light without opacity (emission over a transparent background)
      // stays visible.
      const double straight = alpha > 0 ? premultiplied / alpha : premultiplied;
      result.rgba[i + c] = static_cast<float>(srgb_encode(std::max(0.0, straight)));
    }
    result.rgba[i + 3] = static_cast<float>(alpha);
  }
  return result;
}

WriteReport write_image(const Image& image, const std::string& file, const Background& background) {
  const std::string kind = extension(file);
  const std::vector<std::string> known = image_extensions();
  if (std::find(known.begin(), known.end(), kind) == known.end()) {
    throw base::WriteError(file, unknown_extension(file));
  }
  base::OutputFile output(file);
  WriteReport report;
  if (kind == ".png") {
    report = write_png(image, output, background);
  } else if (kind == ".exr") {
    write_exr(image, output);
  } else {
    const std::array<std::size_t, 3> shape = {static_cast<std::size_t>(image.height),
                                              static_cast<std::size_t>(image.width), 4};
    output.write(to_npy(shape, image.rgba));
  }
  output.commit();
  return report;
}

ReadImage read_image(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) throw base::ReadError(file, "there is no such file");
  const std::string kind = extension(file);
  if (kind == ".png") return read_png(file);
  if (kind == ".exr") return read_exr(file);
  if (kind == ".npy") return read_npy(file);
  throw base::ReadError(file, unknown_extension(file));
}

}  // namespace tetraglass::project
