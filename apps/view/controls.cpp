#include "apps/view/controls.h"

#include <algorithm>
#include <array>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace tetraglass::apps::view {
namespace {

constexpr std::array kControls = {
    Control{Action::orbit, "left drag", "orbit"},
    Control{Action::pan, "right drag, Shift+drag", "pan"},
    Control{Action::zoom, "wheel, two fingers", "zoom to the mouse"},
    Control{Action::edit_transfer_function, "in the colors' plot",
            "drag a point; double click adds one, right click removes it"},
    Control{Action::undo, "Ctrl+Z", "undo a change of the colors", GLFW_KEY_Z, true},
    Control{Action::redo, "Ctrl+Y", "... and do it again", GLFW_KEY_Y, true},
    Control{Action::next_mode, "M", "next mode: full, emission, ... thickness", GLFW_KEY_M},
    Control{Action::frame, "F", "see all of the mesh", GLFW_KEY_F},
    Control{Action::from_front, "1", "look from the front (-y)", GLFW_KEY_1},
    Control{Action::from_back, "2", "look from the back (+y)", GLFW_KEY_2},
    Control{Action::from_right, "3", "look from the right (+x)", GLFW_KEY_3},
    Control{Action::from_left, "4", "look from the left (-x)", GLFW_KEY_4},
    Control{Action::from_top, "5", "look from the top (+z)", GLFW_KEY_5},
    Control{Action::from_below, "6", "look from below (-z)", GLFW_KEY_6},
    Control{Action::toggle_parallel, "P", "perspective or parallel view", GLFW_KEY_P},
    Control{Action::save_picture, "S", "save the picture, as render draws it", GLFW_KEY_S},
    Control{Action::copy_command, "C", "copy the command line of this picture", GLFW_KEY_C},
    Control{Action::save_session, "Ctrl+S", "save the session; 'view' opens it again", GLFW_KEY_S,
            true},
    Control{Action::play, "Space", "play the time steps, or stop", GLFW_KEY_SPACE},
    Control{Action::verify, "V", "check random pixels against the reference", GLFW_KEY_V},
    Control{Action::save_window, "F12", "save a picture of the window", GLFW_KEY_F12},
    Control{Action::toggle_panel, "Tab", "hide or show the panel", GLFW_KEY_TAB},
    Control{Action::help, "H, F1", "this list", GLFW_KEY_H},
    Control{Action::help, "", "", GLFW_KEY_F1},
    Control{Action::give_up, "Esc", "stop reading another file, keep this one", GLFW_KEY_ESCAPE},
    Control{Action::quit, "Q", "close the window", GLFW_KEY_Q},
};

}  // namespace

std::span<const Control> controls() {
  return kControls;
}

std::string controls_text() {
  std::size_t width = 0;
  for (const Control& control : kControls) width = std::max(width, control.input.size());
  std::string text;
  for (const Control& control : kControls) {
    if (control.input.empty()) continue;
    text += fmt::format("  {:<{}}  {}\n", control.input, width, control.effect);
  }
  return text;
}

}  // namespace tetraglass::apps::view
