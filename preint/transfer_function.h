#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace tetraglass::preint {

/// Linear RGB.
using Color = Eigen::Array3d;

/// How a shaded color answers to light (Phong; meissner2002 Eq. 1).
struct Material {
  double ambient = 0.1;
  double diffuse = 0.7;
  double specular = 0.2;
  double shininess = 32;
};

struct ControlPoint {
  double value = 0;
  Color color = Color::Zero();
  double extinction = 0;  ///< kappa >= 0, per unit length of the mesh
  Material material = {};
};

/// What the transfer function gives for one value.
struct Medium {
  Color color = Color::Zero();
  double extinction = 0;
};

/// Color and extinction as functions of the field's value: linear between control points, constant
/// beyond the ends; two points of the same value make a jump, whose value is that of the second
/// (upper) point. The points cut the values into points().size() + 1 intervals on each of which the
/// function is linear: 0 below the first point, i between points()[i - 1] and points()[i], size()
/// above the last; the interval of a jump is empty.
class TransferFunction {
 public:
  /// At least one point, values not decreasing, at most two of the same value, everything finite
  /// (the span of the values too), extinction >= 0. Throws InputError otherwise, naming the point.
  explicit TransferFunction(std::vector<ControlPoint> points);

  [[nodiscard]] const std::vector<ControlPoint>& points() const { return points_; }

  /// Cost of each of the following: logarithmic in the number of control points.
  [[nodiscard]] Medium at(double value) const;

  /// Linear between control points like the color; at a jump that of the upper point.
  [[nodiscard]] Material material_at(double value) const;

  /// The limit from below (at a jump: the first of its two points).
  [[nodiscard]] Medium below(double value) const;

  /// The largest extinction for any value in [low, high].
  [[nodiscard]] double max_extinction(double low, double high) const;

  /// The interval that holds `value` and values just above it ...
  [[nodiscard]] std::size_t interval_above(double value) const;

  /// ... and the one that holds values just below it.
  [[nodiscard]] std::size_t interval_below(double value) const;

  /// The linear function of a non-empty interval (see above), at one of its values or a limit at
  /// its ends.
  [[nodiscard]] Medium in_interval(std::size_t interval, double value) const;

 private:
  std::vector<ControlPoint> points_;
};

/// The same extinction with ambient, diffuse and specular in the place of red, green and blue: what
/// integrates colors then integrates materials.
[[nodiscard]] TransferFunction materials_as_colors(const TransferFunction& tf);

/// The function of the negated value: what rises along a ray in `tf` falls in its mirror image.
[[nodiscard]] TransferFunction mirrored(const TransferFunction& tf);

/// Reads the JSON form ({"points": [{"value":, "color": [r, g, b], "extinction":}, ...]}). A point
/// may have "ambient", "diffuse", "specular" and "shininess" (see Material). Throws ReadError
/// (missing, not JSON with line and column, wrong key with the right ones, wrong numbers with the
/// point).
[[nodiscard]] TransferFunction read_transfer_function(const std::string& file);

/// The names that `preset` knows, for help texts and suggestions.
[[nodiscard]] std::vector<std::string> preset_names();

/// A named color map over the values [low, high], with extinction rising linearly from 0 so that a
/// ray along the whole `diagonal` (of the mesh's bounds, in its units) at the upper half of the
/// range is nearly opaque: pictures do not depend on the mesh's units. "x-ray" is white with the
/// same low extinction everywhere. low == high (a constant field) gives the middle of the map.
/// Throws UsageError for an unknown name, with the nearest ones, and for low > high; InputError
/// where the range is not finite or the diagonal not positive.
[[nodiscard]] TransferFunction preset(const std::string& name, double low, double high,
                                      double diagonal);

}  // namespace tetraglass::preint
