#include "preint/segment_light.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "preint/segment_integral.h"
#include "tests/preint/media.h"

namespace tetraglass::preint {
namespace {

/// The same function and segments with everything rounded to floats.
TransferFunction rounded(const TransferFunction& tf) {
  std::vector<ControlPoint> points = tf.points();
  for (ControlPoint& p : points) {
    p.value = static_cast<float>(p.value);
    p.color = p.color.cast<float>().cast<double>();
    p.extinction = static_cast<float>(p.extinction);
  }
  return TransferFunction(points);
}

struct Lights {
  std::vector<float> front, back, length;
  std::array<std::vector<float>, 4> rgbt;

  void add(const Segment& s) {
    front.push_back(static_cast<float>(s.front));
    back.push_back(static_cast<float>(s.back));
    length.push_back(static_cast<float>(s.length));
  }

  void evaluate(const TransferFunction& tf) {
    for (auto& channel : rgbt) channel.resize(front.size());
    segment_lights(FloatTransferFunction(tf),
                   {front, back, length, rgbt[0], rgbt[1], rgbt[2], rgbt[3]});
  }

  [[nodiscard]] double error(const TransferFunction& tf, std::size_t i) const {
    const Radiance r = integrate_full(tf, {front[i], back[i], length[i]});
    double worst = std::abs(rgbt[3][i] - r.transmittance);
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(rgbt[c][i] - r.color[static_cast<long>(c)]));
    }
    return worst;
  }
};

RC_GTEST_PROP(SegmentLightProperty, IsTheIntegralToAMillionth, ()) {
  const TransferFunction tf = rounded(*tests::transfer_function());
  Lights lights;
  const std::size_t count = *rc::gen::inRange<std::size_t>(1, 40);
  for (std::size_t i = 0; i < count; ++i) lights.add(*tests::segment());
  lights.evaluate(tf);
  for (std::size_t i = 0; i < count; ++i) {
    const double error = lights.error(tf, i);
    if (!(error <= 1e-6)) {
      RC_LOG() << Segment{lights.front[i], lights.back[i], lights.length[i]} << " in " << tf
               << "error " << error;
    }
    RC_ASSERT(error <= 1e-6);
  }
}

TEST(SegmentLight, ManyPieces) {
  std::vector<ControlPoint> points;
  for (int i = 0; i <= 64; ++i) {
    points.push_back({i / 64.0, Color(i % 2, 0.5, i / 64.0), 3.0 * (i % 5)});
  }
  const TransferFunction tf(points);
  Lights lights;
  for (int i = 0; i < 200; ++i) {
    lights.add({std::fmod(i * 0.618, 1.2) - 0.1, std::fmod(i * 0.755, 1.2) - 0.1, 0.02 * i});
  }
  lights.evaluate(tf);
  for (std::size_t i = 0; i < lights.front.size(); ++i) {
    EXPECT_LE(lights.error(tf, i), 1e-6 + 57 * 1e-7) << i;
  }
}

TEST(SegmentLight, NothingIsExactlyNothing) {
  const TransferFunction tf({{0, Color::Ones(), 0}, {1, Color::Ones(), 0}, {1, Color::Ones(), 5}});
  Lights lights;
  for (int i = 0; i < 33; ++i) lights.add({0.3, i / 40.0, 7});
  for (int i = 0; i < 33; ++i) lights.add({0.3 + i, 2, 0});
  lights.evaluate(tf);
  for (std::size_t i = 0; i < lights.front.size(); ++i) {
    EXPECT_EQ(lights.rgbt[0][i], 0);
    EXPECT_EQ(lights.rgbt[3][i], 1);
  }
}

}  // namespace
}  // namespace tetraglass::preint
