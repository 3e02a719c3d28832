#include "project/render.h"

#include <optional>

#include "base/stopwatch.h"
#include "project/cpu/cell_projector.h"
#include "project/gl/cell_projector.h"
#include "project/gl/gl_projector.h"
#include "project/reference/grid_reference.h"
#include "project/reference/reference.h"
#include "project/slices/slices_projector.h"

namespace tetraglass::project {

Image average(const Image& samples, int n) {
  Image image(samples.width / n, samples.height / n);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        double sum = 0;
        for (int i = 0; i < n * n; ++i) sum += samples.pixel(n * x + i % n, n * y + i / n)[c];
        image.pixel(x, y)[c] = static_cast<float>(sum / (n * n));
      }
    }
  }
  return image;
}

struct SceneProjector::Kept {
  const Scene& scene;
  Plan plan;
  const gl::Context* context;  // of the user, or null
  std::optional<cpu::CellProjector> cpu;
  std::unique_ptr<gl::Context> own_context;
  std::optional<gl::CellProjector> gl;
};

SceneProjector::SceneProjector(const Scene& scene, const Plan& plan, Stats& stats,
                               const gl::Context* context)
    : kept_(new Kept{scene, plan, context, {}, {}, {}}) {
  if (plan.projector == Projector::cpu) kept_->cpu.emplace(scene, plan);
  if (plan.projector == Projector::gl) set_up_gl(stats);
}

void SceneProjector::set_up_gl(Stats& stats) {
  kept_->gl.reset();  // its buffers are freed before others are filled
  if (kept_->scene.drawable.cells.empty()) return;
  if (kept_->context == nullptr) {
    kept_->own_context = gl::Context::create(kept_->plan.context);
    kept_->context = kept_->own_context.get();
  }
  kept_->gl.emplace(*kept_->context, kept_->scene, kept_->plan, stats);
}

void SceneProjector::update(Stats& stats) {
  if (kept_->cpu) kept_->cpu->update();
  if (kept_->plan.projector == Projector::gl) set_up_gl(stats);
}

SceneProjector::~SceneProjector() = default;

Image SceneProjector::draw(Stats& stats) {
  const Scene& scene = kept_->scene;
  const auto samples = [&]() -> Image {
    if (kept_->cpu) return kept_->cpu->draw(make_frame(scene), stats);
    if (kept_->gl) return kept_->gl->draw(make_frame(scene), stats);
    switch (kept_->plan.projector) {
      case Projector::reference:
        return render_reference(scene, stats);
      case Projector::slices:
        return render_slices(scene, kept_->plan, stats);
      case Projector::grid_reference:
        return render_grid_reference(scene, stats);
      case Projector::cpu:
      case Projector::gl:
        break;
    }
    return render_gl(scene, kept_->plan, stats);  // of no cell
  };
  Image image = samples();
  if (scene.samples == 1) return image;
  const base::Stopwatch clock;
  Image result = average(image, scene.samples);
  stats.add(Effect::samples, image.rgba.size() * sizeof(float), clock.milliseconds());
  return result;
}

Image render(const Scene& scene, const Plan& plan, Stats& stats) {
  return SceneProjector(scene, plan, stats).draw(stats);
}

}  // namespace tetraglass::project
