#pragma once

#include <optional>
#include <vector>

#include "project/gl/objects.h"
#include "project/gl/program.h"
#include "project/gl/view_uniforms.h"
#include "project/light/light_sources.h"
#include "project/plan.h"

namespace tetraglass::project::gl {

/// The lights of a scene on the context, as shade.glsl sums them up or looks them up in cube maps;
/// nothing for a headlight.
class LightTexels {
 public:
  /// Throws UnavailableError where they do not fit.
  LightTexels(const Context& context, const Scene& scene, const Plan& plan);

  /// Those of the uniforms that do not depend on the view.
  void set_uniforms(const Program& program) const;

  /// Places them for a view. `radius`: the unit of length.
  void place(const Frame& frame, const ViewUniforms& view, double radius);

  /// 0 for a headlight.
  [[nodiscard]] std::size_t bytes() const { return map_bytes_ + (texels_ ? texels_->bytes() : 0); }

 private:
  Eigen::Vector3f ambient_ = Eigen::Vector3f::Ones();
  std::vector<LightSource> sources_;
  std::optional<TextureBuffer> texels_;  // no maps
  std::optional<CubeMap> diffuse_;
  std::optional<CubeMap> specular_;
  std::size_t map_bytes_ = 0;
};

}  // namespace tetraglass::project::gl
