#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tetraglass::apps::view {

/// What mouse and keys do in the window. One list for `view --help`, the window's own help and the
/// handling of keys.
enum class Action {
  orbit,
  pan,
  zoom,
  edit_transfer_function,
  undo,
  redo,
  next_mode,
  frame,
  toggle_parallel,
  from_right,
  from_left,
  from_back,
  from_front,
  from_top,
  from_below,
  save_picture,
  save_window,
  copy_command,
  save_session,
  play,
  verify,
  toggle_panel,
  help,
  give_up,
  quit
};

struct Control {
  Action action;
  std::string_view input;  ///< "left drag", "Ctrl+Z"
  std::string_view effect;
  int key = 0;  ///< of GLFW; 0 for the mouse
  bool control = false;
};

[[nodiscard]] std::span<const Control> controls();

/// A line for each.
[[nodiscard]] std::string controls_text();

}  // namespace tetraglass::apps::view
