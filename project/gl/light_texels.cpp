#include "project/gl/light_texels.h"

#include "project/gl/mesh_buffers.h"
#include "project/light/light_maps.h"

namespace tetraglass::project::gl {

LightTexels::LightTexels(const Context& context, const Scene& scene, const Plan& plan) {
  if (!scene.lights) return;
  ambient_ = scene.lights->ambient.cast<float>().matrix();
  const mesh::Box box = mesh::bounds(*scene.mesh);
  sources_ = light_sources(*scene.lights, box, scene.transfer_function);
  if (plan.light_map == 0) {
    texels_.emplace(context, Texel::rgba32f);
    return;
  }
  // All surfaces have one shininess, and so has a medium (plan_light).
  const double value = scene.isosurfaces.empty() ? scene.transfer_function.points()[0].value
                                                 : scene.isosurfaces[0].value;
  const std::vector<LightSource> far = seen_from(sources_, box.center());
  const LightMap diffuse = diffuse_map(far, diffuse_size(plan.light_map));
  const LightMap specular =
      specular_map(far, scene.transfer_function.material_at(value).shininess, plan.light_map);
  diffuse_.emplace(context, diffuse.size, diffuse.rgba);
  specular_.emplace(context, specular.size, specular.rgba);
  map_bytes_ = sizeof(float) * (diffuse.rgba.size() + specular.rgba.size());
}

void LightTexels::set_uniforms(const Program& program) const {
  if (sources_.empty() && !texels_) return;
  program.set("ambient_light", ambient_);
  if (diffuse_) {
    program.set("diffuse_map", Units::kDiffuseMap);
    program.set("specular_map", Units::kSpecularMap);
    return;
  }
  program.set("lights", Units::kLights);
  program.set("light_count", static_cast<int>(sources_.size()));
}

void LightTexels::place(const Frame& frame, const ViewUniforms& view, double radius) {
  if (diffuse_) {
    diffuse_->bind(Units::kDiffuseMap);
    specular_->bind(Units::kSpecularMap);
  }
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
