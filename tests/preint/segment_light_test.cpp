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

  void evaluate(const TransferFunction& tf, double tolerance = kFinestPiece) {
    for (auto& channel : rgbt) channel.resize(front.size());
    segment_lights(FloatTransferFunction(tf),
                   {front, back, length, rgbt[0], rgbt[1], rgbt[2], rgbt[3]}, tolerance);
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

/// Neighbours that cross the same control points, up, down or mixed: the fast ways.
RC_GTEST_PROP(SegmentLightProperty, IsTheIntegralAcrossTheSameControlPoints, ()) {
  const TransferFunction tf = rounded(*tests::transfer_function(*rc::gen::element(1.0, 1e6)));
  const double low = *tests::field_value(), high = *tests::field_value();
  const double length = *rc::gen::element(1e-3, 1.0, 100.0);
  Lights lights;
  for (int i = 0; i < 67; ++i) {
    const Segment s{low + 1e-3 * *tests::unit(), high - 1e-3 * *tests::unit(), length};
    const bool turned = *rc::gen::arbitrary<bool>();
    lights.add(turned ? Segment{s.back, s.front, s.length} : s);
  }
  lights.evaluate(tf);
  for (std::size_t i = 0; i < lights.front.size(); ++i) {
    RC_ASSERT(lights.error(tf, i) <= 1e-6);
  }
}

TEST(SegmentLight, HoldsTheToleranceThatIsAskedFor) {
  std::vector<ControlPoint> points;
  for (int i = 0; i <= 8; ++i)
    points.push_back({i / 8.0, Color(i % 2, 0.5, i / 8.0), 8.0 * (i % 3)});
  const TransferFunction tf(points);
  double coarsest = 0;
  for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3}) {
    Lights lights;
    for (int i = 0; i < 400; ++i) {
      lights.add({std::fmod(i * 0.618, 1.2) - 0.1, std::fmod(i * 0.755, 1.2) - 0.1, 0.02 * i});
    }
    lights.evaluate(tf, tolerance);
    for (std::size_t i = 0; i < lights.front.size(); ++i) {
      const double error = lights.error(tf, i);
      EXPECT_LE(error, tolerance) << i;
      coarsest = std::max(coarsest, error);
    }
  }
  EXPECT_GT(coarsest, 1e-5) << "a loose tolerance is used";
}

TEST(SegmentLight, ValuesAtTheEndsOfWhatCounts) {
  const TransferFunction tf({{-1e39, {1, 0, 0}, 1}, {0, {0, 1, 0}, 2}, {1e-40, {0, 0, 1}, 1e30}});
  Lights lights;
  for (const float a : {-1e38F, -1.0F, 0.0F, 1e-38F, 1e38F}) {
    for (const float b : {-1e38F, -1e-38F, 0.0F, 1e-38F, 1e38F}) {
      for (const float length : {0.0F, 1.0F, 3e38F}) lights.add({a, b, length});
    }
  }
  lights.evaluate(tf);
  for (std::size_t i = 0; i < lights.front.size(); ++i) {
    for (const auto& channel : lights.rgbt) {
      EXPECT_GE(channel[i], -1e-6F) << i;
      EXPECT_LE(channel[i], 1 + 1e-6F) << i;
    }
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
