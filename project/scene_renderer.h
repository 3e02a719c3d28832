#pragma once

#include <memory>

#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "project/stats.h"

namespace tetraglass::project {

namespace gl {
class Context;
}

/// From where, and in how many pixels.
struct View {
  Camera camera;
  int width = 800;
  int height = 600;
  int samples = 1;  ///< each way
};

/// Draws one scene from view after view: what the cpu and gl projectors set up for a scene is kept
/// between pictures. Others are set up anew each time.
class SceneRenderer {
 public:
  /// The scene's mesh, and the context, outlive this. gl draws on `context`, or where there is none
  /// on one of its own by the plan. Adds the time for tables to `stats`. Throws as `render` does.
  SceneRenderer(Scene scene, Plan plan, Stats& stats, const gl::Context* context = nullptr);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  /// What `render` gives for the scene seen so; adds what it took to `stats`. Throws as `render`
  /// does.
  [[nodiscard]] Image draw(const View& view, Stats& stats);

  /// As it was drawn last.
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }

 private:
  struct Kept;
  Scene scene_;
  Plan plan_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace tetraglass::project
