#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/render_arguments.h"
#include "base/stopwatch.h"
#include "mesh/time_step.h"
#include "preint/transfer_function_edit.h"
#include "project/gl/context.h"
#include "project/render.h"
#include "project/verification.h"

namespace tetraglass::apps::view {

/// See all of the mesh from a direction.
struct Framing {
  Eigen::Vector3d direction = {1, 0.8, 0.6};
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double fov_degrees = 30;
  bool parallel = false;
};

/// A picture that is wanted.
struct DrawRequest {
  RenderArguments arguments;
  /// Counted up with every change of what is read, and of anything but the camera and the size.
  std::uint64_t mesh_version = 0;
  std::uint64_t scene_version = 0;
  std::optional<project::Camera> camera;  ///< none: by `framing`, or that of the arguments
  std::optional<Framing> framing;
  std::uint64_t framing_version = 0;
  int width = 0;  ///< of the picture in full, in pixels
  int height = 0;
  int coarseness = 1;  ///< so many pixels each way are drawn as one
  int verify = 0;      ///< this many random pixels are checked, of a picture in full
};

/// What the window shows of a scene beside its picture.
struct SceneFacts {
  std::vector<std::string> fields;
  std::string field;
  double low = 0;  ///< the field's range
  double high = 0;
  preint::Histogram histogram;
  preint::TransferFunction transfer_function{{preint::ControlPoint{}}};
  std::vector<preint::Isosurface> isosurfaces;
  project::Shading shading = project::Shading::none;
  std::optional<project::Lights> lights;
  project::Mode mode = project::Mode::full;
  mesh::Box box;
  std::size_t cells = 0;  ///< drawn
  std::size_t not_drawn = 0;
  std::vector<std::string> notes;                ///< of the import
  std::optional<mesh::NotedTimeStep> time_step;  ///< where the file has several
  std::vector<std::string> plan;
};

/// A picture, or why there is none.
struct Drawn {
  std::uint64_t mesh_version = 0;  ///< of the request
  std::uint64_t scene_version = 0;
  std::uint64_t framing_version = 0;
  std::string error;  ///< one line; nothing else is set then but
  std::exception_ptr failure;
  bool interrupted = false;  ///< given up by `Drawing::interrupt`; there is no picture
  project::Camera camera;
  int coarseness = 1;
  int width = 0;  ///< of `pixels`
  int height = 0;
  std::vector<std::uint8_t> pixels;  ///< RGBA as a .png has it
  project::Image image;              ///< in full only: what render writes
  project::Stats stats;
  double scene_ms = 0;  ///< setting up the scene, where it changed
  double draw_ms = 0;
  std::optional<project::Verification> verified;
  std::shared_ptr<const SceneFacts> facts;
};

/// What the drawing thread does, and for how long it has.
struct Busy {
  enum class Stage { read, set_up, draw, verify };
  Stage stage = Stage::draw;
  double ms = 0;
};

/// Draws on a thread of its own, one picture at a time. What is read and set up for a picture is
/// kept for the next ones.
class Drawing {
 public:
  using MakeContext = std::function<std::unique_ptr<project::gl::Context>()>;

  /// `wake` is called on the thread whenever a picture is ready. Where `make_context` is given it
  /// makes, on the thread, the context that the gl projector draws on, which is then chosen by
  /// itself where `prefer_gl`.
  explicit Drawing(std::function<void()> wake, MakeContext make_context = {},
                   bool prefer_gl = false);
  /// Gives up the picture in work, waits for what cannot be.
  ~Drawing();
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  /// Replaces a request that waits. The one in work is finished.
  void request(DrawRequest request);

  /// Gives up the picture in work, if there is one: it comes as one that was interrupted, soon.
  void interrupt();

  [[nodiscard]] std::optional<Busy> busy();

  /// The picture finished since the last call, if there is one.
  [[nodiscard]] std::unique_ptr<Drawn> take();

 private:
  class Work;
  void run();
  void begin(Busy::Stage stage);

  std::function<void()> wake_;
  MakeContext make_context_;
  bool prefer_gl_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<DrawRequest> waiting_;
  std::unique_ptr<Drawn> finished_;
  std::optional<std::pair<Busy::Stage, base::Stopwatch>> working_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace tetraglass::apps::view
