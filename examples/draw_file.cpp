// Reads a file, draws its first scalar field from a corner into a picture, checks some of its
// pixels and tells the largest error. usage: draw_file INPUT OUTPUT.png
#include <cstdio>
#include <exception>

#include "mesh/import.h"
#include "preint/transfer_function.h"
#include "project/image_file.h"
#include "project/plan.h"
#include "project/render.h"
#include "project/verification.h"

namespace {

using namespace tetraglass;

project::Scene make_scene(const mesh::TetMesh& mesh) {
  project::Scene scene;
  scene.mesh = &mesh;
  scene.field = mesh::select_scalar(mesh, "");  // or "Temp", "V:magnitude", "V:x"
  scene.drawable = mesh::find_drawable(mesh, scene.field);
  const mesh::Box box = mesh::bounds(mesh);
  scene.transfer_function =
      preint::preset("viridis", scene.field.min, scene.field.max, box.diagonal().norm());
  scene.mode = project::Mode::full;
  scene.width = 640;
  scene.height = 480;
  const double aspect = static_cast<double>(scene.width) / scene.height;
  scene.camera = project::frame_camera(mesh.points, {1, 0.8, 0.6}, {0, 0, 1}, 30, aspect);
  return scene;
}

void draw(const char* input, const char* output) {
  const mesh::Import import = mesh::import_mesh(input);
  const project::Scene scene = make_scene(import.mesh);
  project::Request request;
  request.projector = project::Projector::cpu;
  const project::Plan plan = project::plan(scene, request);
  project::Stats stats;
  const project::Image image = project::render(scene, plan, stats);
  project::write_image(image, output);
  const project::Verification check = project::verify(scene, image, 200);
  std::printf("%zu cells of '%s' in %.1f ms, largest error of %zu pixels %.1e\n",
              scene.drawable.cells.size(), scene.field.name.c_str(), stats.project_ms,
              static_cast<std::size_t>(check.pixels), check.max_error);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: draw_file INPUT OUTPUT.png\n");
    return 2;
  }
  try {
    draw(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_file: %s\n", error.what());
    return 1;
  }
}
