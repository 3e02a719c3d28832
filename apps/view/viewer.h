#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "apps/render_arguments.h"
#include "apps/view/camera_motion.h"
#include "apps/view/command_text.h"
#include "apps/view/drawing.h"
#include "apps/view/pacing.h"
#include "apps/view/transfer_function_editor.h"

namespace tetraglass::apps::view {

/// As --mode lists them.
[[nodiscard]] std::span<const std::string_view> mode_names();

struct CopiedCommand {
  std::string line;
  std::vector<std::string> files;
};

/// What the window shows, apart from how it is shown: the state of the view, which pictures have to
/// be drawn for it, and what is written to files.
class Viewer {
 public:
  /// `typed`: the options that `arguments` were made of.
  Viewer(RenderArguments arguments, std::vector<TypedOption> typed);

  /// The time of what follows, in milliseconds on any clock.
  void tick(double now_ms) { now_ms_ = now_ms; }

  void resize(int width, int height);
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  /// As in camera_motion.h, of the picture; nothing before there is a camera.
  void orbit(const Eigen::Vector2d& drag);
  void pan(const Eigen::Vector2d& drag);
  void zoom(double factor, const Eigen::Vector2d& place);
  void set_parallel(bool parallel);
  /// All of the mesh, from where it is seen now or from a direction.
  void frame();
  void look_from(const Eigen::Vector3d& direction);
  [[nodiscard]] const std::optional<project::Camera>& camera() const { return camera_; }

  /// Another file, by its defaults. Where it, or a time step, cannot be read, everything stays as
  /// it was and `refusal` says why.
  void open(const std::string& file);
  [[nodiscard]] const RenderArguments& arguments() const { return arguments_; }
  /// To change what is drawn, but not what is read.
  [[nodiscard]] RenderArguments& change_scene();
  /// Another field, by its own range.
  void set_field(const std::string& field);
  /// A preset or a file; what was edited can be had back by undoing.
  void set_transfer_function(const std::string& name);
  /// Its changes are drawn after `apply_edit`.
  [[nodiscard]] TransferFunctionEditor& editor() { return editor_; }
  void apply_edit();
  void undo();
  void redo();
  /// In the place of what --lights named; none: a headlight.
  void set_lights(std::optional<project::Lights> lights);
  /// With the options that belong to it at their defaults.
  void set_mode(const std::string& mode);
  /// As --mode lists them, round and round.
  void next_mode();
  /// Counted from 0, of those of the file.
  void set_time_step(std::size_t step);
  /// Round and round.
  void next_time_step();
  [[nodiscard]] FigureArguments& change_figure() { return change_scene().figure; }
  void set_projector(const std::string& projector);

  /// What to draw next.
  [[nodiscard]] std::optional<DrawRequest> next_request();
  /// What came of it.
  void accept(std::unique_ptr<Drawn> drawn);
  /// Whether what is being drawn is wanted no longer, and something else is.
  [[nodiscard]] bool outdated() const;
  /// Another file or time step that is being read is left, for the one before it.
  void give_up();
  /// How long until there may be something to draw though nothing changes.
  [[nodiscard]] std::optional<double> wait_ms() const { return pacing_.wait_ms(now_ms_); }
  [[nodiscard]] bool complete() const { return pacing_.complete() && error_.empty(); }

  /// Null before the first one.
  [[nodiscard]] const Drawn* picture() const { return picture_.get(); }
  /// Why the last picture could not be drawn; empty where it could.
  [[nodiscard]] const std::string& error() const { return error_; }
  /// Why what was to be read was not, until something changes; empty otherwise.
  [[nodiscard]] const std::string& refusal() const { return refusal_; }
  /// Pictures a second while the view or the scene last moved; nothing before it did for a while.
  [[nodiscard]] std::optional<double> moving_rate() const;
  [[nodiscard]] const SceneFacts* facts() const { return facts_.get(); }

  /// Checks so many random pixels of the picture in full.
  void verify(int pixels);
  [[nodiscard]] const std::optional<project::Verification>& verified() const { return verified_; }

  /// The words after "tetraglass" that draw this picture to a file.
  [[nodiscard]] std::vector<std::string> command(const std::string& output) const;

  /// Writes the picture, complete, to a new .png in the working folder, and what its command line
  /// refers to beside it. Returns the files. Throws WriteError.
  [[nodiscard]] std::vector<std::string> save_picture() const;

  /// The command line of this picture, and the files that it refers to, which are written to the
  /// working folder. Throws WriteError.
  [[nodiscard]] CopiedCommand copy_command() const;

  /// Writes what `view` opens again (session.h) to the working folder. Returns the files. Throws
  /// WriteError.
  [[nodiscard]] std::vector<std::string> save_session() const;

 private:
  /// What is gone back to where something else cannot be read.
  struct Before {
    bool other_file = false;
    std::uint64_t mesh_version = 0;
    RenderArguments arguments;
    std::vector<TypedOption> typed;
    TransferFunctionEditor editor;
    std::optional<project::Camera> camera;
    std::optional<Framing> framing;
  };

  void view_changed();
  void mesh_changes(bool other_file);
  void go_back(const std::string& reason);
  void follow_transfer_function();
  void note_rate();
  [[nodiscard]] std::vector<std::string> save_beside(const std::string& output) const;
  void set_framing(const Framing& framing);

  RenderArguments arguments_;
  std::vector<TypedOption> typed_;
  std::optional<project::Camera> camera_;
  std::optional<Framing> framing_;
  std::uint64_t framing_version_ = 1;
  std::uint64_t mesh_version_ = 1;
  std::uint64_t last_mesh_version_ = 1;
  std::uint64_t drawing_mesh_version_ = 1;
  bool verifying_ = false;
  std::uint64_t scene_version_ = 1;
  int width_ = 0;
  int height_ = 0;
  double now_ms_ = 0;
  std::vector<double> moving_ms_;  // when pictures came while it moved
  Pacing pacing_;
  TransferFunctionEditor editor_;
  int verify_ = 0;
  std::unique_ptr<Drawn> picture_;
  std::shared_ptr<const SceneFacts> facts_;
  std::optional<project::Verification> verified_;
  std::string error_;
  std::string refusal_;
  std::optional<Before> before_;  // what was read last, while something else is being read
};

}  // namespace tetraglass::apps::view
