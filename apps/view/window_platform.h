#pragma once

#include <memory>
#include <string>

#include "project/gl/platform.h"

struct GLFWwindow;

namespace tetraglass::apps::view {

/// An OpenGL 4.5 context of the display for the gl projector: that of a window which is never
/// shown. Lives on the thread of WindowSystem; its platforms on any one thread.
class HiddenWindow {
 public:
  HiddenWindow();
  ~HiddenWindow();
  HiddenWindow(const HiddenWindow&) = delete;
  HiddenWindow& operator=(const HiddenWindow&) = delete;

  /// Whether the display has such a context.
  [[nodiscard]] bool available() const { return window_ != nullptr; }

  /// Of this window, which outlives it.
  [[nodiscard]] std::unique_ptr<project::gl::Platform> platform() const;

 private:
  GLFWwindow* window_ = nullptr;
};

/// Whether a renderer, by the name that OpenGL has for it, draws on a GPU.
[[nodiscard]] bool is_hardware(const std::string& renderer);

}  // namespace tetraglass::apps::view
