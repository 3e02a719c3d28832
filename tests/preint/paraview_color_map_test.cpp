#include "preint/paraview_color_map.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/color_spaces.h"

namespace tetraglass::preint {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ParaviewColorMap : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  TransferFunction read(const std::string& text, const std::string& name = "", double low = 0,
                        double high = 1, double diagonal = 10) const {
    std::ofstream(file_) << text;
    return read_paraview_color_map(file_, name, low, high, diagonal);
  }

  template <class Error = base::ReadError>
  std::string error(const std::string& text, const std::string& name = "") const {
    try {
      read(text, name);
    } catch (const Error& e) {
      return e.what();
    }
    return "no such error";
  }

  std::string file_ = testing::TempDir() + "/color_map_" +
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

constexpr const char* kCoolToWarm = R"([{"ColorSpace": "Diverging", "Name": "Cool to Warm",
  "NanColor": [1, 1, 0],
  "RGBPoints": [-1, 0.231373, 0.298039, 0.752941, 1, 0.705882, 0.0156863, 0.14902]}])";

TEST_F(ParaviewColorMap, DivergingIsMorelandsMap) {
  const TransferFunction read_map = read(kCoolToWarm, "", 300, 400, 25);
  const TransferFunction built_in = preset("coolwarm", 300, 400, 25);
  EXPECT_EQ(read_map.points().front().value, 300);
  EXPECT_EQ(read_map.points().back().value, 400);
  for (double v = 300; v <= 400; v += 6.25) {
    // The table of the preset is rounded to 8 bits of sRGB, which is 1 / 110 of linear light at
    // most.
    EXPECT_LE((read_map.at(v).color - built_in.at(v).color).abs().maxCoeff(), 0.012) << v;
    EXPECT_NEAR(read_map.at(v).extinction, built_in.at(v).extinction, 1e-12) << v;
  }
}

TEST_F(ParaviewColorMap, SpacesOfInterpolation) {
  const auto middle = [&](const std::string& space) -> Color {
    return read(R"({"ColorSpace": ")" + space +
                R"(", "Name": "m", "RGBPoints": [0, 1, 0, 0, 2, 0, 0, 1]})")
        .at(0.5)
        .color;
  };
  const double half = linear_from_srgb(0.5);
  EXPECT_LE((middle("RGB") - Color(half, 0, half)).abs().maxCoeff(), 1e-9);
  EXPECT_LE((middle("HSV") - Color(1, 0, 1)).abs().maxCoeff(), 1e-9);  // magenta, the short way
  // Lab: red (53.24, 80.09, 67.20) and blue (32.30, 79.19, -107.86): half way (42.77, 79.64,
  // -20.33).
  EXPECT_NEAR(middle("Lab")[0], 0.5839, 0.01);
  EXPECT_NEAR(middle("Lab")[1], 0, 0.01);
  EXPECT_NEAR(middle("Lab")[2], 0.2547, 0.02);
  EXPECT_TRUE((middle("Step") == Color(0, 0, 1)).all() || (middle("Step") == Color(1, 0, 0)).all());
}

TEST_F(ParaviewColorMap, EndsAreExactInEverySpace) {
  const Color a(0.2, 0.7, 0.4), b(0.9, 0.1, 0.3);
  for (const auto space :
       {ColorSpace::rgb, ColorSpace::hsv, ColorSpace::lab, ColorSpace::diverging}) {
    EXPECT_LE((interpolate_srgb(space, a, b, 0) - a).abs().maxCoeff(), 2e-7);
    EXPECT_LE((interpolate_srgb(space, a, b, 1) - b).abs().maxCoeff(), 2e-7);
    EXPECT_LE((interpolate_srgb(space, a, a, 0.3) - a).abs().maxCoeff(), 2e-7);
  }
}

TEST_F(ParaviewColorMap, XmlWithOpacities) {
  const std::string xml = R"(<?xml version="1.0"?>
<ColorMaps>
<ColorMap name="first" space="RGB">
<Point x="0" o="0" r="0" g="0" b="0"/><Point x="5" o="1" r="1" g="1" b="1"/></ColorMap>
<ColorMap name="second" space="Step">
<Point x="10" o="0.5" r="1" g="0" b="0"/><Point x="20" o="0.75" r="0" g="1" b="0"/>
<Point x="30" o="0.75" r="0" g="0" b="1"/><NaN r="0.25" g="0" b="0"/></ColorMap>
</ColorMaps>)";
  const TransferFunction second = read(xml, "second", 0, 4, 10);  // a tenth of the diagonal is 1
  EXPECT_NEAR(second.at(0).extinction, -std::log(0.5), 1e-12);
  EXPECT_NEAR(second.at(2).extinction, -std::log(0.25), 1e-12);
  EXPECT_NEAR(second.at(1).extinction, -0.5 * std::log(0.5 * 0.25), 1e-12);
  EXPECT_TRUE((second.at(1.9).color == Color(1, 0, 0)).all());
  EXPECT_TRUE((second.at(2).color == Color(0, 1, 0)).all());
  EXPECT_TRUE((second.at(3.9).color == Color(0, 1, 0)).all());
  const TransferFunction first = read(xml);
  EXPECT_NEAR(first.at(1).extinction, -std::log(0.001), 1e-9);  // opaque: at most 0.999
  EXPECT_THAT(error<base::UsageError>(xml, "secnd"),
              HasSubstr("no color map 'secnd'; did you mean 'second'"));
}

TEST_F(ParaviewColorMap, JsonOpacitiesHaveTheirOwnPlaces) {
  const TransferFunction tf = read(R"([{"Name": "m", "ColorSpace": "RGB",
      "RGBPoints": [0, 1, 1, 1, 1, 1, 1, 1],
      "Points": [0, 0, 0.5, 0, 0.3, 0.5, 0.5, 0, 0.3, 0.75, 0.5, 0, 1, 0, 0.5, 0]}])");
  EXPECT_NEAR(tf.below(0.3).extinction, -std::log(0.5), 1e-9);
  EXPECT_NEAR(tf.at(1).extinction, 0, 1e-12);
  EXPECT_NEAR(tf.at(0.15).extinction, -0.5 * std::log(0.5), 1e-9);
  EXPECT_NEAR(tf.at(0.65).extinction, -0.5 * std::log(0.25), 1e-9);
}

TEST_F(ParaviewColorMap, Errors) {
  EXPECT_THAT(error("{"), AllOf(HasSubstr(file_), HasSubstr("line 1")));
  EXPECT_THAT(error(""), HasSubstr("is no ParaView color map"));
  EXPECT_THAT(error("[]"), HasSubstr("has no color map"));
  EXPECT_THAT(error("[3]"), HasSubstr("is no ParaView color map"));
  EXPECT_THAT(error("<ColorMaps>\n<ColorMap>"),
              AllOf(HasSubstr("is not XML: line 2"), HasSubstr(file_)));
  EXPECT_THAT(error("<ColorMap name='m'>\n<Point x='q' r='0' g='0' b='0'/></ColorMap>"),
              HasSubstr("line 2: a Point needs a number for x, not 'q'"));
  EXPECT_THAT(error("<ColorMap name='m'><Point x='0' r='0' g='0' b='0'/></ColorMap>"),
              HasSubstr("'m' has fewer than two points"));
  EXPECT_THAT(error(R"({"Name": "m", "RGBPoints": [0, 1, 1]})"), HasSubstr("'RGBPoints' must be"));
  EXPECT_THAT(error(R"({"Name": "m", "RGBPoints": [0, 1, 1, 1, 1, 2, 1, 1]})"),
              HasSubstr("point 1"));
  EXPECT_THAT(error(R"({"Name": "m", "RGBPoints": [1, 1, 1, 1, 0, 1, 1, 1]})"),
              HasSubstr("x must not decrease"));
  EXPECT_THAT(error(R"({"Name": "m", "RGBPoints": [1, 1, 1, 1, 1, 1, 1, 1]})"),
              HasSubstr("spans no range"));
  EXPECT_THAT(
      error(R"({"Name": "m", "ColorSpace": "Labb", "RGBPoints": [0, 1, 1, 1, 1, 1, 1, 1]})"),
      HasSubstr("unknown color space 'Labb'; did you mean 'Lab'"));
  EXPECT_THAT(error(R"({"Name": "m", "IndexedColors": [1, 1, 1]})"), HasSubstr("categories"));
  EXPECT_THAT(
      error(R"({"Name": "m", "RGBPoints": [0, 1, 1, 1, 1, 1, 1, 1], "Points": [0, 3, 0.5, 0]})"),
      HasSubstr("opacity 3 is outside"));
  EXPECT_THROW(static_cast<void>(read_paraview_color_map(file_ + "none", "", 0, 1, 1)),
               base::ReadError);
  EXPECT_THROW(static_cast<void>(read(kCoolToWarm, "", 1, 0)), base::UsageError);
  EXPECT_THROW(static_cast<void>(read(kCoolToWarm, "", 0, 1, 0)), base::InputError);
}

}  // namespace
}  // namespace tetraglass::preint
