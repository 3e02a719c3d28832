#include "apps/view/drawing.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <tuple>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "apps/figure.h"
#include "apps/mesh_input.h"
#include "apps/picture_files.h"
#include "apps/view/camera_motion.h"
#include "base/errors.h"
#include "base/interrupt.h"
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

/// Whether what the cpu projector keeps of one scene serves another one of the same mesh.
bool can_update(const project::Scene& before, const project::Plan& plan_before,
                const project::Scene& scene, const project::Plan& plan) {
  const auto ways = [](const project::Plan& of) {
    return std::tie(of.projector, of.sort, of.integrator, of.table_n, of.table_m, of.opaque_at,
                    of.gradients);
  };
  return plan.projector == project::Projector::cpu && ways(plan) == ways(plan_before) &&
         scene.mode == before.mode && scene.shading == before.shading &&
         scene.gradient == before.gradient;
}

int coarse(int pixels, int coarseness) {
  return (pixels + coarseness - 1) / coarseness;
}

/// Each pixel the nearest one of a smaller picture.
project::Image enlarged(const project::Image& image, int width, int height) {
  if (image.width == width && image.height == height) return image;
  project::Image result(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::copy_n(image.pixel(x * image.width / width, y * image.height / height), 4,
                  result.pixel(x, y));
    }
  }
  return result;
}

}  // namespace

/// What is kept from picture to picture, on the drawing thread.
class Drawing::Work {
 public:
  using Begin = std::function<void(Busy::Stage)>;

  Work(const MakeContext& make_context, bool prefer_gl, Begin begin)
      : make_context_(make_context), prefer_gl_(prefer_gl), begin_(std::move(begin)) {}

  Drawn draw(const DrawRequest& request);

 private:
  void read(const DrawRequest& request);
  void select(const RenderArguments& arguments);
  void set_up(const DrawRequest& request, Drawn& drawn);
  project::Plan make_plan(const project::Scene& scene, const RenderArguments& arguments);
  const project::gl::Context* context();

  const MakeContext& make_context_;
  bool prefer_gl_;
  Begin begin_;
  std::optional<std::uint64_t> mesh_version_;
  std::optional<std::uint64_t> scene_version_;
  std::unique_ptr<project::gl::Context> context_;
  mesh::Import import_;
  std::shared_ptr<const SceneFacts> facts_;
  struct KeptField {
    std::string name;  // as asked for
    bool of_grid = false;
    DrawnField drawn;
    preint::Histogram histogram;
  };
  std::optional<KeptField> field_;  // of the mesh
  int samples_ = 1;
  project::Scene scene_;
  project::Camera first_camera_;  // of the scene by its arguments
  project::Plan plan_;
  std::optional<project::SceneProjector> projector_;  // of them: dies first
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
  begin_(Busy::Stage::read);
  mesh::ImportOptions options = request.arguments.import;
  options.grid_only = draws_grid(request.arguments);
  // What is shown stays where this fails.
  mesh::Import import = import_and_tell(request.arguments.input, options);
  base::throw_if_interrupted();
  projector_.reset();
  facts_.reset();
  field_.reset();
  scene_version_.reset();
  import_ = std::move(import);
  mesh_version_ = request.mesh_version;
}

void Drawing::Work::select(const RenderArguments& arguments) {
  const bool of_grid = draws_grid(arguments);
  if (field_ && field_->name == arguments.field && field_->of_grid == of_grid) return;
  field_.reset();
  KeptField kept{arguments.field, of_grid, select_field(arguments, import_.mesh), {}};
  const mesh::ScalarField& field = kept.drawn.field;
  if (field.min < field.max) {
    kept.histogram = preint::histogram(field.values, field.min, field.max, kBins);
  }
  field_ = std::move(kept);
}

void Drawing::Work::set_up(const DrawRequest& request, Drawn& drawn) {
  if (scene_version_ == request.scene_version) return;
  begin_(Busy::Stage::set_up);
  const base::Stopwatch clock;
  scene_version_.reset();
  select(request.arguments);
  RenderArguments arguments = request.arguments;
  // To frame the mesh is a pass over its points.
  if (request.camera) static_cast<CameraArguments&>(arguments) = camera_arguments(*request.camera);
  project::Scene scene = make_scene(arguments, import_.mesh, field_->drawn);
  project::Plan plan = make_plan(scene, request.arguments);
  const bool updates = projector_ && can_update(scene_, plan_, scene, plan);
  if (!updates) projector_.reset();
  scene_ = std::move(scene);
  plan_ = std::move(plan);
  first_camera_ = scene_.camera;
  samples_ = scene_.samples;
  auto facts = std::make_shared<SceneFacts>();
  facts->fields = field_names(import_.mesh);
  facts->field = scene_.field.name;
  facts->low = scene_.field.min;
  facts->high = scene_.field.max;
  facts->histogram = field_->histogram;
  facts->transfer_function = scene_.transfer_function;
  facts->isosurfaces = scene_.isosurfaces;
  facts->shading = scene_.shading;
  facts->lights = scene_.lights;
  facts->mode = scene_.mode;
  facts->box = field_->drawn.box;
  facts->cells = scene_.drawable.cells.size();
  facts->not_drawn = scene_.drawable.degenerate + scene_.drawable.nan;
  facts->notes = import_.report.notes;
  facts->time_step = mesh::noted_time_step(facts->notes);
  facts->plan = plan_.reasons;
  const bool gl = plan_.projector == project::Projector::gl;
  if (updates) {
    projector_->update(drawn.stats);
  } else {
    projector_.emplace(scene_, plan_, drawn.stats, gl ? context() : nullptr);
  }
  facts_ = std::move(facts);
  scene_version_ = request.scene_version;
  drawn.scene_ms = clock.milliseconds();
}

Drawn Drawing::Work::draw(const DrawRequest& request) {
  Drawn drawn;
  read(request);
  set_up(request, drawn);
  scene_.width = request.width;
  scene_.height = request.height;
  const Figure figure(request.arguments, scene_, request.width, request.height);
  const int width = figure.picture_width();
  const int height = figure.picture_height();
  drawn.camera = request.camera ? *request.camera : first_camera_;
  if (request.framing) {
    const double aspect = static_cast<double>(width) / height;
    drawn.camera = figure.with_room_for_axes({framed(import_.mesh, *request.framing, aspect)});
  }
  drawn.coarseness = request.coarseness;
  begin_(Busy::Stage::draw);
  const base::Stopwatch clock;
  scene_.camera = drawn.camera;
  scene_.width = coarse(width, request.coarseness);
  scene_.height = coarse(height, request.coarseness);
  scene_.samples = request.coarseness == 1 ? samples_ : 1;
  const project::Image image = projector_->draw(drawn.stats);
  // What stands around the picture is always in full.
  drawn.image = request.arguments.figure.any()
                    ? figure.around(enlarged(image, width, height), drawn.camera)
                    : image;
  drawn.width = drawn.image.width;
  drawn.height = drawn.image.height;
  drawn.pixels = to_pixels(scaled_for_8_bits(drawn.image, scene_.mode),
                           make_background(request.arguments, scene_.mode));
  drawn.draw_ms = clock.milliseconds();
  if (request.verify > 0 && request.coarseness == 1) {
    begin_(Busy::Stage::verify);
    drawn.verified = project::verify(scene_, image, request.verify);
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
    base::interrupt(working_.has_value());
  }
  changed_.notify_one();
  thread_.join();
  base::interrupt(false);
}

void Drawing::request(DrawRequest request) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(request);
  }
  changed_.notify_one();
}

void Drawing::interrupt() {
  const std::lock_guard lock(mutex_);
  if (working_) base::interrupt(true);
}

std::optional<Busy> Drawing::busy() {
  const std::lock_guard lock(mutex_);
  if (!working_) return std::nullopt;
  return Busy{working_->first, working_->second.milliseconds()};
}

void Drawing::begin(Busy::Stage stage) {
  const std::lock_guard lock(mutex_);
  working_.emplace(stage, base::Stopwatch());
}

std::unique_ptr<Drawn> Drawing::take() {
  const std::lock_guard lock(mutex_);
  return std::move(finished_);
}

void Drawing::run() {
  Work work(make_context_, prefer_gl_, [this](Busy::Stage stage) { begin(stage); });
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stop_ || waiting_; });
    if (stop_) return;
    const DrawRequest request = *std::exchange(waiting_, std::nullopt);
    working_.emplace(Busy::Stage::draw, base::Stopwatch());
    lock.unlock();
    auto drawn = std::make_unique<Drawn>();
    try {
      *drawn = work.draw(request);
    } catch (const base::Interrupted&) {
      drawn->interrupted = true;
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
    working_.reset();
    base::interrupt(false);
    finished_ = std::move(drawn);
    lock.unlock();
    wake_();
  }
}

}  // namespace tetraglass::apps::view
