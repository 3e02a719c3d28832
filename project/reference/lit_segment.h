#pragma once

#include <functional>

#include "preint/segment_integral.h"

namespace tetraglass::project {

/// The color of a medium of value s and color c at the part t of a segment, as it is lit there.
using LitColor = std::function<preint::Color(double t, double s, const preint::Color& c)>;

/// The volume rendering integral of a segment whose color is lit anew at every point: adaptive
/// Gauss-Legendre integration of kappa lit(t) exp(-tau) in each linear piece of the transfer
/// function. Error: about 1e-8 of the opacity.
[[nodiscard]] preint::Radiance integrate_lit(const preint::TransferFunction& tf,
                                             const preint::Segment& segment, const LitColor& lit);

}  // namespace tetraglass::project
