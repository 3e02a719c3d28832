#include <algorithm>
#include <string_view>
#include <vector>

#define EGL_NO_X11  // no display server: only platforms without one are asked for
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include "base/errors.h"
#include "project/gl/platform.h"
#include "project/plan.h"

namespace tetraglass::project::gl {
namespace {

bool has_extension(const char* list, std::string_view name) {
  if (list == nullptr) return false;
  std::string_view rest(list);
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    if (rest.substr(0, space) == name) return true;
    if (space == std::string_view::npos) break;
    rest.remove_prefix(space + 1);
  }
  return false;
}

template <class F>
F load_egl(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}

std::string error_text() {
  return fmt::format("EGL error {:#x}", eglGetError());
}

// The devices of this machine, those that are hardware first.
std::vector<EGLDeviceEXT> devices() {
  const auto query = load_egl<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto describe = load_egl<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  EGLint count = 0;
  if (query == nullptr || describe == nullptr || query(0, nullptr, &count) != EGL_TRUE) return {};
  std::vector<EGLDeviceEXT> found(static_cast<std::size_t>(count));
  if (query(count, found.data(), &count) != EGL_TRUE) return {};
  found.resize(static_cast<std::size_t>(count));
  std::stable_partition(found.begin(), found.end(), [&](EGLDeviceEXT device) {
    return !has_extension(describe(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
  });
  return found;
}

// Displays without a screen, the most promising first; not yet initialized.
std::vector<EGLDisplay> displays() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get = load_egl<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::vector<EGLDisplay> found;
  if (get == nullptr) return found;
  const auto add = [&](EGLenum platform, void* what) {
    const EGLDisplay display = get(platform, what, nullptr);
    if (display != EGL_NO_DISPLAY) found.push_back(display);
  };
  if (has_extension(client, "EGL_EXT_platform_device")) {
    for (const EGLDeviceEXT device : devices()) add(EGL_PLATFORM_DEVICE_EXT, device);
  }
  if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
    add(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  }
  return found;
}

class EglPlatform final : public Platform {
 public:
  EglPlatform() {
    std::string why = "no device and no surfaceless platform";
    for (const EGLDisplay display : displays()) {
      if (open(display, why)) return;
    }
    throw base::UnavailableError("EGL gives no OpenGL 4.5 core context without a display (" + why +
                                 "); use --context osmesa, which needs no driver");
  }

  // The display stays: EGL shares it among all that ask for the same one.
  ~EglPlatform() override { eglDestroyContext(display_, context_); }

  [[nodiscard]] std::string name() const override { return to_string(ContextKind::egl); }

  void make_current() override {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      throw base::UnavailableError("EGL cannot make its context current: " + error_text());
    }
  }

  void release() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

  [[nodiscard]] Function load(const std::string& name) const override {
    return eglGetProcAddress(name.c_str());
  }

 private:
  bool open(EGLDisplay display, std::string& why) {
    if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
      why = error_text() + " when opening the device";
      return false;
    }
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_surfaceless_context") ||
        !has_extension(extensions, "EGL_KHR_no_config_context") ||
        eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
      why = "the driver draws OpenGL into windows only";
      return false;
    }
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 wants_debug_output() ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) {
      why = error_text() + ": the driver's OpenGL is older than 4.5";
      return false;
    }
    display_ = display;
    context_ = context;
    return true;
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Platform> make_egl_platform() {
  return std::make_unique<EglPlatform>();
}

}  // namespace tetraglass::project::gl
