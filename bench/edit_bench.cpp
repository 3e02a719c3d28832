// How long the window takes from an edit of the transfer function to the picture, beyond drawing
// it. usage: edit_bench FILE
#include <cstdio>
#include <semaphore>
#include <string>
#include <vector>

#include "apps/view/drawing.h"
#include "base/median.h"
#include "base/stopwatch.h"

namespace {

using namespace tetraglass;
using namespace tetraglass::apps;

/// Edits that are drawn with so many pixels each way as one.
void edit(view::Drawing& drawing, std::binary_semaphore& ready, view::DrawRequest request,
          int coarseness) {
  constexpr int kEdits = 9;
  request.coarseness = coarseness;
  std::vector<double> scene_ms;
  std::vector<double> draw_ms;
  std::vector<double> total_ms;
  for (int i = 0; i <= kEdits; ++i) {
    request.arguments.own_transfer_function = preint::TransferFunction(
        {{0.1, {0, 0, 1}, 0.0}, {0.5 + 0.01 * i, {1, 0, 0}, 3.0}, {1.2, {1, 1, 0}, 1.0}});
    ++request.scene_version;
    const base::Stopwatch clock;
    drawing.request(request);
    ready.acquire();
    const double ms = clock.milliseconds();
    const auto drawn = drawing.take();
    if (!drawn->error.empty()) {
      std::fprintf(stderr, "edit_bench: %s\n", drawn->error.c_str());
      return;
    }
    request.camera = drawn->camera;
    if (i == 0) continue;  // reads the file, or draws the first picture of this size
    scene_ms.push_back(drawn->scene_ms);
    draw_ms.push_back(drawn->draw_ms);
    total_ms.push_back(ms);
  }
  std::printf("1/%d of the resolution: %.0f ms, of them %.0f to set up the scene, %.0f to draw\n",
              coarseness, base::median(total_ms), base::median(scene_ms), base::median(draw_ms));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: edit_bench FILE\n");
    return 2;
  }
  std::binary_semaphore ready(0);
  view::Drawing drawing([&] { ready.release(); });
  view::DrawRequest request;
  request.arguments.input = argv[1];
  request.mesh_version = 1;
  request.scene_version = 1;
  request.width = 1024;
  request.height = 768;
  for (const int coarseness : {6, 2, 1}) {
    edit(drawing, ready, request, coarseness);
    request.scene_version += 100;
  }
}
