#include "tests/stability/roundings.h"

#include <algorithm>
#include <cmath>

#include "project/camera.h"

namespace tetraglass::tests {

using project::Projector;

Roundings roundings(const project::Scene& scene, Projector projector, double input) {
  const project::Frame frame = make_frame(scene);
  const mesh::Box box = mesh::bounds(*scene.mesh);
  const double radius = 0.5 * box.diagonal().norm();
  const double middle = std::max(frame.to_camera(box.center()).z(), radius);
  const double pixels_per_radius = radius / (frame.pitch() * (frame.parallel() ? 1 : middle));
  const double half_range = std::max(0.5 * scene.field.max - 0.5 * scene.field.min, 0.0);
  const double gain = frame.parallel() ? 1 : 4;
  const bool blends = scene.mode == project::Mode::full || scene.mode == project::Mode::iso;
  Roundings result;
  switch (projector) {
    case Projector::reference:
    case Projector::grid_reference:  // grids only: not drawn here
    case Projector::slices:
      result = {std::ldexp(pixels_per_radius + scene.width, -48),
                std::ldexp(radius, -50),
                std::ldexp(radius, -45),
                std::ldexp(half_range, -45),
                std::ldexp(half_range, -50),
                0x1p-50,
                0x1p-23};
      break;
    case Projector::cpu:
      result = {0x1p-20,
                std::ldexp(radius, -50),
                gain * std::ldexp(radius, -20),
                std::ldexp(half_range, -20),
                std::ldexp(half_range, -25),
                0x1p-23,
                1e-6 + (blends ? 2e-5 : 0)};
      break;
    case Projector::gl:
      result = {std::ldexp(std::max<double>(2 * frame.middle().maxCoeff(), pixels_per_radius), -21),
                std::sqrt(3) * std::ldexp(radius, -25),
                gain * std::ldexp(radius, -20),
                std::ldexp(half_range, -20),
                std::ldexp(half_range, -25),
                0x1p-23,
                1e-6};
      break;
  }
  const bool exact = projector == Projector::reference;
  if (scene.mode == project::Mode::iso && !exact) result.value += std::ldexp(half_range, -21);
  const bool shaded = scene.shading != project::Shading::none;
  if (shaded && !exact) result.channel += (0.2 * 32 * 4 + 0.7) * 0x1p-22;
  if (scene.mode == project::Mode::thickness) result.unit = radius;
  result.vertex += input;
  result.depth += input;
  result.position += input / radius * pixels_per_radius;
  return result;
}

}  // namespace tetraglass::tests
