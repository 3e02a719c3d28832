#pragma once

#include <algorithm>
#include <ostream>
#include <vector>

#include <rapidcheck.h>

#include "preint/segment_integral.h"

/// Random transfer functions and segments for the tests of identities. Values lie on a coarse grid
/// half of the time, so that segments often begin and end exactly at control points and jumps.
namespace tetraglass::preint {

inline std::ostream& operator<<(std::ostream& out, const ControlPoint& p) {
  return out << "{" << p.value << ", (" << p.color.transpose() << "), " << p.extinction << "}";
}

inline std::ostream& operator<<(std::ostream& out, const TransferFunction& tf) {
  for (const ControlPoint& p : tf.points()) out << p << " ";
  return out;
}

inline std::ostream& operator<<(std::ostream& out, const Segment& s) {
  out.precision(17);
  return out << "{front " << s.front << ", back " << s.back << ", length " << s.length << "}";
}

}  // namespace tetraglass::preint

namespace tetraglass::tests {

inline rc::Gen<double> unit() {
  return rc::gen::map(rc::gen::inRange(0, 1000001), [](int i) { return i / 1e6; });
}

inline rc::Gen<double> field_value() {
  const auto grid = rc::gen::map(rc::gen::inRange(-8, 9), [](int i) { return i / 4.0; });
  const auto any = rc::gen::map(unit(), [](double u) { return 4 * u - 2; });
  return rc::gen::oneOf(grid, any);
}

inline rc::Gen<double> extinction(double most) {
  return rc::gen::oneOf(rc::gen::element(0.0, 0.0, 1e-30, most),
                        rc::gen::map(unit(), [](double u) { return 4 * u; }),
                        rc::gen::map(unit(), [most](double u) { return most * u; }));
}

inline rc::Gen<preint::TransferFunction> transfer_function(double most_extinction = 1e6) {
  return rc::gen::exec([most_extinction] {
    auto values = *rc::gen::container<std::vector<double>>(*rc::gen::inRange<std::size_t>(1, 9),
                                                           field_value());
    std::sort(values.begin(), values.end());
    std::vector<preint::ControlPoint> points;
    for (const double v : values) {
      const std::size_t n = points.size();
      if (n > 1 && points[n - 2].value == v) continue;
      const preint::Color color(*unit(), *unit(), *unit());
      points.push_back({v, color, *extinction(most_extinction)});
    }
    return preint::TransferFunction(points);
  });
}

inline rc::Gen<preint::Segment> segment(double longest = 1000) {
  return rc::gen::exec([longest] {
    const double front = *field_value();
    const double back = *rc::gen::oneOf(field_value(), rc::gen::just(front),
                                        rc::gen::just(front + 1e-9), rc::gen::just(-10 * front));
    const double length = *rc::gen::oneOf(rc::gen::element(0.0, 1e-30, 1e-6, longest),
                                          rc::gen::map(unit(), [](double u) { return 3 * u; }));
    return preint::Segment{front, back, length};
  });
}

}  // namespace tetraglass::tests
