#include "apps/view/viewer.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "apps/options.h"
#include "apps/picture_files.h"
#include "apps/transfer_function_input.h"
#include "apps/view/saved_files.h"
#include "apps/view/session.h"
#include "preint/transfer_function_edit.h"
#include "preint/transfer_function_file.h"
#include "project/light/lights_file.h"

namespace tetraglass::apps::view {
namespace {

/// picture.png: picture.tf.json
std::string transfer_function_file(const std::string& picture) {
  return std::filesystem::path(picture).replace_extension(".tf.json").string();
}

/// picture.png: picture.lights.json
std::string lights_file(const std::string& picture) {
  return std::filesystem::path(picture).replace_extension(".lights.json").string();
}

/// A name for a picture of this file that neither it nor what lies beside it has.
std::string free_picture_name(const std::string& input) {
  return free_name(std::filesystem::path(input).stem().string(),
                   {".png", ".tf.json", ".lights.json", ".session.json"});
}

}  // namespace

std::span<const std::string_view> mode_names() {
  static constexpr std::array<std::string_view, 6> kModes = {"full", "emission", "absorption",
                                                             "mip",  "iso",      "thickness"};
  return kModes;
}

Viewer::Viewer(RenderArguments arguments, std::vector<TypedOption> typed)
    : arguments_(std::move(arguments)), typed_(std::move(typed)) {}

void Viewer::view_changed() {
  verified_.reset();
  verify_ = 0;
  refusal_.clear();
  pacing_.changed(now_ms_);
}

void Viewer::mesh_changes(bool other_file) {
  if (!before_) {
    before_ = Before{other_file, mesh_version_, arguments_, typed_, editor_, camera_, framing_};
  }
  before_->other_file = before_->other_file || other_file;
  mesh_version_ = ++last_mesh_version_;
}

void Viewer::go_back(const std::string& reason) {
  Before before = std::move(*before_);
  before_.reset();
  if (before.other_file) {
    arguments_ = std::move(before.arguments);
    typed_ = std::move(before.typed);
    editor_ = std::move(before.editor);
    camera_ = before.camera;
    framing_ = before.framing;
    ++framing_version_;
  } else {
    // What was edited meanwhile stays.
    arguments_.import.time = before.arguments.import.time;
    arguments_.projector = before.arguments.projector;
  }
  mesh_version_ = before.mesh_version;
  ++scene_version_;
  view_changed();
  refusal_ = reason;
}

void Viewer::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  arguments_.size = fmt::format("{}x{}", width, height);
  view_changed();
}

void Viewer::orbit(const Eigen::Vector2d& drag) {
  if (!camera_ || framing_ || drag.isZero(0)) return;
  camera_ = orbited(*camera_, drag);
  view_changed();
}

void Viewer::pan(const Eigen::Vector2d& drag) {
  if (!camera_ || framing_ || drag.isZero(0)) return;
  camera_ = panned(*camera_, drag);
  view_changed();
}

void Viewer::zoom(double factor, const Eigen::Vector2d& place) {
  if (!camera_ || framing_ || factor == 1) return;
  camera_ = zoomed(*camera_, factor, place);
  view_changed();
}

void Viewer::set_parallel(bool parallel) {
  if (!camera_ || framing_ || camera_->parallel == parallel) return;
  camera_ = with_parallel(*camera_, parallel);
  view_changed();
}

void Viewer::frame() {
  if (!camera_) return;
  set_framing(
      {camera_->eye - camera_->target, camera_->up, camera_->fov_degrees, camera_->parallel});
}

void Viewer::look_from(const Eigen::Vector3d& direction) {
  if (!camera_) return;
  const bool along_z = direction.head<2>().isZero(0);
  set_framing({direction, along_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ(),
               camera_->fov_degrees, camera_->parallel});
}

void Viewer::set_framing(const Framing& framing) {
  framing_ = framing;
  ++framing_version_;
  view_changed();
}

void Viewer::open(const std::string& file) {
  mesh_changes(true);
  RenderArguments fresh;
  fresh.input = file;
  fresh.size = arguments_.size;
  fresh.background = arguments_.background;
  arguments_ = std::move(fresh);
  typed_.clear();
  editor_.forget();
  camera_.reset();
  framing_.reset();
  ++framing_version_;
  ++scene_version_;
  view_changed();
}

RenderArguments& Viewer::change_scene() {
  ++scene_version_;
  view_changed();
  return arguments_;
}

void Viewer::set_field(const std::string& field) {
  RenderArguments& arguments = change_scene();
  arguments.field = field;
  // They were of the other field's values.
  arguments.range.clear();
  arguments.isovalues.clear();
  arguments.iso_colors.clear();
  if (arguments.own_transfer_function) arguments.transfer_function = editor_.source();
  arguments.own_transfer_function.reset();
  editor_.forget();
}

void Viewer::set_transfer_function(const std::string& name) {
  RenderArguments& arguments = change_scene();
  arguments.transfer_function = name;
  arguments.own_transfer_function.reset();
}

void Viewer::apply_edit() {
  RenderArguments& arguments = change_scene();
  arguments.transfer_function = editor_.source();
  arguments.own_transfer_function.reset();
  if (editor_.edited()) arguments.own_transfer_function = editor_.function();
}

void Viewer::undo() {
  if (!editor_.can_undo()) return;
  editor_.undo();
  apply_edit();
}

void Viewer::redo() {
  if (!editor_.can_redo()) return;
  editor_.redo();
  apply_edit();
}

void Viewer::set_lights(std::optional<project::Lights> lights) {
  RenderArguments& arguments = change_scene();
  arguments.lights.clear();
  arguments.own_lights = std::move(lights);
}

void Viewer::set_mode(const std::string& mode) {
  RenderArguments& arguments = change_scene();
  arguments.mode = mode;
  arguments.shading.clear();  // what a mode does not know is refused
  if (mode == "iso") return;
  arguments.isovalues.clear();
  arguments.iso_colors.clear();
  arguments.iso_opacity.clear();
}

void Viewer::next_mode() {
  const std::span<const std::string_view> modes = mode_names();
  const auto found = std::ranges::find(modes, arguments_.mode);
  set_mode(
      std::string(found == modes.end() || found + 1 == modes.end() ? modes.front() : *(found + 1)));
}

void Viewer::follow_transfer_function() {
  if (arguments_.own_transfer_function) return;
  const std::string& scale = arguments_.opacity_scale;
  const double factor = scale.empty() ? 1 : parse_number(scale, "--opacity-scale");
  // The editor shows what is scaled.
  editor_.follow(factor > 0 ? preint::scale_extinction(facts_->transfer_function, 1 / factor)
                            : facts_->transfer_function,
                 arguments_.transfer_function);
}

void Viewer::set_time_step(std::size_t step) {
  mesh_changes(false);
  arguments_.import.time = fmt::format("index:{}", step);
  ++scene_version_;
  view_changed();
}

void Viewer::next_time_step() {
  if (facts_ == nullptr || !facts_->time_step) return;
  set_time_step((facts_->time_step->step + 1) % facts_->time_step->count);
}

void Viewer::set_projector(const std::string& projector) {
  RenderArguments changed = arguments_;
  changed.projector = projector;
  if (draws_grid(changed) != draws_grid(arguments_)) mesh_changes(false);  // read differently
  change_scene().projector = projector;
}

std::optional<DrawRequest> Viewer::next_request() {
  if (width_ <= 0 || height_ <= 0) return std::nullopt;
  const std::optional<int> coarseness = pacing_.next(now_ms_);
  if (!coarseness) return std::nullopt;
  pacing_.started(*coarseness);
  DrawRequest request;
  request.arguments = arguments_;
  request.mesh_version = mesh_version_;
  request.scene_version = scene_version_;
  request.framing = framing_;
  request.framing_version = framing_version_;
  if (!framing_) request.camera = camera_;
  request.width = width_;
  request.height = height_;
  request.coarseness = *coarseness;
  request.verify = verify_;
  drawing_mesh_version_ = mesh_version_;
  verifying_ = verify_ > 0 && *coarseness == 1;
  return request;
}

bool Viewer::outdated() const {
  if (!pacing_.drawing()) return false;
  // Steps of time that are skimmed through are read to their end: some are seen.
  const bool other_file =
      drawing_mesh_version_ != mesh_version_ && (!before_ || before_->other_file);
  return pacing_.outdated() || other_file || (verifying_ && verify_ == 0);
}

void Viewer::give_up() {
  if (before_) go_back("given up: " + arguments_.input);
}

void Viewer::accept(std::unique_ptr<Drawn> drawn) {
  if (drawn->interrupted) return pacing_.interrupted();
  const bool wanted = drawn->mesh_version == mesh_version_;  // not of a file that was left
  error_ = drawn->error;
  if (!error_.empty()) {
    pacing_.failed();
    if (wanted && before_) go_back(std::exchange(error_, {}));
    return;
  }
  pacing_.finished(drawn->draw_ms);
  note_rate();
  if (!wanted) return;
  before_.reset();
  const bool framed = framing_ && drawn->framing_version == framing_version_;
  if (!camera_ || framed) {
    camera_ = drawn->camera;
    framing_.reset();
    // The camera is in the arguments by its numbers from now on.
    static_cast<CameraArguments&>(arguments_) = {};
  }
  const bool new_facts = facts_ != drawn->facts;
  facts_ = drawn->facts;
  if (new_facts && drawn->scene_version == scene_version_) {
    follow_transfer_function();
    // Those that were chosen for want of others are said from now on.
    if (arguments_.isovalues.empty()) {
      for (const preint::Isosurface& surface : facts_->isosurfaces) {
        arguments_.isovalues.push_back(fmt::format("{}", surface.value));
      }
    }
  }
  if (drawn->verified) {
    verified_ = drawn->verified;
    verify_ = 0;
  }
  picture_ = std::move(drawn);
}

void Viewer::note_rate() {
  constexpr double kPause = 500;  // ms without a picture: another movement
  constexpr std::size_t kMost = 30;
  if (pacing_.complete()) return;
  if (!moving_ms_.empty() && now_ms_ - moving_ms_.back() > kPause) moving_ms_.clear();
  moving_ms_.push_back(now_ms_);
  if (moving_ms_.size() > kMost) moving_ms_.erase(moving_ms_.begin());
}

std::optional<double> Viewer::moving_rate() const {
  if (moving_ms_.size() < 5 || moving_ms_.back() <= moving_ms_.front()) return std::nullopt;
  return 1000 * static_cast<double>(moving_ms_.size() - 1) /
         (moving_ms_.back() - moving_ms_.front());
}

void Viewer::verify(int pixels) {
  view_changed();
  verify_ = pixels;
}

std::vector<std::string> Viewer::command(const std::string& output) const {
  RenderArguments arguments = arguments_;
  if (camera_) static_cast<CameraArguments&>(arguments) = camera_arguments(*camera_);
  if (arguments.own_transfer_function) {
    // A file means what it says.
    arguments.transfer_function = transfer_function_file(output);
    arguments.range.clear();
    arguments.opacity.clear();
    arguments.logarithmic = false;
  }
  if (arguments.own_lights) arguments.lights = lights_file(output);
  return render_words(arguments, typed_, output);
}

std::vector<std::string> Viewer::save_picture() const {
  RenderArguments arguments = arguments_;
  const std::string name = free_picture_name(arguments.input);
  arguments.outputs = {name + ".png"};
  write_pictures(arguments, arguments.outputs, facts_->mode, picture_->image);
  std::vector<std::string> files = arguments.outputs;
  const std::vector<std::string> beside = save_beside(name + ".png");
  files.insert(files.end(), beside.begin(), beside.end());
  return files;
}

std::vector<std::string> Viewer::save_beside(const std::string& output) const {
  std::vector<std::string> files;
  if (arguments_.own_transfer_function) {
    files.push_back(transfer_function_file(output));
    preint::write_transfer_function(*arguments_.own_transfer_function, files.back());
  }
  if (arguments_.own_lights) {
    files.push_back(lights_file(output));
    project::write_lights(*arguments_.own_lights, files.back());
  }
  return files;
}

std::vector<std::string> Viewer::save_session() const {
  const std::string picture = free_picture_name(arguments_.input) + ".png";
  std::vector<std::string> files = save_beside(picture);
  files.insert(files.begin(),
               std::filesystem::path(picture).replace_extension(".session.json").string());
  // It is opened again from any folder.
  const auto anywhere = [](std::string& file) {
    file = std::filesystem::absolute(file).lexically_normal().string();
  };
  Session session{command(picture), *camera_};
  for (std::size_t i = 1; i < session.words.size(); ++i) {
    const std::string& option = session.words[i - 1];
    const bool is_file =
        i == 1 || option == "--lights" || (option == "--tf" && !is_preset_name(session.words[i]));
    if (is_file) anywhere(session.words[i]);
  }
  write_session(session, files.front());
  return files;
}

CopiedCommand Viewer::copy_command() const {
  const std::string output = free_picture_name(arguments_.input) + ".png";
  return {shell_line(command(output)), save_beside(output)};
}

}  // namespace tetraglass::apps::view
