#include "tests/stability/convex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "preint/isosurfaces.h"
#include "preint/segment_integral.h"
#include "project/light/phong.h"

namespace tetraglass::tests {
namespace {

using project::Mode;
using Rgba = Eigen::Array4d;

/// A ray inside the body; `room` below 0: it misses by so much, in units of depth.
struct Chord {
  preint::Segment segment;
  double room = -std::numeric_limits<double>::infinity();
  Eigen::Vector3d to_viewer = Eigen::Vector3d::Zero();
  double stretch = 1;  // world length of a unit of depth
};

Rgba rgba(const preint::Color& color, double alpha) {
  return {color.x(), color.y(), color.z(), alpha};
}

class ClosedForm {
 public:
  ClosedForm(const Convex& body, const project::Scene& scene)
      : body_(body), scene_(scene), frame_(make_frame(scene)) {}

  [[nodiscard]] Chord chord(double x, double y) const {
    const Eigen::Vector2d plane = frame_.image_plane(x, y);
    const Eigen::Vector3d origin =
        frame_.eye() + frame_.axes().transpose() * frame_.ray_origin(plane);
    const Eigen::Vector3d ray = frame_.axes().transpose() * frame_.ray_direction(plane);
    double enter = frame_.parallel() ? -std::numeric_limits<double>::infinity() : 0.0;
    double leave = std::numeric_limits<double>::infinity();
    Chord result;
    result.stretch = ray.norm();
    result.to_viewer = -ray / ray.norm();
    for (const Convex::Side& side : body_.sides) {
      const double room = side.offset - side.normal.dot(origin);
      const double rise = side.normal.dot(ray);
      if (rise == 0 && room < 0) return result;
      if (rise < 0) enter = std::max(enter, room / rise);
      if (rise > 0) leave = std::min(leave, room / rise);
    }
    if (!std::isfinite(enter) || !std::isfinite(leave)) return result;
    result.room = leave - enter;
    result.segment = {body_.value(origin + enter * ray), body_.value(origin + leave * ray),
                      std::max(0.0, leave - enter) * ray.norm()};
    return result;
  }

  [[nodiscard]] Rgba color(const Chord& chord) const {
    const preint::TransferFunction& tf = scene_.transfer_function;
    const preint::Segment& s = chord.segment;
    if (!(s.length > 0)) return Rgba::Zero();
    switch (scene_.mode) {
      case Mode::thickness:
        return rgba(preint::Color::Constant(s.length), 1);
      case Mode::full: {
        const preint::Radiance light = integrate_full(tf, s);
        return rgba(light.color, 1 - light.transmittance);
      }
      case Mode::emission:
        return rgba(integrate_emission(tf, s), 0);
      case Mode::absorption:
        return {0, 0, 0, -std::expm1(-optical_depth(tf, s))};
      case Mode::mip:
        return rgba(scene_.mip_of == project::MipOf::transfer
                        ? max_color(tf, s.front, s.back)
                        : tf.at(std::max(s.front, s.back)).color,
                    1);
      case Mode::iso:
        return surfaces(chord);
    }
    return Rgba::Zero();
  }

 private:
  [[nodiscard]] Rgba surfaces(const Chord& chord) const {
    Rgba sum = Rgba::Zero();
    const Eigen::Vector3d gradient = scene_.shading == project::Shading::none
                                         ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                         : body_.gradient;
    for (const std::size_t i :
         preint::crossed(scene_.isosurfaces, chord.segment.front, chord.segment.back)) {
      const preint::Isosurface& surface = scene_.isosurfaces[i];
      // By a headlight, whose light is the same wherever the surface lies.
      const preint::Color lit =
          project::shade({}, surface.color, {}, Eigen::Vector3d::Zero(), gradient, chord.to_viewer);
      sum += (1 - sum.w()) * surface.opacity * rgba(lit, 1);
    }
    return sum;
  }

  const Convex& body_;
  const project::Scene& scene_;
  project::Frame frame_;
};

/// The largest of two changes of each channel.
void include(Rgba& bound, const Rgba& exact, const Rgba& one, const Rgba& other) {
  bound += (one - exact).abs().max((other - exact).abs());
}

}  // namespace

namespace {

/// The largest (or smallest) extinction of any value within `by`: what a medium comes to whose
/// values are rounded in each cell on its own, in the worst way.
preint::TransferFunction envelope(const preint::TransferFunction& tf, double by, bool largest) {
  std::vector<double> values;
  for (const preint::ControlPoint& point : tf.points()) {
    values.push_back(point.value - by);
    values.push_back(point.value + by);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<preint::ControlPoint> result;
  for (const double at : values) {
    const double within = by + std::ldexp(std::abs(at), -50);  // rounding of the sums
    const auto [low, high] = std::minmax(
        {tf.at(at - within).extinction, tf.at(at + within).extinction, tf.at(at).extinction});
    double extinction = largest ? high : low;
    for (const preint::ControlPoint& point : tf.points()) {
      if (std::abs(point.value - at) > within) continue;
      extinction =
          largest ? std::max(extinction, point.extinction) : std::min(extinction, point.extinction);
    }
    result.push_back({at, tf.at(at).color, extinction});
  }
  return preint::TransferFunction(result);
}

/// What a ray of no length may come to: nothing but where colors do not depend on lengths.
Rgba touched(const project::Scene& scene) {
  return Rgba::Constant(scene.mode == Mode::mip || scene.mode == Mode::iso ? 1 : 0);
}

}  // namespace

Rgba summation_bound(const Rgba& exact, const Roundings& roundings, double segments) {
  const double relative = roundings.channel + segments * roundings.per_segment;
  const double color = std::max(roundings.unit, exact.head<3>().abs().maxCoeff());
  return relative * Rgba(color, color, color, 1);
}

Convex convex_box(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& gradient,
                  double at_origin) {
  Convex body{{}, gradient, at_origin};
  for (int axis = 0; axis < 3; ++axis) {
    body.sides.push_back({Eigen::Vector3d::Unit(axis), box.max()[axis]});
    body.sides.push_back({-Eigen::Vector3d::Unit(axis), -box.min()[axis]});
  }
  return body;
}

Bounded closed_form(const Convex& body, const project::Scene& scene, const Roundings& roundings,
                    double segments) {
  const ClosedForm form(body, scene);
  Convex smaller = body;
  Convex larger = body;
  for (std::size_t i = 0; i < body.sides.size(); ++i) {
    const double by = roundings.vertex * body.sides[i].normal.norm();
    smaller.sides[i].offset -= by;
    larger.sides[i].offset += by;
  }
  const double value = roundings.value + roundings.control_point;
  project::Scene stronger_scene = scene;
  project::Scene weaker_scene = scene;
  stronger_scene.transfer_function = envelope(scene.transfer_function, value, true);
  weaker_scene.transfer_function = envelope(scene.transfer_function, value, false);
  const ClosedForm stronger(body, stronger_scene);
  const ClosedForm weaker(body, weaker_scene);
  const ClosedForm in_smaller(smaller, scene);
  const ClosedForm in_larger(larger, scene);
  const project::Frame frame = make_frame(scene);
  Bounded result{project::Image(frame.width(), frame.height()),
                 project::Image(frame.width(), frame.height())};
  for (int y = 0; y < frame.height(); ++y) {
    for (int x = 0; x < frame.width(); ++x) {
      const Chord chord = form.chord(x, y);
      const Rgba exact = form.color(chord);
      Rgba bound = summation_bound(exact, roundings, segments);
      const double p = roundings.position;
      const auto moved = [&](double dx, double dy) {
        return form.color(form.chord(x + dx, y + dy));
      };
      include(bound, exact, moved(p, p), moved(-p, -p));
      include(bound, exact, moved(p, -p), moved(-p, p));
      include(bound, exact, in_smaller.color(in_smaller.chord(x, y)),
              in_larger.color(in_larger.chord(x, y)));
      include(bound, exact, stronger.color(chord), weaker.color(chord));
      const auto changed = [&](double front, double back, double length) {
        Chord other = chord;
        if (chord.room < -2 * roundings.depth) return exact;  // misses it all the same
        other.segment.front += front;
        other.segment.back += back;
        other.segment.length = std::max(0.0, other.segment.length + length);
        return form.color(other);
      };
      const double ends = 2 * roundings.depth * chord.stretch;
      include(bound, exact, changed(0, 0, ends), changed(0, 0, -ends));
      include(bound, exact, changed(roundings.value, 0, 0), changed(-roundings.value, 0, 0));
      include(bound, exact, changed(0, roundings.value, 0), changed(0, -roundings.value, 0));
      // A ray that touches the body alone may meet a surface there, or see the color of its value.
      if (std::abs(chord.room) < 2 * roundings.depth) bound += touched(scene);
      Eigen::Map<Eigen::Array4f>(result.image.pixel(x, y)) = exact.cast<float>();
      Eigen::Map<Eigen::Array4f>(result.bound.pixel(x, y)) = bound.cast<float>();
    }
  }
  return result;
}

}  // namespace tetraglass::tests
