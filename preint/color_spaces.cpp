#include "preint/color_spaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace tetraglass::preint {
namespace {

constexpr double kPi = std::numbers::pi;

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Color lerp(const Color& a, const Color& b, double t) {
  return (1 - t) * a + t * b;
}

/// sRGB primaries and white D65 (IEC 61966-2-1).
const Eigen::Matrix3d& xyz_from_linear() {
  static const Eigen::Matrix3d kMatrix = (Eigen::Matrix3d() << 0.4124, 0.3576, 0.1805,  //
                                          0.2126, 0.7152, 0.0722,                       //
                                          0.0193, 0.1192, 0.9505)
                                             .finished();
  return kMatrix;
}

Eigen::Array3d white() {
  return xyz_from_linear() * Eigen::Vector3d::Ones();
}

/// CIE 1976, with its straight line near black.
constexpr double kLabEdge = 6.0 / 29;

Color lab_from_srgb(const Color& srgb) {
  const Eigen::Vector3d linear = srgb.unaryExpr(&linear_from_srgb).matrix();
  const Color relative = (xyz_from_linear() * linear).array() / white();
  const Color f = relative.unaryExpr([](double t) {
    return t > kLabEdge * kLabEdge * kLabEdge ? std::cbrt(t)
                                              : t / (3 * kLabEdge * kLabEdge) + 4.0 / 29;
  });
  return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

Color srgb_from_lab(const Color& lab) {
  const double y = (lab[0] + 16) / 116;
  const Color f(y + lab[1] / 500, y, y - lab[2] / 200);
  const Color relative = f.unaryExpr(
      [](double t) { return t > kLabEdge ? t * t * t : 3 * kLabEdge * kLabEdge * (t - 4.0 / 29); });
  const Color linear = (xyz_from_linear().inverse() * (relative * white()).matrix()).array();
  return linear.unaryExpr(&srgb_from_linear).max(0).min(1);
}

Color hsv_from_rgb(const Color& c) {
  const double most = c.maxCoeff(), least = c.minCoeff(), range = most - least;
  double hue = 0;
  if (range > 0) {
    if (most == c[0]) {
      hue = (c[1] - c[2]) / range;
    } else if (most == c[1]) {
      hue = 2 + (c[2] - c[0]) / range;
    } else {
      hue = 4 + (c[0] - c[1]) / range;
    }
  }
  return {hue / 6 - std::floor(hue / 6), most > 0 ? range / most : 0, most};
}

Color rgb_from_hsv(const Color& hsv) {
  const auto channel = [&](double shift) {
    const double k = std::fmod(shift + hsv[0] * 6, 6.0);
    return hsv[2] * (1 - hsv[1] * std::max(0.0, std::min({k, 4 - k, 1.0})));
  };
  return {channel(5), channel(3), channel(1)};
}

/// The short way round the circle of hues.
Color interpolate_hsv(Color a, Color b, double t) {
  if (b[0] - a[0] > 0.5) a[0] += 1;
  if (a[0] - b[0] > 0.5) b[0] += 1;
  Color hsv = lerp(a, b, t);
  hsv[0] -= std::floor(hsv[0]);
  return hsv;
}

/// Moreland's Msh: length, saturation (angle from the axis of greys) and hue of Lab.
struct Msh {
  double m, s, h;
};

Msh msh_from_lab(const Color& lab) {
  const double m = lab.matrix().norm();
  return {m, m > 1e-3 ? std::acos(std::min(1.0, lab[0] / m)) : 0, std::atan2(lab[2], lab[1])};
}

Color lab_from_msh(const Msh& c) {
  return {c.m * std::cos(c.s), c.m * std::sin(c.s) * std::cos(c.h),
          c.m * std::sin(c.s) * std::sin(c.h)};
}

/// Below this, a color counts as grey.
constexpr double kGrey = 0.05;

/// The hue to give to a grey of length `m` at the other end, so that the map changes evenly.
double hue_for_grey(const Msh& saturated, double m) {
  if (saturated.m >= m - 0.1) return saturated.h;
  const double spin = saturated.s * std::sqrt(m * m - saturated.m * saturated.m) /
                      (saturated.m * std::sin(saturated.s));
  return saturated.h > -0.3 * kPi ? saturated.h + spin : saturated.h - spin;
}

Color interpolate_diverging(const Color& lab_a, const Color& lab_b, double t) {
  Msh a = msh_from_lab(lab_a), b = msh_from_lab(lab_b);
  double turn = std::abs(a.h - b.h);
  if (turn > kPi) turn = 2 * kPi - turn;
  if (a.s > kGrey && b.s > kGrey && turn > kPi / 3) {
    const Msh middle{std::max({a.m, b.m, 88.0}), 0, 0};
    (t < 0.5 ? b : a) = middle;
    t = t < 0.5 ? 2 * t : 2 * t - 1;
  }
  if (a.s < kGrey && b.s > kGrey) {
    a.h = hue_for_grey(b, a.m);
  } else if (a.s > kGrey && b.s < kGrey) {
    b.h = hue_for_grey(a, b.m);
  }
  const auto mix = [t](double x, double y) { return (1 - t) * x + t * y; };
  return lab_from_msh({mix(a.m, b.m), mix(a.s, b.s), mix(a.h, b.h)});
}

}  // namespace

double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

Color interpolate_srgb(ColorSpace space, const Color& a, const Color& b, double t) {
  switch (space) {
    case ColorSpace::rgb:
      return lerp(a, b, t);
    case ColorSpace::hsv:
      return rgb_from_hsv(interpolate_hsv(hsv_from_rgb(a), hsv_from_rgb(b), t));
    case ColorSpace::lab:
      return srgb_from_lab(lerp(lab_from_srgb(a), lab_from_srgb(b), t));
    case ColorSpace::diverging:
      return srgb_from_lab(interpolate_diverging(lab_from_srgb(a), lab_from_srgb(b), t));
  }
  return a;
}

}  // namespace tetraglass::preint
