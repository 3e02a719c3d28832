#include "mesh/predicates.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

namespace tetraglass::mesh {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A double as it is: mantissa times a power of two.
Rational exact(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  Rational result(static_cast<std::int64_t>(std::ldexp(mantissa, 53)));
  exponent -= 53;
  const boost::multiprecision::cpp_int power = boost::multiprecision::cpp_int(1)
                                               << static_cast<unsigned>(std::abs(exponent));
  return exponent < 0 ? Rational(result / power) : Rational(result * power);
}

int sign(const Rational& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

using Exact3 = std::array<Rational, 3>;

Exact3 exact(const Vector3d& v) {
  return {exact(v.x()), exact(v.y()), exact(v.z())};
}
Exact3 minus(const Exact3& a, const Exact3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Rational determinant(const Exact3& a, const Exact3& b, const Exact3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}
int exact_orientation(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Exact3 o = exact(a);
  return sign(determinant(minus(exact(b), o), minus(exact(c), o), minus(exact(d), o)));
}

// The determinant of (v, |v|^2) over the four vectors from e, positive for e inside when abcd is
// positive.
int exact_in_sphere(const std::array<Vector3d, 4>& p, const Vector3d& e) {
  std::array<Exact3, 4> v;
  std::array<Rational, 4> lift;
  for (std::size_t i = 0; i < 4; ++i) {
    v[i] = minus(exact(p[i]), exact(e));
    lift[i] = v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2];
  }
  const Rational d =
      lift[0] * determinant(v[1], v[2], v[3]) - lift[1] * determinant(v[0], v[2], v[3]) +
      lift[2] * determinant(v[0], v[1], v[3]) - lift[3] * determinant(v[0], v[1], v[2]);
  return sign(d);
}

double nudge(double x, int steps) {
  for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps > 0 ? HUGE_VAL : -HUGE_VAL);
  return x;
}

struct Source {
  std::mt19937_64 bits{20240607};
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(bits); }
  int small(int most) { return std::uniform_int_distribution<int>(-most, most)(bits); }
  Vector3d vector() { return {unit(), unit(), unit()}; }
  Vector3d nudged(const Vector3d& v) {
    return {nudge(v.x(), small(2)), nudge(v.y(), small(2)), nudge(v.z(), small(2))};
  }
};

TEST(Orientation, OfTheUnitTetrahedronIsPositive) {
  const Vector3d o(0, 0, 0);
  EXPECT_EQ(orientation(o, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()), 1);
  EXPECT_EQ(orientation(o, Vector3d::UnitY(), Vector3d::UnitX(), Vector3d::UnitZ()), -1);
  EXPECT_EQ(orientation(o, Vector3d::UnitX(), Vector3d::UnitY(), Vector3d(0.3, 0.4, 0)), 0);
}

TEST(Orientation, IsExactForNearlyCoplanarPoints) {
  Source source;
  int zeros = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3d a = source.vector();
    const Vector3d b = source.vector();
    const Vector3d c = source.vector();
    // Small integers times dyadic fractions give true zeros, the nudge near ones.
    const Vector3d combined =
        a + 0.25 * source.small(8) * (b - a) + 0.25 * source.small(8) * (c - a);
    const Vector3d d = source.nudged(combined);
    ASSERT_EQ(orientation(a, b, c, d), exact_orientation(a, b, c, d)) << "trial " << trial;
    const Vector3d e(a.x(), a.y(), b.z());
    const Vector3d f(b.x(), a.y(), b.z());
    const Vector3d g(b.x(), c.y(), b.z());
    const Vector3d h(a.x(), c.y(), nudge(b.z(), source.small(1)));
    const int expected = exact_orientation(e, f, g, h);
    ASSERT_EQ(orientation(e, f, g, h), expected) << "trial " << trial;
    zeros += expected == 0 ? 1 : 0;
  }
  EXPECT_GT(zeros, 100);  // else the test would miss the case it is for
}

TEST(Orientation, IsExactFarFromTheOriginAndAtTheEndsOfTheRange) {
  Source source;
  for (const double scale : {1e-300, 1e-150, 1e-110, 1e110, 1e150, 1e300}) {
    for (int trial = 0; trial < 100; ++trial) {
      const Vector3d a = scale * source.vector();
      const Vector3d b = scale * source.vector();
      const Vector3d c = scale * source.vector();
      const Vector3d d = source.nudged(a + 0.5 * (b - a) + 0.25 * (c - a));
      ASSERT_EQ(orientation(a, b, c, d), exact_orientation(a, b, c, d)) << "scale " << scale;
    }
  }
  const Vector3d shift(1e8, -3e8, 7e7);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d a = shift + source.vector();
    const Vector3d b = shift + source.vector();
    const Vector3d c = shift + source.vector();
    const Vector3d d = a + 0.3 * (b - a) + 0.3 * (c - a);
    ASSERT_EQ(orientation(a, b, c, d), exact_orientation(a, b, c, d)) << "trial " << trial;
  }
}

TEST(SignOfDeterminant, Of3VectorsIsExactForNearlyDependentVectors) {
  Source source;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3d a = source.vector();
    const Vector3d b = source.vector();
    const Vector3d c = source.nudged(source.unit() * a + source.unit() * b);
    const int expected = sign(determinant(exact(a), exact(b), exact(c)));
    ASSERT_EQ(sign_of_determinant(a, b, c), expected) << "trial " << trial;
    ASSERT_EQ(sign_of_determinant(b, a, c), -expected) << "trial " << trial;
    ASSERT_EQ(sign_of_determinant(b, c, a), expected) << "trial " << trial;
    ASSERT_EQ(sign_of_determinant(a, b, -4 * a), 0) << "trial " << trial;
  }
}

// Entries of very unequal size: products underflow or overflow while the determinant does not
// vanish.
TEST(SignOfDeterminant, Of3VectorsIsExactOverTheWholeRange) {
  Source source;
  for (int trial = 0; trial < 3000; ++trial) {
    std::array<Vector3d, 3> v;
    for (Vector3d& x : v) {
      for (int i = 0; i < 3; ++i) x[i] = std::ldexp(source.unit(), 5 * source.small(200));
    }
    if (trial % 2 == 0) v[2] = source.nudged(v[0] * 0.5 + v[1] * 0.25);
    const int expected = sign(determinant(exact(v[0]), exact(v[1]), exact(v[2])));
    ASSERT_EQ(sign_of_determinant(v[0], v[1], v[2]), expected) << "trial " << trial;
  }
  for (const double tiny : {0x1p-1074, 0x1p-540, 0x1p-360, 0x1p-358}) {
    EXPECT_EQ(sign_of_determinant(Vector3d(tiny, 0, 0), Vector3d(0, tiny, 0), Vector3d(0, 0, tiny)),
              1);
    EXPECT_EQ(sign_of_determinant(Vector3d(0, tiny, 0), Vector3d(tiny, 0, 0), Vector3d(0, 0, tiny)),
              -1);
  }
  EXPECT_EQ(
      sign_of_determinant(Vector3d(1e300, 0, 0), Vector3d(0, 1e300, 0), Vector3d(0, 0, 1e300)), 1);
  EXPECT_EQ(sign_of_determinant(Vector3d(0, 0, 0), Vector3d(0, 1e300, 0), Vector3d(0, 0, 1e300)),
            0);
}

TEST(SignOfDeterminant, Of2VectorsIsExact) {
  Source source;
  for (int trial = 0; trial < 5000; ++trial) {
    Vector2d a(source.unit(), source.unit());
    Vector2d b = source.unit() * a;
    b = {nudge(b.x(), source.small(2)), nudge(b.y(), source.small(2))};
    if (trial % 3 == 0) {
      const double scale = std::ldexp(1.0, 100 * source.small(5) - 30);
      a *= scale;
      b *= scale;
    }
    const int expected = sign(exact(a.x()) * exact(b.y()) - exact(a.y()) * exact(b.x()));
    ASSERT_EQ(sign_of_determinant(a, b), expected) << "trial " << trial;
    ASSERT_EQ(sign_of_determinant(b, a), -expected) << "trial " << trial;
    ASSERT_EQ(sign_of_determinant(a, Vector2d(-4 * a)), 0) << "trial " << trial;
  }
  EXPECT_EQ(sign_of_determinant(Vector2d(1, 0), Vector2d(0, 1)), 1);
  EXPECT_EQ(sign_of_determinant(Vector2d(0x1p-1074, 0), Vector2d(0, 0x1p-1074)), 1);
}

TEST(InSphere, KnowsInsideFromOutside) {
  const Vector3d o(0, 0, 0);
  const Vector3d x(1, 0, 0);
  const Vector3d y(0, 1, 0);
  const Vector3d z(0, 0, 1);
  ASSERT_EQ(orientation(o, x, y, z), 1);
  EXPECT_EQ(in_sphere(o, x, y, z, Vector3d(0.5, 0.5, 0.5)), 1);
  EXPECT_EQ(in_sphere(o, x, y, z, Vector3d(2, 2, 2)), -1);
  EXPECT_EQ(in_sphere(o, x, y, z, Vector3d(1, 1, 1)), 0);
  EXPECT_EQ(in_sphere(o, y, x, z, Vector3d(0.5, 0.5, 0.5)), -1);  // turned with the orientation
}

TEST(InSphere, IsExactForNearlyCosphericalPoints) {
  Source source;
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<Vector3d, 5> p;
    const double far = trial % 2 == 0 ? 0 : 1024;
    for (Vector3d& q : p) q = far * Vector3d::Ones() + source.vector().normalized();
    if (trial % 3 == 0) {  // corners of a cube: cospherical
      for (Vector3d& q : p)
        q = {source.small(1) + far, source.small(1) + far, source.small(1) + far};
    }
    int expected = exact_in_sphere({p[0], p[1], p[2], p[3]}, p[4]);
    ASSERT_EQ(in_sphere(p[0], p[1], p[2], p[3], p[4]), expected) << "trial " << trial;
  }
}

TEST(SameSideOfLine, ComparesTwoPointsOfAPlane) {
  const Vector3d a(0, 0, 1);
  const Vector3d b(1, 1, 1);
  EXPECT_EQ(same_side_of_line(a, b, Vector3d(0, 1, 1), Vector3d(-1, 1, 1)), 1);
  EXPECT_EQ(same_side_of_line(a, b, Vector3d(0, 1, 1), Vector3d(3, 1, 1)), -1);
  EXPECT_EQ(same_side_of_line(a, b, Vector3d(0, 1, 1), Vector3d(3, 3, 1)), 0);
}

TEST(Collinear, IsExact) {
  const Vector3d a(0.1, 0.2, 0.3);
  EXPECT_TRUE(collinear(a, a, Vector3d(1, 2, 3)));
  EXPECT_TRUE(collinear(Vector3d(0, 0, 0), a, 2 * a));
  EXPECT_FALSE(collinear(Vector3d(0, 0, 0), a, Vector3d(0.2, 0.4, nudge(0.6, 1))));
}

// Towards a point infinitely far: random, near-coplanar and exactly coplanar directions.
TEST(Predicates, OrientationTowardsADirectionIsExact) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vector3d(unit(random), unit(random), unit(random)); };
  int undecided = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d a = vector();
    const Vector3d b = vector();
    const Vector3d c = vector();
    Vector3d d = vector();
    if (i % 3 == 1) d = unit(random) * (b - a) + unit(random) * (c - a);
    if (i % 3 == 2) d = 2 * (b - a);
    const Exact3 o = exact(a);
    const int expected = sign(determinant(minus(exact(b), o), minus(exact(c), o), exact(d)));
    ASSERT_EQ(orientation_towards(a, b, c, d), expected) << i;
    ASSERT_EQ(orientation_towards(b, a, c, d), -expected) << i;
    undecided += expected == 0 ? 1 : 0;
  }
  EXPECT_LT(undecided, 1000);
  EXPECT_EQ(orientation_towards({0, 0, 3}, {1, 0, 3}, {0, 1, 3}, {5, 7, 0}), 0);
  EXPECT_EQ(orientation_towards({0, 0, 3}, {1, 0, 3}, {0, 1, 3}, {5, 7, 1e-300}), 1);
  EXPECT_EQ(orientation_towards({0, 0, 0}, {1, -1, 0}, {0, 0, 1}, {1, -1, 0.5}), 0);
}

// Without weights the sphere is the circumsphere; a weight moves its border.
TEST(Predicates, InPowerSphereTakesWeights) {
  const WeightedPoint a{{0, 0, 0}, 0};
  const WeightedPoint b{{1, 0, 0}, 0};
  const WeightedPoint c{{0, 1, 0}, 0};
  const WeightedPoint d{{0, 0, 1}, 0};
  EXPECT_EQ(in_power_sphere(a, b, c, d, {{1, 1, 1}, 0}), 0);
  EXPECT_EQ(in_power_sphere(a, b, c, d, {{1, 1, 1}, 1e-300}), 1);
  EXPECT_EQ(in_power_sphere(a, b, c, d, {{1, 1, 1}, -1e-300}), -1);
  EXPECT_EQ(in_power_sphere(b, a, c, d, {{1, 1, 1}, 1e-300}), -1);
  // Power of (2,2,2) with respect to the circumsphere of centre 1/2 and radius^2 3/4: 6.
  EXPECT_EQ(in_power_sphere(a, b, c, d, {{2, 2, 2}, 6}), 0);
  EXPECT_EQ(in_power_sphere(a, b, c, d, {{2, 2, 2}, 5.9}), -1);
}

}  // namespace
}  // namespace tetraglass::mesh
