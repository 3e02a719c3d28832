#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

struct GLFWwindow;

namespace tetraglass::apps::view {

/// GLFW itself, while it lives.
class WindowSystem {
 public:
  /// Throws UnavailableError where there is no display.
  WindowSystem();
  ~WindowSystem();
  WindowSystem(const WindowSystem&) = delete;
  WindowSystem& operator=(const WindowSystem&) = delete;
};

/// A key that was pressed, by GLFW's numbers.
struct KeyPress {
  int key = 0;
  bool control = false;
};

/// A window with an OpenGL 3.3 core context, current on this thread, and what happened to it.
class GlWindow {
 public:
  /// Throws UnavailableError where there is no OpenGL for it.
  GlWindow(const std::string& title, int width, int height);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  [[nodiscard]] GLFWwindow* handle() const { return window_; }
  void set_title(const std::string& title);

  /// Pixels; 0 while minimized.
  [[nodiscard]] Eigen::Vector2i framebuffer() const;
  /// Pixels for each unit of the window's coordinates.
  [[nodiscard]] double pixel_ratio() const;

  /// The name of the renderer, as OpenGL has it.
  [[nodiscard]] std::string renderer() const;

  /// Clears all pixels to a grey.
  void clear(float grey) const;
  /// All pixels, RGBA, row 0 at the top.
  [[nodiscard]] std::vector<std::uint8_t> read_pixels() const;
  void swap() const;

  /// What happened since the last call.
  [[nodiscard]] std::vector<KeyPress> take_keys();
  [[nodiscard]] std::vector<std::string> take_dropped_files();

 private:
  struct Functions;
  GLFWwindow* window_ = nullptr;
  std::unique_ptr<Functions> gl_;
  std::vector<KeyPress> keys_;
  std::vector<std::string> dropped_;
};

/// A picture of 8-bit RGBA on the context that is current.
class PictureTexture {
 public:
  PictureTexture();
  ~PictureTexture();
  PictureTexture(const PictureTexture&) = delete;
  PictureTexture& operator=(const PictureTexture&) = delete;

  /// `smooth`: between pixels, where it is drawn larger.
  void upload(const std::vector<std::uint8_t>& pixels, int width, int height, bool smooth);
  [[nodiscard]] unsigned name() const { return name_; }

 private:
  unsigned name_ = 0;
};

}  // namespace tetraglass::apps::view
