#include "project/gl/light_texels.h"

#include "project/gl/mesh_buffers.h"

namespace tetraglass::project::gl {

LightTexels::LightTexels(const Context& context, const Scene& scene) {
  if (!scene.lights) return;
  ambient_ = scene.lights->ambient.cast<float>().matrix();
  sources_ = light_sources(*scene.lights, mesh::bounds(*scene.mesh), scene.transfer_function);
  texels_.emplace(context, Texel::rgba32f);
}

void LightTexels::set_uniforms(const Program& program) const {
  if (!texels_) return;
  program.set("lights", Units::kLights);
  program.set("light_count", static_cast<int>(sources_.size()));
  program.set("ambient_light", ambient_);
}

void LightTexels::place(const Frame& frame, const ViewUniforms& view, double radius) {
  if (!texels_) return;
  std::vector<Eigen::Vector4f> texels;
  for (const LightSource& source : sources_) {
    const LightSource seen = viewed(source, frame, view.focus() * radius, radius);
    texels.emplace_back();
    texels.back() << seen.place.cast<float>(), seen.far_away ? 0.0F : 1.0F;
    texels.emplace_back();
    texels.back() << seen.color.cast<float>().matrix(), 0.0F;
  }
  texels_->upload(texels, "lights");
  texels_->bind(Units::kLights);
}

}  // namespace tetraglass::project::gl
