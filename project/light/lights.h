#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "preint/transfer_function.h"

namespace tetraglass::project {

/// Light from infinitely far away.
struct DirectionalLight {
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< in which it shines; not 0
  preint::Color color = preint::Color::Ones();
};

/// Light from one point, anywhere, inside the mesh too.
struct PointLight {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  preint::Color color = preint::Color::Ones();
};

/// Light from the points corner + x edges[0] + y edges[1], x and y in [0, 1]: the mean over them.
struct RectangleLight {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 2> edges = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  preint::Color color = preint::Color::Ones();
};

/// In the mesh's coordinates. Light does not fall off with distance and throws no shadows.
struct Lights {
  preint::Color ambient = preint::Color::Ones();
  std::vector<std::variant<DirectionalLight, PointLight, RectangleLight>> lights;
};

/// From a file: {"ambient": [r, g, b], "lights": [{"type": "directional", "direction": [x, y, z],
/// "color": [r, g, b]}, {"type": "point", "position": ..., "color": ...}, {"type": "rectangle",
/// "corner": ..., "edges": [[x, y, z], [x, y, z]], "color": ...}]}. Ambient and colors are white
/// where they are left out. Throws ReadError with the place where something is wrong: numbers that
/// are not finite, a direction of no length, negative colors.
[[nodiscard]] Lights read_lights(const std::string& file);

}  // namespace tetraglass::project
