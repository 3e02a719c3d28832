#include "apps/view/window_platform.h"

#include <algorithm>
#include <array>
#include <string_view>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "base/errors.h"

namespace tetraglass::apps::view {
namespace {

class WindowPlatform : public project::gl::Platform {
 public:
  explicit WindowPlatform(GLFWwindow* window) : window_(window) {}

  [[nodiscard]] std::string name() const override { return "window"; }

  void make_current() override {
    glfwMakeContextCurrent(window_);
    if (glfwGetCurrentContext() != window_) {
      throw base::UnavailableError(
          "the display's OpenGL context is lost: open the window again, or use --projector cpu");
    }
  }

  void release() override { glfwMakeContextCurrent(nullptr); }

  [[nodiscard]] project::gl::Function load(const std::string& name) const override {
    return glfwGetProcAddress(name.c_str());
  }

 private:
  GLFWwindow* window_;
};

}  // namespace

HiddenWindow::HiddenWindow() {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  window_ = glfwCreateWindow(16, 16, "", nullptr, nullptr);
  glfwDefaultWindowHints();
}

HiddenWindow::~HiddenWindow() {
  if (window_ != nullptr) glfwDestroyWindow(window_);
}

std::unique_ptr<project::gl::Platform> HiddenWindow::platform() const {
  return std::make_unique<WindowPlatform>(window_);
}

bool is_hardware(const std::string& renderer) {
  constexpr std::array<std::string_view, 4> kSoftware = {"llvmpipe", "softpipe", "swrast",
                                                         "Software"};
  return std::ranges::none_of(
      kSoftware, [&](std::string_view name) { return renderer.find(name) != std::string::npos; });
}

}  // namespace tetraglass::apps::view
