#include "apps/view/window.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include "apps/options.h"
#include "apps/view/controls.h"
#include "apps/view/gl_window.h"
#include "apps/view/panel.h"
#include "apps/view/saved_files.h"
#include "apps/view/style.h"
#include "apps/view/window_platform.h"
#include "base/errors.h"
#include "base/stopwatch.h"

namespace tetraglass::apps::view {
namespace {

constexpr int kPixelsVerified = 1000;
// ImGui settles what the mouse is over, and the size of its windows, a frame or two after an event.
constexpr int kFramesAfterEvent = 2;
// Work that lasts longer is shown, with its time.
constexpr double kSeenMs = 500;
constexpr double kEveryMs = 250;

/// ImGui on a window, while it lives.
class Interface {
 public:
  explicit Interface(GlWindow& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    set_style(window);
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 330");
  }
  ~Interface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  static void begin_frame() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
  }
  static void end_frame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
};

/// Where the picture is, in the window's coordinates.
struct Place {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();
  Eigen::Vector2d size = Eigen::Vector2d::Zero();

  [[nodiscard]] bool holds(const ImVec2& point) const {
    return point.x >= corner.x() && point.y >= corner.y() && point.x < corner.x() + size.x() &&
           point.y < corner.y() + size.y();
  }
};

class ViewerWindow {
 public:
  ViewerWindow(const RenderArguments& arguments, const std::vector<TypedOption>& typed);

  /// Until the window is closed.
  void run();

 private:
  Drawing::MakeContext context_maker();
  void wait_for_events();
  void take_picture();
  void start_drawing();
  void show_frame();
  void place_picture();
  void show_picture() const;
  void show_notice();
  void follow_mouse();
  void follow_keys();
  void follow_title();
  void perform(Action action);
  void copy_command();
  void save_session();
  void perform_when_complete();
  void save_window();
  void tell(const std::string& text) { notice_ = text; }

  WindowSystem system_;
  GlWindow window_;
  Interface interface_;
  PictureTexture texture_;
  Viewer viewer_;
  PanelState panel_;
  Place place_;
  base::Stopwatch clock_;
  int frames_left_ = kFramesAfterEvent;
  bool dragging_ = false;
  bool panning_ = false;
  bool save_due_ = false;
  bool window_picture_due_ = false;
  std::string notice_;
  std::string titled_;  // the file that the title names
  HiddenWindow hidden_;
  Drawing drawing_;  // dies first: it wakes the window
};

Eigen::Vector2i first_size(const RenderArguments& arguments) {
  const auto [width, height] = arguments.size == RenderArguments().size
                                   ? std::pair{960, 720}
                                   : parse_size(arguments.size, "--size");
  return {width, height};
}

std::string title_of(const std::string& file) {
  return std::filesystem::path(file).filename().string() + " - tetraglass";
}

ViewerWindow::ViewerWindow(const RenderArguments& arguments, const std::vector<TypedOption>& typed)
    : window_(title_of(arguments.input), first_size(arguments).x(), first_size(arguments).y()),
      interface_(window_),
      viewer_(arguments, typed),
      drawing_([] { glfwPostEmptyEvent(); }, context_maker(), is_hardware(window_.renderer())) {
  const Eigen::Vector2i size = first_size(arguments);
  const auto beside = static_cast<int>(kPanelWidth * font_size(window_) / window_.pixel_ratio());
  glfwSetWindowSize(window_.handle(), size.x() + beside, size.y());
}

/// Where the display has OpenGL for the gl projector.
Drawing::MakeContext ViewerWindow::context_maker() {
  glfwMakeContextCurrent(window_.handle());
  if (!hidden_.available()) return {};
  return [this] { return project::gl::Context::create(hidden_.platform()); };
}

void ViewerWindow::run() {
  while (glfwWindowShouldClose(window_.handle()) == GLFW_FALSE) {
    wait_for_events();
    viewer_.tick(clock_.milliseconds());
    take_picture();
    follow_keys();
    follow_title();
    if (window_.framebuffer().minCoeff() > 0) show_frame();
    if (viewer_.outdated()) drawing_.interrupt();
    start_drawing();
    perform_when_complete();
    if (panel_.playing && viewer_.complete()) viewer_.next_time_step();
  }
  glfwHideWindow(window_.handle());  // what is being read is waited for
}

void ViewerWindow::wait_for_events() {
  // Minimized: no frames until something happens.
  if (frames_left_ > 0 && window_.framebuffer().minCoeff() > 0) {
    glfwPollEvents();
    --frames_left_;
    return;
  }
  std::optional<double> wait = viewer_.wait_ms();
  if (const std::optional<Busy> busy = drawing_.busy()) {
    const double seen = std::max(kSeenMs - busy->ms, kEveryMs);
    wait = std::min(wait.value_or(seen), seen);
  }
  if (wait) {
    glfwWaitEventsTimeout(std::max(1.0, *wait) / 1000);
  } else {
    glfwWaitEvents();
  }
  frames_left_ = kFramesAfterEvent;
}

void ViewerWindow::take_picture() {
  std::unique_ptr<Drawn> drawn = drawing_.take();
  if (!drawn) return;
  const std::exception_ptr failure = drawn->failure;
  viewer_.accept(std::move(drawn));
  if (failure) panel_.playing = false;
  // Nothing to go back to.
  if (failure && viewer_.picture() == nullptr && viewer_.refusal().empty()) {
    std::rethrow_exception(failure);
  }
  frames_left_ = kFramesAfterEvent;
  if (failure || viewer_.picture() == nullptr) return;
  const Drawn& picture = *viewer_.picture();
  texture_.upload(picture.pixels, picture.width, picture.height, picture.coarseness > 1);
}

void ViewerWindow::start_drawing() {
  std::optional<DrawRequest> request = viewer_.next_request();
  if (request) drawing_.request(std::move(*request));
}

void ViewerWindow::place_picture() {
  const double ratio = window_.pixel_ratio();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const double left = panel_width(panel_);
  place_ = {{left, 0}, {std::max(0.0, size.x - left), size.y}};
  viewer_.resize(static_cast<int>(std::lround(place_.size.x() * ratio)),
                 static_cast<int>(std::lround(place_.size.y() * ratio)));
}

void ViewerWindow::show_picture() const {
  const Drawn* picture = viewer_.picture();
  if (picture == nullptr || place_.size.minCoeff() <= 0) return;
  const ImVec2 first(static_cast<float>(place_.corner.x()), static_cast<float>(place_.corner.y()));
  const ImVec2 last(static_cast<float>(place_.corner.x() + place_.size.x()),
                    static_cast<float>(place_.corner.y() + place_.size.y()));
  ImGui::GetBackgroundDrawList()->AddImage(
      reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture_.name())), first, last);
}

/// "reading heat.vtu ... 3 s"
std::string describe(const Busy& busy, const std::string& file) {
  std::string what = "drawing";
  if (busy.stage == Busy::Stage::read) {
    what = "reading " + std::filesystem::path(file).filename().string();
  } else if (busy.stage == Busy::Stage::set_up) {
    what = "setting up the scene";
  } else if (busy.stage == Busy::Stage::verify) {
    what = "verifying";
  }
  return fmt::format("{} ... {:.0f} s", what, busy.ms / 1000);
}

void ViewerWindow::show_notice() {
  std::string text = notice_;
  const Drawn* picture = viewer_.picture();
  if (picture != nullptr && picture->coarseness > 1) {
    text = fmt::format("1/{} of the resolution while moving", picture->coarseness);
  }
  const std::optional<Busy> busy = drawing_.busy();
  if (busy && busy->ms >= kSeenMs) text = describe(*busy, viewer_.arguments().input);
  if (!viewer_.refusal().empty()) text = viewer_.refusal();
  if (!viewer_.error().empty()) text = viewer_.error();
  const bool error = !viewer_.error().empty() || !viewer_.refusal().empty();
  if (text.empty()) return;
  const float em = ImGui::GetFontSize();
  const ImVec2 corner(static_cast<float>(place_.corner.x()) + em,
                      static_cast<float>(place_.corner.y() + place_.size.y()) - em);
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints(
      {0, 0}, {std::max(1.0F, static_cast<float>(place_.size.x()) - 2 * em), 10 * em});
  ImGui::SetNextWindowBgAlpha(0.75F);
  ImGui::Begin("notice", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(std::max(em, static_cast<float>(place_.size.x()) - 4 * em));
  if (error) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 150, 130, 255));
  ImGui::TextUnformatted(text.c_str());
  if (error) ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void ViewerWindow::show_frame() {
  Interface::begin_frame();
  place_picture();
  show_picture();
  for (const Action action : draw_panel(viewer_, panel_)) perform(action);
  draw_help(panel_);
  show_notice();
  follow_mouse();
  window_.clear(0.1F);
  Interface::end_frame();
  if (window_picture_due_ && frames_left_ == 0 && viewer_.complete()) save_window();
  window_.swap();
}

void ViewerWindow::follow_mouse() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool pressed =
      ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
  if (pressed && !io.WantCaptureMouse && place_.holds(io.MousePos)) {
    dragging_ = true;
    panning_ = io.KeyShift || !io.MouseDown[0];
    notice_.clear();
  }
  if (!io.MouseDown[0] && !io.MouseDown[1] && !io.MouseDown[2]) dragging_ = false;
  const double height = place_.size.y();
  if (height <= 0) return;
  if (dragging_) {
    const Eigen::Vector2d drag(io.MouseDelta.x / height, io.MouseDelta.y / height);
    panning_ ? viewer_.pan(drag) : viewer_.orbit(drag);
  }
  if (io.MouseWheel != 0 && !io.WantCaptureMouse && place_.holds(io.MousePos)) {
    constexpr double kZoomOfAStep = 1.15;
    const Eigen::Vector2d middle = place_.corner + 0.5 * place_.size;
    const Eigen::Vector2d mouse(io.MousePos.x, io.MousePos.y);
    viewer_.zoom(std::pow(kZoomOfAStep, io.MouseWheel), (mouse - middle) / height);
  }
}

void ViewerWindow::follow_keys() {
  for (const std::string& file : window_.take_dropped_files()) viewer_.open(file);
  const bool typing = ImGui::GetIO().WantTextInput;
  for (const KeyPress& press : window_.take_keys()) {
    if (typing) continue;
    for (const Control& control : controls()) {
      if (control.key == press.key && control.control == press.control) perform(control.action);
    }
  }
}

void ViewerWindow::follow_title() {
  if (titled_ == viewer_.arguments().input) return;
  titled_ = viewer_.arguments().input;
  window_.set_title(title_of(titled_));
}

void ViewerWindow::perform(Action action) {
  switch (action) {
    case Action::orbit:
    case Action::pan:
    case Action::zoom:
    case Action::edit_transfer_function:
      break;  // by the mouse
    case Action::undo:
      return viewer_.undo();
    case Action::redo:
      return viewer_.redo();
    case Action::next_mode:
      return viewer_.next_mode();
    case Action::frame:
      return viewer_.frame();
    case Action::toggle_parallel:
      if (viewer_.camera()) viewer_.set_parallel(!viewer_.camera()->parallel);
      break;
    case Action::from_right:
      return viewer_.look_from({1, 0, 0});
    case Action::from_left:
      return viewer_.look_from({-1, 0, 0});
    case Action::from_back:
      return viewer_.look_from({0, 1, 0});
    case Action::from_front:
      return viewer_.look_from({0, -1, 0});
    case Action::from_top:
      return viewer_.look_from({0, 0, 1});
    case Action::from_below:
      return viewer_.look_from({0, 0, -1});
    case Action::save_picture:
      save_due_ = true;
      break;
    case Action::save_window:
      window_picture_due_ = true;
      frames_left_ = kFramesAfterEvent;
      break;
    case Action::copy_command:
      return copy_command();
    case Action::save_session:
      return save_session();
    case Action::play:
      panel_.playing = !panel_.playing;
      break;
    case Action::verify:
      return viewer_.verify(kPixelsVerified);
    case Action::toggle_panel:
      panel_.shown = !panel_.shown;
      break;
    case Action::help:
      panel_.help = !panel_.help;
      break;
    case Action::give_up:
      return viewer_.give_up();
    case Action::quit:
      glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
      break;
  }
}

void ViewerWindow::save_session() {
  if (!viewer_.camera()) return;
  try {
    for (const std::string& file : viewer_.save_session()) {
      print_result(file);
      tell("saved " + file);
    }
  } catch (const base::Error& error) {
    tell(error.what());
  }
}

void ViewerWindow::copy_command() {
  if (!viewer_.camera()) return;
  try {
    const CopiedCommand copied = viewer_.copy_command();
    glfwSetClipboardString(window_.handle(), copied.line.c_str());
    for (const std::string& file : copied.files) print_result(file);
    print_result(copied.line);
    tell("copied: " + copied.line);
  } catch (const base::Error& error) {
    tell(error.what());
  }
}

void ViewerWindow::perform_when_complete() {
  if (!save_due_ || !viewer_.complete()) return;
  save_due_ = false;
  frames_left_ = kFramesAfterEvent;
  try {
    std::string saved;
    for (const std::string& file : viewer_.save_picture()) {
      print_result(file);
      saved += (saved.empty() ? "saved " : ", ") + file;
    }
    tell(saved);
  } catch (const base::Error& error) {
    tell(error.what());
  }
}

void ViewerWindow::save_window() {
  window_picture_due_ = false;
  try {
    const Eigen::Vector2i size = window_.framebuffer();
    const std::string file = free_name("window", {".png"}) + ".png";
    save_pixels(window_.read_pixels(), size.x(), size.y(), file);
    print_result(file);
  } catch (const base::Error& error) {
    tell(error.what());
  }
}

}  // namespace

void show_window(const RenderArguments& arguments, const std::vector<TypedOption>& typed) {
  ViewerWindow(arguments, typed).run();
}

}  // namespace tetraglass::apps::view
