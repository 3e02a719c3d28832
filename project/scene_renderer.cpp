#include "project/scene_renderer.h"

#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "project/cpu/cell_projector.h"
#include "project/gl/cell_projector.h"
#include "project/gl/context.h"
#include "project/render.h"

namespace tetraglass::project {

struct SceneRenderer::Kept {
  std::optional<cpu::CellProjector> cpu;
  std::unique_ptr<gl::Context> own_context;
  const gl::Context* context = nullptr;
  std::optional<gl::CellProjector> gl;
};

SceneRenderer::SceneRenderer(Scene scene, Plan plan, Stats& stats, const gl::Context* context)
    : scene_(std::move(scene)), plan_(std::move(plan)), kept_(std::make_unique<Kept>()) {
  if (plan_.projector == Projector::cpu) {
    kept_->cpu.emplace(scene_, plan_);
  } else if (plan_.projector == Projector::gl && !scene_.drawable.cells.empty()) {
    if (context == nullptr) kept_->own_context = gl::Context::create(plan_.context);
    kept_->context = context == nullptr ? kept_->own_context.get() : context;
    kept_->gl.emplace(*kept_->context, scene_, plan_, stats);
  }
}

SceneRenderer::~SceneRenderer() = default;

Image SceneRenderer::draw(const View& view, Stats& stats) {
  scene_.camera = view.camera;
  scene_.width = view.width;
  scene_.height = view.height;
  scene_.samples = view.samples;
  if (!kept_->cpu && !kept_->gl) return render(scene_, plan_, stats);
  const Frame frame = make_frame(scene_);
  const Image samples = kept_->cpu ? kept_->cpu->draw(frame, stats) : kept_->gl->draw(frame, stats);
  if (view.samples == 1) return samples;
  const base::Stopwatch clock;
  Image image = average(samples, view.samples);
  stats.add(Effect::samples, samples.rgba.size() * sizeof(float), clock.milliseconds());
  return image;
}

}  // namespace tetraglass::project
