#pragma once

#include <string>
#include <vector>

#include "mesh/tet_mesh.h"
#include "project/image.h"
#include "project/plan.h"
#include "project/scene.h"
#include "tests/stability/convex.h"
#include "tests/stability/record.h"

namespace tetraglass::tests {

inline constexpr int kPixels = 24;  ///< each way, where nothing else is said

struct View {
  std::string name;
  project::Camera camera;
  int width = kPixels;
  int height = kPixels;
};

/// The box from outside, in perspective and by parallel rays, along no axis.
[[nodiscard]] std::vector<View> outside_views(const mesh::Box& box);

/// What is drawn: a mode with what belongs to it.
struct Effect {
  std::string name;
  project::Mode mode = project::Mode::full;
  project::MipOf mip_of = project::MipOf::field;
  project::Shading shading = project::Shading::none;
  double opacity = 1;  ///< of isosurfaces
};

/// Every mode; isosurfaces shaded and not, opaque and translucent.
[[nodiscard]] const std::vector<Effect>& effects();

/// The effect on the mesh's first field: a medium of five colors, about 2 deep along the diagonal;
/// isosurfaces at a third and at 0.6 of the range.
[[nodiscard]] project::Scene effect_scene(const mesh::TetMesh& mesh, const Effect& effect,
                                          const View& view);

[[nodiscard]] preint::TransferFunction five_colors(double low, double high, double diagonal);

/// A way to draw.
struct Contender {
  std::string name;
  std::string way;  ///< one of kWays
  project::Projector projector = project::Projector::cpu;
  project::Request request;
};

/// All that integrate exactly and whose order, where the scene needs one, is exact: cpu, gl and the
/// reference; gl by fragments too where cells are blended.
[[nodiscard]] std::vector<Contender> exact_contenders(const project::Scene& scene);

[[nodiscard]] project::Image draw(const project::Scene& scene, const project::Request& request);

/// The scene's picture by the reference, for meshes without a closed form. The bound is how much
/// that picture changes by the roundings of positions and values, and at most by those of the depth
/// of every face on the ray; 1 where two cells that overlap begin or end so near to each other that
/// rounding decides which is the nearer one.
[[nodiscard]] Bounded by_reference(const project::Scene& scene, const Roundings& roundings);

/// The most cells that a ray of the scene meets.
[[nodiscard]] double deepest(const project::Scene& scene);

/// Every effect by every contender from every view (of gl, modes that add up from the views in
/// turn), held against the closed form; then, from the first view, a medium that is the same
/// everywhere by the tables, psi and the ends of segments alone. `input`: what the mesh's points
/// were rounded to.
void expect_closed_forms(Record& record, const mesh::TetMesh& mesh, const Convex& body,
                         const std::vector<View>& views, double input = 0);

}  // namespace tetraglass::tests
