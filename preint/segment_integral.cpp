#include "preint/segment_integral.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <cerf.h>

#include "preint/precision.h"
#include "preint/segment_pieces.h"

namespace tetraglass::preint {
namespace {

/// Light that reaches the front of a piece, parted by the products of (1 - x) and x: enough for any
/// function that is quadratic in x. A linear function with values f and b at the ends gathers f
/// front() + b back().
struct Weights {
  double front_front = 0;  ///< of (1 - x)^2
  double front_back = 0;   ///< of x (1 - x)
  double back_back = 0;    ///< of x^2

  [[nodiscard]] double front() const { return front_front + front_back; }
  [[nodiscard]] double back() const { return front_back + back_back; }
};

/// The part of a piece of optical depth `depth` where the first `part` of that depth lies: the
/// solution x of x (front + x (back - front) / 2) = part, in the form without cancellation.
double position_of_depth(const OpticalExtinction& k, double depth, double part) {
  const double front = k.front / depth;
  const double back = k.back / depth;
  const double u = part / depth;
  const double root = std::sqrt(std::max(0.0, front * front + 2 * (back - front) * u));
  return std::min(1.0, 2 * u / (front + root));
}

/// int k(x) p(x) exp(-tau(x)) dx over x in [0, 1] for the products p above, optical extinctions k
/// linear in x and tau(x) = int_0^x k; what lies deeper than `visible` is left out. All terms are
/// positive: thin pieces keep their relative accuracy.
Weights full_weights(const OpticalExtinction& k, double visible, const Precision& precision) {
  const double depth = k.depth();
  if (depth == 0) return {};
  const double reached = std::min(depth, visible);
  const auto [rule, parts] = cheapest(reached, precision);
  const double slope = k.back - k.front;
  Weights sum;
  double from = 0;
  for (int part = 1; part <= parts; ++part) {
    const bool last = part == parts && reached == depth;
    const double to = last ? 1 : position_of_depth(k, depth, reached * part / parts);
    for (const GaussNode& node : rule) {
      const double x = from + (to - from) * node.x;
      const double tau = x * (k.front + 0.5 * slope * x);
      const double light = (to - from) * node.weight * (k.front + slope * x) * std::exp(-tau);
      sum.front_front += (1 - x) * (1 - x) * light;
      sum.front_back += x * (1 - x) * light;
      sum.back_back += x * x * light;
    }
    from = to;
  }
  return sum;
}

/// From this depth on the closed form loses no more than 1e-13 of the opacity to cancellation.
constexpr double kClosedForm = 0.25;

/// The mean transmittance int_0^1 exp(-tau(x)) dx from the front of a piece in closed form: with
/// s = |k_back - k_front| a difference of erfcx(k / sqrt(2 s)) at both ends where the extinction
/// rises, of Dawson's integral where it falls. The end at the back is dimmed by `transmittance`.
double mean_transmittance(const OpticalExtinction& k, double transmittance) {
  const double rise = k.back - k.front;
  if (rise == 0) return (1 - transmittance) / k.front;
  const double root = std::sqrt(2 * std::abs(rise));
  const double front = k.front / root, back = k.back / root;
  if (rise < 0) return 2 / root * (dawson(front) - transmittance * dawson(back));
  const double scale = 1 / (root * std::numbers::inv_sqrtpi);
  return scale * (erfcx(front) - transmittance * erfcx(back));
}

/// Shares of the colors at the front and at the back in the light that leaves the front.
std::pair<double, double> shares(const OpticalExtinction& k, double visible,
                                 const Precision& precision) {
  const double depth = k.depth();
  if (depth < kClosedForm) {
    const Weights w = full_weights(k, visible, precision);
    return {w.front(), w.back()};
  }
  const double transmittance = std::exp(-depth);
  const double mean = mean_transmittance(k, transmittance);
  return {1 - mean, std::max(0.0, mean - transmittance)};
}

}  // namespace

Radiance integrate_full(const TransferFunction& tf, const Segment& segment, double tolerance) {
  const Precision& precision = precision_for(tolerance);
  Radiance result;
  double depth = 0;
  for_each_piece(tf, segment, [&](const Piece& piece) {
    const OpticalExtinction k = optical_extinction(piece);
    if (depth < precision.opaque) {
      const auto [front, back] = shares(k, precision.opaque - depth, precision);
      const double before = std::exp(-depth);
      result.color += before * front * piece.front.color + before * back * piece.back.color;
    }
    depth += k.depth();
  });
  result.transmittance = std::exp(-depth);
  return result;
}

RampedRadiance integrate_ramped(const TransferFunction& tf, const Segment& segment,
                                double tolerance) {
  const Precision& precision = precision_for(tolerance);
  RampedRadiance result;
  double depth = 0;
  double ramp = 0;  // of the back, at the front of the piece
  for_each_piece(tf, segment, [&](const Piece& piece) {
    const OpticalExtinction k = optical_extinction(piece);
    const double next =
        segment.length > 0 ? std::min(1.0, ramp + piece.length / segment.length) : 0;
    if (depth < precision.opaque) {
      const Weights w = full_weights(k, precision.opaque - depth, precision);
      const double before = std::exp(-depth);
      // Gathers the color times a linear function of the position.
      const auto gather = [&](double at_front, double at_back, Color& color, double& white) {
        const double cross = w.front_back;
        const double front = before * (at_front * w.front_front + at_back * cross);
        const double back = before * (at_front * cross + at_back * w.back_back);
        color += front * piece.front.color + back * piece.back.color;
        white += front + back;
      };
      gather(1 - ramp, 1 - next, result.front, result.white_front);
      gather(ramp, next, result.back, result.white_back);
    }
    ramp = next;
    depth += k.depth();
  });
  result.transmittance = std::exp(-depth);
  return result;
}

Color integrate_emission(const TransferFunction& tf, const Segment& segment) {
  Color result = Color::Zero();
  for_each_piece(tf, segment, [&](const Piece& piece) {
    // The limit of the weights of the full model where the optical depth goes to 0.
    const OpticalExtinction k = optical_extinction(piece);
    result += (k.front / 3 + k.back / 6) * piece.front.color +
              (k.front / 6 + k.back / 3) * piece.back.color;
  });
  return result;
}

double optical_depth(const TransferFunction& tf, const Segment& segment) {
  double result = 0;
  for_each_piece(tf, segment,
                 [&](const Piece& piece) { result += optical_extinction(piece).depth(); });
  return result;
}

Color max_color(const TransferFunction& tf, double front, double back) {
  // The ray meets the values at both of its ends; the pieces give the limits from inside.
  Color result = tf.at(front).color.max(tf.at(back).color);
  for_each_piece(tf, Segment{front, back, 0}, [&](const Piece& piece) {
    result = result.max(piece.front.color).max(piece.back.color);
  });
  return result;
}

}  // namespace tetraglass::preint
