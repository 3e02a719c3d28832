#include "project/reference/lit_segment.h"

#include <algorithm>
#include <cmath>

#include "preint/gauss.h"
#include "preint/segment_pieces.h"

namespace tetraglass::project {
namespace {

using preint::Color;
using preint::Piece;
using preint::Segment;

// The light from deeper than this is below the rounding of what lies before it.
constexpr double kVisible = 40;

constexpr double kTolerance = 1e-8;  // of the opacity
// A part this often halved is so short that a jump of the light within it does not matter.
constexpr int kMostHalvings = 26;

/// A linear piece of the medium with what is needed to light any point of it.
class LitPiece {
 public:
  LitPiece(const Segment& segment, const Piece& piece, double start, const LitColor& lit)
      : segment_(segment),
        piece_(piece),
        k_(optical_extinction(piece)),
        start_(start),
        share_(segment.length > 0 ? piece.length / segment.length : 0),
        lit_(lit) {}

  [[nodiscard]] double depth() const { return k_.depth(); }

  /// What is seen of it from its front.
  [[nodiscard]] Color light() const {
    // Parts of at most an optical depth of 1: they are smooth but for the light.
    const double reached = std::min(depth(), kVisible);
    const int parts = std::max(1, static_cast<int>(std::ceil(reached)));
    Color sum = Color::Zero();
    double from = 0;
    for (int part = 1; part <= parts; ++part) {
      const double to = position(reached * part / parts);
      const double opacity = std::exp(-tau(from)) - std::exp(-tau(to));
      sum += refine(from, to, rule(from, to), kTolerance * opacity, kMostHalvings);
      from = to;
    }
    return sum;
  }

 private:
  [[nodiscard]] double tau(double x) const {
    return x * (k_.front + 0.5 * (k_.back - k_.front) * x);
  }
  /// Where an optical depth is reached: the solution of tau(x) = depth without cancellation.
  [[nodiscard]] double position(double optical_depth) const {
    const double square = k_.front * k_.front + 2 * (k_.back - k_.front) * optical_depth;
    const double sum = k_.front + std::sqrt(std::max(0.0, square));
    return sum > 0 ? std::min(1.0, 2 * optical_depth / sum) : 1.0;
  }

  [[nodiscard]] Color rule(double from, double to) const {
    Color sum = Color::Zero();
    for (const preint::GaussNode& node : preint::kGauss6) {
      const double x = from + (to - from) * node.x;
      const double extinction = k_.front + (k_.back - k_.front) * x;
      const double t = start_ + share_ * x;
      const double value = segment_.front + t * (segment_.back - segment_.front);
      const Color color = piece_.front.color + x * (piece_.back.color - piece_.front.color);
      sum += (to - from) * node.weight * extinction * std::exp(-tau(x)) * lit_(t, value, color);
    }
    return sum;
  }

  [[nodiscard]] Color refine(double from, double to, const Color& whole, double tolerance,
                             int halvings) const {
    const double middle = 0.5 * (from + to);
    const Color first = rule(from, middle);
    const Color second = rule(middle, to);
    const Color both = first + second;
    if (halvings == 0 || (both - whole).abs().maxCoeff() <= tolerance) return both;
    return refine(from, middle, first, tolerance, halvings - 1) +
           refine(middle, to, second, tolerance, halvings - 1);
  }

  const Segment& segment_;
  const Piece& piece_;
  preint::OpticalExtinction k_;
  double start_;
  double share_;
  const LitColor& lit_;
};

}  // namespace

preint::Radiance integrate_lit(const preint::TransferFunction& tf, const Segment& segment,
                               const LitColor& lit) {
  preint::Radiance sum;
  double start = 0;
  for_each_piece(tf, segment, [&](const Piece& piece) {
    const LitPiece part(segment, piece, start, lit);
    const double depth = part.depth();
    if (depth > 0) {
      sum.color += sum.transmittance * part.light();
      sum.transmittance *= std::exp(-depth);
    }
    if (segment.length > 0) start += piece.length / segment.length;
  });
  return sum;
}

}  // namespace tetraglass::project
