#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "preint/transfer_function.h"

namespace tetraglass::project {

/// A straight line in the mesh's coordinates, of the same width everywhere in the picture.
struct OpaqueLine {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  preint::Color color = preint::Color::Ones();  ///< linear
  double width = 1;                             ///< > 0, in pixels of the picture
};

/// Triangles in the mesh's coordinates, seen and lit from both sides.
struct OpaqueSurface {
  std::vector<Eigen::Vector3d> points;  ///< finite
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Eigen::Vector3d> normals;  ///< of each triangle's corners, 3 each, of any length
  preint::Color color = preint::Color::Ones();
};

/// What is drawn with the volume, at its depth in it. Clip planes do not cut it.
struct OpaqueGeometry {
  std::vector<OpaqueLine> lines;
  std::vector<OpaqueSurface> surfaces;

  [[nodiscard]] bool empty() const { return lines.empty() && surfaces.empty(); }
};

/// The twelve edges of a box.
[[nodiscard]] std::vector<OpaqueLine> box_outline(const Eigen::AlignedBox3d& box,
                                                  const preint::Color& color, double width);

/// The surface with a normal at each corner: the mean of the triangles there, by their areas, that
/// turn away from the corner's own triangle by less than `crease_degrees`, so that edges of solids
/// stay sharp. Cost: linear in the triangles around each point.
[[nodiscard]] OpaqueSurface shaded_surface(std::vector<Eigen::Vector3d> points,
                                           std::vector<std::array<std::uint32_t, 3>> triangles,
                                           const preint::Color& color, double crease_degrees = 40);

}  // namespace tetraglass::project
