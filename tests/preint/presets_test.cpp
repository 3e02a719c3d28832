#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "preint/segment_integral.h"
#include "preint/transfer_function.h"

namespace tetraglass::preint {
namespace {

using testing::HasSubstr;

double opacity(const TransferFunction& tf, const Segment& segment) {
  return 1 - integrate_full(tf, segment).transmittance;
}

TEST(Presets, AllAreTransferFunctions) {
  const auto names = preset_names();
  EXPECT_THAT(
      names, testing::IsSupersetOf({"viridis", "inferno", "cividis", "coolwarm", "grey", "x-ray"}));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    for (const auto& [low, high] :
         {std::pair{-2.0, 7.0}, {3.0, 3.0}, {1.0, std::nextafter(1.0, 2.0)}, {0.0, 1e-320}}) {
      const TransferFunction tf = preset(name, low, high, 5);
      EXPECT_EQ(tf.points().front().value, low);
      if (name != "x-ray") {
        EXPECT_EQ(tf.points().back().value, high);
      }
      for (const ControlPoint& p : tf.points()) {
        EXPECT_TRUE((p.color >= 0).all() && (p.color <= 1).all());
      }
    }
  }
}

TEST(Presets, ColorsAreLinearRgb) {
  // sRGB 0x80 is 21.586 % of white; the ends of viridis are 0x440154 and 0xfde725.
  EXPECT_NEAR(preset("grey", 0, 16, 1).at(8).color[0], 0.215861, 1e-6);
  const TransferFunction viridis = preset("viridis", 0, 1, 1);
  EXPECT_NEAR(viridis.at(0).color[0], 0.057805, 1e-6);
  EXPECT_NEAR(viridis.at(1).color[1], 0.799103, 1e-6);
  EXPECT_NEAR(viridis.at(0).color[1], 1 / 255.0 / 12.92, 1e-9);
}

TEST(Presets, PicturesDoNotDependOnUnits) {
  const Segment in_metres{2, 5, 0.3};
  for (const std::string& name : preset_names()) {
    const Radiance metres = integrate_full(preset(name, 1, 6, 2), in_metres);
    const Radiance millimetres = integrate_full(preset(name, 1000, 6000, 2000), {2000, 5000, 300});
    EXPECT_NEAR(metres.transmittance, millimetres.transmittance, 1e-14) << name;
    EXPECT_LE((metres.color - millimetres.color).abs().maxCoeff(), 1e-14) << name;
  }
}

TEST(Presets, PicturesAreNeitherEmptyNorSolid) {
  for (const std::string& name : preset_names()) {
    if (name == "x-ray") continue;
    SCOPED_TRACE(name);
    const double diagonal = 40;
    const TransferFunction tf = preset(name, 300, 400, diagonal);
    EXPECT_EQ(tf.at(300).extinction, 0);
    EXPECT_GT(opacity(tf, {350, 400, diagonal}), 0.99);
    // Cold air through the whole domain; a plume of a twentieth of the diagonal in it; a thin hot
    // sheet.
    EXPECT_LT(opacity(tf, {302, 308, diagonal}), 0.4);
    EXPECT_GT(opacity(tf, {340, 390, diagonal / 20}), 0.15);
    EXPECT_LT(opacity(tf, {340, 390, diagonal / 20}), 0.5);
    // A distance field in a body: all values, a third of the diagonal thick.
    EXPECT_GT(opacity(tf, {300, 400, diagonal / 3}), 0.5);
    EXPECT_LT(opacity(tf, {300, 400, diagonal / 3}), 0.9);
    // A constant field is the middle of the map.
    EXPECT_EQ(preset(name, 350, 350, diagonal).at(350).extinction, tf.at(350).extinction);
  }
  EXPECT_NEAR(opacity(preset("x-ray", 0, 1, 40), {0.2, 0.9, 20}), 0.5, 0.1);
}

TEST(Presets, Errors) {
  try {
    static_cast<void>(preset("virdis", 0, 1, 1));
    FAIL();
  } catch (const base::UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'virdis'; did you mean 'viridis'"));
  }
  EXPECT_THROW(static_cast<void>(preset("grey", 1, 0, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(preset("grey", std::nan(""), 0, 1)), base::UsageError);
  EXPECT_THROW(static_cast<void>(preset("grey", 0, INFINITY, 1)), base::InputError);
  EXPECT_THROW(static_cast<void>(preset("grey", 0, 1, 0)), base::InputError);
  EXPECT_THROW(static_cast<void>(preset("grey", 0, 1, 1e-320)), base::InputError);
}

}  // namespace
}  // namespace tetraglass::preint
