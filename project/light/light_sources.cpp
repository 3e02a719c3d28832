#include "project/light/light_sources.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "preint/gauss.h"

namespace tetraglass::project {
namespace {

using preint::GaussNode;

/// The smallest rule with at least so many nodes, or the largest.
std::span<const GaussNode> rule_of(double nodes) {
  if (nodes <= 4) return preint::kGauss4;
  if (nodes <= 6) return preint::kGauss6;
  if (nodes <= 10) return preint::kGauss10;
  return preint::kGauss14;
}

class Collector {
 public:
  Collector(const Eigen::AlignedBox3d& scene, double shininess)
      : scene_(scene), lobe_(1 / std::sqrt(std::max(1.0, shininess))) {}

  void operator()(const DirectionalLight& light) {
    sources.push_back({-light.direction.stableNormalized(), true, light.color});
  }
  void operator()(const PointLight& light) {
    sources.push_back({light.position, false, light.color});
  }
  void operator()(const RectangleLight& light) {
    const std::span<const GaussNode> first = edge_rule(light, 0);
    const std::span<const GaussNode> second = edge_rule(light, 1);
    for (const GaussNode& a : first) {
      for (const GaussNode& b : second) {
        sources.push_back({light.corner + a.x * light.edges[0] + b.x * light.edges[1], false,
                           a.weight * b.weight * light.color});
      }
    }
  }

  std::vector<LightSource> sources;

 private:
  [[nodiscard]] std::span<const GaussNode> edge_rule(const RectangleLight& light,
                                                     std::size_t edge) const {
    Eigen::AlignedBox3d bounds(light.corner);
    bounds.extend(light.corner + light.edges[0]);
    bounds.extend(light.corner + light.edges[1]);
    bounds.extend(light.corner + light.edges[0] + light.edges[1]);
    const double angle = 2 * std::atan2(0.5 * light.edges[edge].stableNorm(),
                                        std::sqrt(scene_.squaredExteriorDistance(bounds)));
    constexpr double kMargin = 2;  // of a rule of n nodes two serve the ends
    return rule_of(angle / lobe_ + kMargin);
  }

  const Eigen::AlignedBox3d& scene_;
  double lobe_;
};

}  // namespace

LightSource viewed(const LightSource& source, const Frame& frame, double depth, double unit) {
  LightSource result = source;
  if (source.far_away) {
    result.place = frame.axes() * source.place;
  } else {
    result.place = (frame.to_camera(source.place) - Eigen::Vector3d(0, 0, depth)) / unit;
    // So far off it is the direction that counts, and floats hold its square.
    constexpr double kFar = 1e15;
    result.place = result.place.cwiseMax(-kFar).cwiseMin(kFar);
  }
  return result;
}

std::vector<LightSource> light_sources(const Lights& lights, const Eigen::AlignedBox3d& scene,
                                       const preint::TransferFunction& tf) {
  double shininess = 0;
  for (const preint::ControlPoint& point : tf.points())
    shininess = std::max(shininess, point.material.shininess);
  Collector collector(scene, shininess);
  for (const auto& light : lights.lights) std::visit(collector, light);
  return collector.sources;
}

}  // namespace tetraglass::project
