#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "base/errors.h"
#include "base/suggest.h"
#include "preint/color_spaces.h"
#include "preint/preset_scale.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {
namespace {

constexpr std::size_t kKeys = 17;

/// Colors at equal steps of the range, sRGB as 0xRRGGBB.
struct ColorMap {
  const char* name;
  std::array<std::uint32_t, kKeys> srgb;
};

/// The tables of their authors, read at every sixteenth:
/// viridis, inferno: van der Walt and Smith, 2015 (matplotlib; CC0).
/// cividis: Nunez, Anderton and Renslow, PLoS ONE 13(7), 2018.
/// turbo: Mikhailov, Google, 2019 (Apache 2.0).
/// coolwarm: Moreland, "Diverging color maps for scientific visualization", ISVC 2009.
constexpr std::array<ColorMap, 6> kColorMaps = {{
    {"viridis",
     {0x440154, 0x48186a, 0x472d7b, 0x424086, 0x3b528b, 0x33638d, 0x2c728e, 0x26818e, 0x21908c,
      0x1f9f88, 0x28ae80, 0x3ebc74, 0x5dc963, 0x82d34c, 0xabdc32, 0xd5e21a, 0xfde725}},
    {"inferno",
     {0x000004, 0x0b0724, 0x210c4a, 0x3c0965, 0x57106d, 0x70196e, 0x89226a, 0xa32b61, 0xbb3755,
      0xd14644, 0xe35932, 0xf1711e, 0xf98d0a, 0xfcab0f, 0xf9ca32, 0xf2e865, 0xfcffa4}},
    {"cividis",
     {0x00224e, 0x002e6a, 0x1a386f, 0x32436d, 0x434e6c, 0x52596d, 0x61656f, 0x6f7073, 0x7c7b78,
      0x8b8778, 0x9b9376, 0xaba072, 0xbbad6c, 0xccba64, 0xddc958, 0xefd748, 0xfee838}},
    {"coolwarm",
     {0x3b4cc0, 0x4d68d7, 0x6282ea, 0x779af7, 0x8db0fe, 0xa3c2ff, 0xb8d0f9, 0xccd9ee, 0xdddddd,
      0xecd3c5, 0xf5c4ad, 0xf7b194, 0xf49a7b, 0xec7f63, 0xde604d, 0xcb3e38, 0xb40426}},
    {"turbo",
     {0x30123b, 0x4040a1, 0x466be3, 0x4293ff, 0x29bbec, 0x18dcc3, 0x31f299, 0x6bfd64, 0xa3fd3c,
      0xcced34, 0xedd03a, 0xfdae35, 0xfb8022, 0xec520f, 0xd23105, 0xac1701, 0x7a0403}},
    {"grey",
     {0x000000, 0x101010, 0x202020, 0x303030, 0x404040, 0x505050, 0x606060, 0x707070, 0x808080,
      0x8f8f8f, 0x9f9f9f, 0xafafaf, 0xbfbfbf, 0xcfcfcf, 0xdfdfdf, 0xefefef, 0xffffff}},
}};

/// x-ray: the same everywhere. A body half as thick as the diagonal takes half of the light.
constexpr double kDepthOfXRay = 1.4;

constexpr const char* kXRay = "x-ray";

Color linear_color(std::uint32_t srgb) {
  const auto channel = [&](unsigned shift) {
    return linear_from_srgb(static_cast<double>((srgb >> shift) & 0xffU) / 255);
  };
  return {channel(16), channel(8), channel(0)};
}

const ColorMap& color_map(const std::string& name) {
  const auto found = std::find_if(kColorMaps.begin(), kColorMaps.end(),
                                  [&](const ColorMap& map) { return name == map.name; });
  if (found == kColorMaps.end()) {
    throw base::UsageError(fmt::format("there is no transfer function preset '{}'{}", name,
                                       base::suggestion(name, preset_names())));
  }
  return *found;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  names.reserve(kColorMaps.size() + 1);
  for (const ColorMap& map : kColorMaps) names.emplace_back(map.name);
  names.emplace_back(kXRay);
  return names;
}

TransferFunction preset(const std::string& name, double low, double high, double diagonal) {
  const bool x_ray = name == kXRay;
  const ColorMap* map = x_ray ? nullptr : &color_map(name);
  if (!(low <= high)) {
    throw base::UsageError(
        fmt::format("a preset needs a range of values from low to high, not {}:{}", low, high));
  }
  if (!(diagonal > 0)) {
    throw base::InputError(
        fmt::format("preset '{}' gives opacity relative to the mesh's size, but its diagonal is {}",
                    name, diagonal));
  }
  if (x_ray) return TransferFunction({{low, Color::Ones(), kDepthOfXRay / diagonal}});

  const double most = kDepthAtTop / diagonal;
  if (low == high) {  // the one value is as much the middle of the range as anything
    return TransferFunction({{low, linear_color(map->srgb[kKeys / 2]), most / 2}});
  }
  std::vector<ControlPoint> points;
  for (std::size_t i = 0; i < kKeys; ++i) {
    const double t = static_cast<double>(i) / (kKeys - 1);
    const ControlPoint point{low * (1 - t) + high * t, linear_color(map->srgb[i]), most * t};
    // A range of a few rounding errors has fewer different values than the map has colors.
    if (!points.empty() && point.value <= points.back().value) {
      if (i + 1 == kKeys) points.back() = point;
      continue;
    }
    points.push_back(point);
  }
  return TransferFunction(std::move(points));
}

}  // namespace tetraglass::preint
