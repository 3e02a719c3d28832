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
/// Nothing else of the scene may change but its opaque geometry; it outlives this.
class SceneProjector {
 public:
  /// Throws as `render`. Adds the time for tables to `stats`. gl draws on `context`, which outlives
  /// this, or where there is none on one of its own by the plan.
  SceneProjector(const Scene& scene, const Plan& plan, Stats& stats,
                 const gl::Context* context = nullptr);
  ~SceneProjector();
  SceneProjector(const SceneProjector&) = delete;
  SceneProjector& operator=(const SceneProjector&) = delete;

  [[nodiscard]] Image draw(Stats& stats);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// Each pixel the mean of n x n samples.
[[nodiscard]] Image average(const Image& samples, int n);

}  // namespace tetraglass::project
