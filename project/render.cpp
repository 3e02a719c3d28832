#include "project/render.h"

#include "base/stopwatch.h"
#include "project/cpu/cpu_projector.h"
#include "project/gl/gl_projector.h"
#include "project/reference/grid_reference.h"
#include "project/reference/reference.h"
#include "project/slices/slices_projector.h"

namespace tetraglass::project {
namespace {

Image draw_samples(const Scene& scene, const Plan& plan, Stats& stats) {
  switch (plan.projector) {
    case Projector::gl:
      return render_gl(scene, plan, stats);
    case Projector::cpu:
      return render_cpu(scene, plan, stats);
    case Projector::reference:
      return render_reference(scene, stats);
    case Projector::slices:
      return render_slices(scene, plan, stats);
    case Projector::grid_reference:
      return render_grid_reference(scene, stats);
  }
  return {};
}

}  // namespace

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

Image render(const Scene& scene, const Plan& plan, Stats& stats) {
  const Image samples = draw_samples(scene, plan, stats);
  if (scene.samples == 1) return samples;
  const base::Stopwatch clock;
  Image image = average(samples, scene.samples);
  stats.add(Effect::samples, samples.rgba.size() * sizeof(float), clock.milliseconds());
  return image;
}

}  // namespace tetraglass::project
