#include "apps/view/drawing.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "apps/mesh_input.h"
#include "apps/picture_output.h"
#include "base/errors.h"
#include "base/stopwatch.h"

namespace tetraglass::apps::view {
namespace {

constexpr std::size_t kBins = 128;

/// The fields as --field names them; the magnitude and the components of vectors.
std::vector<std::string> field_names(const mesh::TetMesh& mesh) {
  std::vector<std::string> names;
  std::set<std::string> point_fields;
  for (const mesh::Field& field : mesh.fields) {
    if (field.location == mesh::Location::point) point_fields.insert(field.name);
  }
  for (const mesh::Field& field : mesh.fields) {
    const bool hidden = field.location == mesh::Location::cell && point_fields.contains(field.name);
    const std::string name = hidden ? field.name + "@cell" : field.name;
    names.push_back(name);
    if (field.components == 1) continue;
    for (int i = 0; i < field.components; ++i) {
      constexpr std::string_view kAxes = "xyz";
      names.push_back(name + ":" +
                      (field.components == 3 ? std::string(1, kAxes[static_cast<std::size_t>(i)])
                                             : std::to_string(i)));
    }
  }
  if (names.empty()) names = {"x", "y", "z", "radius"};
  return names;
}

std::vector<std::uint8_t> to_pixels(const project::Image& image,
                                    const project::Background& background) {
  std::vector<std::uint8_t> pixels(image.rgba.size());
  const std::size_t row = 4 * static_cast<std::size_t>(image.width);
  tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(image.height), [&](std::size_t y) {
    project::Image line(image.width, 1);
    std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(y * row), row, line.rgba.begin());
    const project::Image encoded = project::encode(line, background);
    for (std::size_t i = 0; i < row; ++i) {
      pixels[y * row + i] =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(encoded.rgba[i], 0.0F, 1.0F)));
    }
  });
  return pixels;
}

project::Camera framed(const mesh::TetMesh& mesh, const Framing& framing, double aspect) {
  project::Camera camera = project::frame_camera(mesh.points, framing.direction, framing.up,
                                                 framing.fov_degrees, aspect);
  camera.parallel = framing.parallel;
  return camera.parallel ? project::centered(camera, mesh.points) : camera;
}

int coarse(int pixels, int coarseness) {
  return (pixels + coarseness - 1) / coarseness;
}

}  // namespace

/// What is kept from picture to picture, on the drawing thread.
class Drawing::Work {
 public:
  Work(const MakeContext& make_context, bool prefer_gl)
      : make_context_(make_context), prefer_gl_(prefer_gl) {}

  Drawn draw(const DrawRequest& request);

 private:
  void read(const DrawRequest& request);
  void set_up(const DrawRequest& request, Drawn& drawn);
  project::Plan make_plan(const project::Scene& scene, const RenderArguments& arguments);
  const project::gl::Context* context();

  const MakeContext& make_context_;
  bool prefer_gl_;
  std::optional<std::uint64_t> mesh_version_;
  std::optional<std::uint64_t> scene_version_;
  std::unique_ptr<project::gl::Context> context_;
  mesh::Import import_;
  std::shared_ptr<const SceneFacts> facts_;
  int samples_ = 1;
  std::optional<project::SceneRenderer> renderer_;
};

const project::gl::Context* Drawing::Work::context() {
  if (!context_ && make_context_) context_ = make_context_();
  return context_.get();
}

project::Plan Drawing::Work::make_plan(const project::Scene& scene,
                                       const RenderArguments& arguments) {
  project::Request request = make_request(arguments);
  if (prefer_gl_ && !request.projector) {
    request.projector = project::Projector::gl;
    try {
      return project::plan(scene, request);
    } catch (const base::UsageError&) {  // gl lacks what is asked for
      request.projector.reset();
    }
  }
  return project::plan(scene, request);
}

void Drawing::Work::read(const DrawRequest& request) {
  if (mesh_version_ == request.mesh_version) return;
  renderer_.reset();
  facts_.reset();
  mesh_version_.reset();
  scene_version_.reset();
  mesh::ImportOptions options = request.arguments.import;
  options.grid_only = draws_grid(request.arguments);
  import_ = import_and_tell(request.arguments.input, options);
  mesh_version_ = request.mesh_version;
}

void Drawing::Work::set_up(const DrawRequest& request, Drawn& drawn) {
  if (scene_version_ == request.scene_version) return;
  const base::Stopwatch clock;
  renderer_.reset();
  scene_version_.reset();
  project::Scene scene = make_scene(request.arguments, import_.mesh);
  samples_ = scene.samples;
  auto facts = std::make_shared<SceneFacts>();
  facts->fields = field_names(import_.mesh);
  facts->field = scene.field.name;
  facts->low = scene.field.min;
  facts->high = scene.field.max;
  if (facts->low < facts->high) {
    facts->histogram = preint::histogram(scene.field.values, facts->low, facts->high, kBins);
  }
  facts->transfer_function = scene.transfer_function;
  for (const preint::Isosurface& surface : scene.isosurfaces) {
    facts->isovalues.push_back(surface.value);
  }
  facts->mode = scene.mode;
  facts->box = mesh::bounds(import_.mesh);
  facts->cells = scene.drawable.cells.size();
  facts->not_drawn = scene.drawable.degenerate + scene.drawable.nan;
  facts->notes = import_.report.notes;
  project::Plan plan = make_plan(scene, request.arguments);
  facts->plan = plan.reasons;
  const bool gl = plan.projector == project::Projector::gl;
  renderer_.emplace(std::move(scene), std::move(plan), drawn.stats, gl ? context() : nullptr);
  facts_ = std::move(facts);
  scene_version_ = request.scene_version;
  drawn.scene_ms = clock.milliseconds();
}

Drawn Drawing::Work::draw(const DrawRequest& request) {
  Drawn drawn;
  read(request);
  set_up(request, drawn);
  const double aspect = static_cast<double>(request.width) / request.height;
  drawn.camera = request.camera    ? *request.camera
                 : request.framing ? framed(import_.mesh, *request.framing, aspect)
                                   : make_camera(request.arguments, import_.mesh, aspect);
  drawn.coarseness = request.coarseness;
  drawn.width = coarse(request.width, request.coarseness);
  drawn.height = coarse(request.height, request.coarseness);
  const base::Stopwatch clock;
  drawn.image = renderer_->draw(
      {drawn.camera, drawn.width, drawn.height, request.coarseness == 1 ? samples_ : 1},
      drawn.stats);
  const project::Mode mode = renderer_->scene().mode;
  drawn.pixels =
      to_pixels(scaled_for_8_bits(drawn.image, mode), make_background(request.arguments, mode));
  drawn.draw_ms = clock.milliseconds();
  if (request.verify > 0 && request.coarseness == 1) {
    drawn.verified = project::verify(renderer_->scene(), drawn.image, request.verify);
  }
  drawn.facts = facts_;
  return drawn;
}

Drawing::Drawing(std::function<void()> wake, MakeContext make_context, bool prefer_gl)
    : wake_(std::move(wake)),
      make_context_(std::move(make_context)),
      prefer_gl_(prefer_gl),
      thread_([this] { run(); }) {}

Drawing::~Drawing() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Drawing::request(DrawRequest request) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(request);
  }
  changed_.notify_one();
}

std::unique_ptr<Drawn> Drawing::take() {
  const std::lock_guard lock(mutex_);
  return std::move(finished_);
}

void Drawing::run() {
  Work work(make_context_, prefer_gl_);
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stop_ || waiting_; });
    if (stop_) return;
    const DrawRequest request = *std::exchange(waiting_, std::nullopt);
    lock.unlock();
    auto drawn = std::make_unique<Drawn>();
    try {
      *drawn = work.draw(request);
    } catch (const std::bad_alloc&) {
      drawn->error = "not enough memory for this picture";
      drawn->failure = std::current_exception();
    } catch (const std::exception& error) {
      drawn->error = error.what();
      drawn->failure = std::current_exception();
    }
    drawn->mesh_version = request.mesh_version;
    drawn->scene_version = request.scene_version;
    drawn->framing_version = request.framing_version;
    lock.lock();
    finished_ = std::move(drawn);
    lock.unlock();
    wake_();
  }
}

}  // namespace tetraglass::apps::view
