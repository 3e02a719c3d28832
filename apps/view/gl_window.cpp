#include "apps/view/gl_window.h"

#include <algorithm>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "apps/view/display_loss.h"
#include "base/errors.h"

namespace tetraglass::apps::view {
namespace {

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "unknown reason";
}

template <class F>
F load(const char* name) {
  auto* function = reinterpret_cast<F>(glfwGetProcAddress(name));
  if (function == nullptr) {
    throw base::UnavailableError(fmt::format("this OpenGL lacks {}", name));
  }
  return function;
}

/// Textures of OpenGL, loaded for the context that is current.
struct TextureFunctions {
  decltype(&glGenTextures) gen = load<decltype(&glGenTextures)>("glGenTextures");
  decltype(&glDeleteTextures) drop = load<decltype(&glDeleteTextures)>("glDeleteTextures");
  decltype(&glBindTexture) bind = load<decltype(&glBindTexture)>("glBindTexture");
  decltype(&glTexParameteri) parameter = load<decltype(&glTexParameteri)>("glTexParameteri");
  decltype(&glPixelStorei) store = load<decltype(&glPixelStorei)>("glPixelStorei");
  decltype(&glTexImage2D) image = load<decltype(&glTexImage2D)>("glTexImage2D");
};

const TextureFunctions& textures() {
  static const TextureFunctions kFunctions;
  return kFunctions;
}

}  // namespace

WindowSystem::WindowSystem() {
  if (glfwInit() != GLFW_TRUE) {
    throw base::UnavailableError(fmt::format(
        "no window can be opened here: {}; view needs a display, 'tetraglass render' does not",
        last_error()));
  }
  end_with_the_display();
}

WindowSystem::~WindowSystem() {
  glfwTerminate();
}

struct GlWindow::Functions {
  decltype(&glViewport) viewport = load<decltype(&glViewport)>("glViewport");
  decltype(&glClearColor) clear_color = load<decltype(&glClearColor)>("glClearColor");
  decltype(&glClear) clear = load<decltype(&glClear)>("glClear");
  decltype(&glReadPixels) read_pixels = load<decltype(&glReadPixels)>("glReadPixels");
  decltype(&glReadBuffer) read_buffer = load<decltype(&glReadBuffer)>("glReadBuffer");
  decltype(&glPixelStorei) store = load<decltype(&glPixelStorei)>("glPixelStorei");
  decltype(&glGetString) get_string = load<decltype(&glGetString)>("glGetString");
};

GlWindow::GlWindow(const std::string& title, int width, int height) {
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    throw base::UnavailableError(fmt::format(
        "the display has no OpenGL 3.3 for a window ({}): install Mesa (libgl1-mesa-dri) or newer "
        "graphics drivers, or use 'tetraglass render', which needs neither",
        last_error()));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  gl_ = std::make_unique<Functions>();
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
    if (action == GLFW_RELEASE) return;
    static_cast<GlWindow*>(glfwGetWindowUserPointer(window))
        ->keys_.push_back({key, (mods & GLFW_MOD_CONTROL) != 0});
  });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
    auto& dropped = static_cast<GlWindow*>(glfwGetWindowUserPointer(window))->dropped_;
    dropped.insert(dropped.end(), files, files + count);
  });
}

GlWindow::~GlWindow() {
  glfwDestroyWindow(window_);
}

void GlWindow::set_title(const std::string& title) {
  glfwSetWindowTitle(window_, title.c_str());
}

Eigen::Vector2i GlWindow::framebuffer() const {
  Eigen::Vector2i size;
  glfwGetFramebufferSize(window_, &size.x(), &size.y());
  return size;
}

double GlWindow::pixel_ratio() const {
  int width = 0;
  glfwGetWindowSize(window_, &width, nullptr);
  return width > 0 ? static_cast<double>(framebuffer().x()) / width : 1;
}

std::string GlWindow::renderer() const {
  const auto* text = reinterpret_cast<const char*>(gl_->get_string(GL_RENDERER));
  return text != nullptr ? text : "unknown";
}

void GlWindow::clear(float grey) const {
  const Eigen::Vector2i size = framebuffer();
  gl_->viewport(0, 0, size.x(), size.y());
  gl_->clear_color(grey, grey, grey, 1);
  gl_->clear(GL_COLOR_BUFFER_BIT);
}

std::vector<std::uint8_t> GlWindow::read_pixels() const {
  const Eigen::Vector2i size = framebuffer();
  const std::size_t row = 4 * static_cast<std::size_t>(size.x());
  const auto rows = static_cast<std::size_t>(size.y());
  std::vector<std::uint8_t> pixels(row * rows);
  gl_->read_buffer(GL_BACK);
  gl_->store(GL_PACK_ALIGNMENT, 1);
  gl_->read_pixels(0, 0, size.x(), size.y(), GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  for (std::size_t y = 0; y < rows / 2; ++y) {
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row));
  }
  return pixels;
}

void GlWindow::swap() const {
  glfwSwapBuffers(window_);
}

std::vector<KeyPress> GlWindow::take_keys() {
  return std::exchange(keys_, {});
}

std::vector<std::string> GlWindow::take_dropped_files() {
  return std::exchange(dropped_, {});
}

PictureTexture::PictureTexture() {
  textures().gen(1, &name_);
}

PictureTexture::~PictureTexture() {
  textures().drop(1, &name_);
}

void PictureTexture::upload(const std::vector<std::uint8_t>& pixels, int width, int height,
                            bool smooth) {
  const TextureFunctions& gl = textures();
  gl.bind(GL_TEXTURE_2D, name_);
  const GLint filter = smooth ? GL_LINEAR : GL_NEAREST;
  gl.parameter(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.parameter(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.parameter(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.store(GL_UNPACK_ALIGNMENT, 1);
  gl.image(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
}

}  // namespace tetraglass::apps::view
