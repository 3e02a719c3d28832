#pragma once

#include "preint/transfer_function.h"

namespace tetraglass::preint {

/// A piece of a ray on which the field is linear.
struct Segment {
  double front = 0;   ///< the field's value where the ray enters; finite
  double back = 0;    ///< ... and where it leaves; finite
  double length = 0;  ///< >= 0 and finite, in the mesh's units
};

/// Light that a segment sends towards the eye, and what it lets through.
struct Radiance {
  Color color = Color::Zero();  ///< int kappa c exp(-tau) dl: associated (premultiplied)
  double transmittance = 1;     ///< exp(-tau) in [0, 1]
};

/// The smallest error that can be asked for: rounding is of this order.
inline constexpr double kFinest = 1e-15;

/// The volume rendering integral of one segment under the transfer function, in double, with an
/// absolute error of at most max(1e-12, tolerance) (colors in [0, 1]): split at the control points,
/// then in closed form (error functions) where a piece is deeper than 0.25, by the cheapest
/// Gauss-Legendre rule for the tolerance where it is thinner.
/// DESIGN section 2, mode `full`. The transmittance has no error but rounding.
[[nodiscard]] Radiance integrate_full(const TransferFunction& tf, const Segment& segment,
                                      double tolerance = kFinest);

/// Light of a segment parted by where it comes from: weighted by a ramp that falls from 1 at the
/// front to 0 at the back, and by the opposite ramp (lum2004, "Interpolated Pre-Integrated
/// Lighting"). Both parts together are the unweighted light.
struct RampedRadiance {
  Color front = Color::Zero();
  Color back = Color::Zero();
  double white_front = 0;  ///< the same of a white medium: the two sum to the opacity
  double white_back = 0;
  double transmittance = 1;
};

/// With the error of `integrate_full`.
[[nodiscard]] RampedRadiance integrate_ramped(const TransferFunction& tf, const Segment& segment,
                                              double tolerance = kFinest);

/// int kappa c dl, exact up to rounding (the integrand is piecewise quadratic). Mode `emission`.
[[nodiscard]] Color integrate_emission(const TransferFunction& tf, const Segment& segment);

/// int kappa dl, exact up to rounding (piecewise linear). Mode `absorption`.
[[nodiscard]] double optical_depth(const TransferFunction& tf, const Segment& segment);

/// The channel-wise largest color of the transfer function between the two values: mode `mip` of
/// the transfer function (weiler2002 section 5.1).
[[nodiscard]] Color max_color(const TransferFunction& tf, double front, double back);

}  // namespace tetraglass::preint
