#pragma once

#include <memory>

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

/// Draws the scene by the plan's projector and adds what it took to `stats`. Every projector gives
/// the same picture within the tolerance that the tests state. Throws UnavailableError where the
/// plan's context cannot be had, UsageError for a camera that sees nothing.
[[nodiscard]] Image render(const Scene& scene, const Plan& plan, Stats& stats);

namespace gl {
class Context;
}

/// The same for any number of views of a scene, as its `camera`, size and samples say when a
/// picture is drawn: the cpu and gl projectors set up once what does not depend on the view.
/// Of the rest of the scene only its opaque geometry may change, and, with `update`, what shows; it
/// outlives this.
class SceneProjector {
 public:
  /// Throws as `render`. Adds the time for tables to `stats`. gl draws on `context`, which outlives
  /// this, or where there is none on one of its own by the plan.
  SceneProjector(const Scene& scene, const Plan& plan, Stats& stats,
                 const gl::Context* context = nullptr);
  ~SceneProjector();
  SceneProjector(const SceneProjector&) = delete;
  SceneProjector& operator=(const SceneProjector&) = delete;

  /// To be called after the scene's field, transfer function, isosurfaces, lights or modulation
  /// have changed, but not its mesh, its mode or what the plan depends on. The cpu projector keeps
  /// what depends on the mesh alone, gl its context. Adds the time for tables to `stats`.
  void update(Stats& stats);

  [[nodiscard]] Image draw(Stats& stats);

 private:
  void set_up_gl(Stats& stats);

  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// Each pixel the mean of n x n samples.
[[nodiscard]] Image average(const Image& samples, int n);

}  // namespace tetraglass::project
