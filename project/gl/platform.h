#pragma once

#include <memory>
#include <string>

namespace tetraglass::project::gl {

using Function = void (*)();

/// Where a context comes from: the part of it that is not OpenGL. Ready when constructed.
class Platform {
 public:
  Platform() = default;
  virtual ~Platform() = default;
  Platform(const Platform&) = delete;
  Platform& operator=(const Platform&) = delete;

  /// What users call it ("osmesa").
  [[nodiscard]] virtual std::string name() const = 0;

  /// Makes the context current on this thread. Throws UnavailableError.
  virtual void make_current() = 0;

  /// Leaves this thread without a context; another library's may then become current.
  virtual void release() = 0;

  /// The address of an OpenGL function ("glViewport"); null where there is none.
  [[nodiscard]] virtual Function load(const std::string& name) const = 0;
};

/// Whether contexts are asked for debug output (KHR_debug), so that errors tell what OpenGL has to
/// say of them: in debug builds, and where the environment has TETRAGLASS_GL_DEBUG, as in the
/// tests.
[[nodiscard]] bool wants_debug_output();

/// Mesa's off-screen renderer, 4.5 core. Throws UnavailableError.
[[nodiscard]] std::unique_ptr<Platform> make_osmesa_platform();

/// A GPU without a display, or Mesa's surfaceless platform, 4.5 core. Throws UnavailableError.
[[nodiscard]] std::unique_ptr<Platform> make_egl_platform();

}  // namespace tetraglass::project::gl
