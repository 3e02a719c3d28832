#include <vector>

#include <GL/osmesa.h>

#include "base/errors.h"
#include "project/gl/platform.h"
#include "project/plan.h"

namespace tetraglass::project::gl {
namespace {

// The context needs a picture of its own to be current; nothing is drawn into it.
constexpr int kOwnSize = 4;

class OsmesaPlatform final : public Platform {
 public:
  OsmesaPlatform() : picture_(4 * static_cast<std::size_t>(kOwnSize * kOwnSize)) {
    // 4.5 is the most that OSMesa gives; a request for 4.6 fails.
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              0,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              4,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              5,
                              0};
    context_ = OSMesaCreateContextAttribs(attributes, nullptr);
    if (context_ == nullptr) {
      throw base::UnavailableError(
          "this OSMesa gives no OpenGL 4.5 core context (Mesa 20 or later is needed)");
    }
  }
  ~OsmesaPlatform() override { OSMesaDestroyContext(context_); }

  [[nodiscard]] std::string name() const override { return to_string(ContextKind::osmesa); }

  void make_current() override {
    if (OSMesaMakeCurrent(context_, picture_.data(), GL_UNSIGNED_BYTE, kOwnSize, kOwnSize) !=
        GL_TRUE) {
      throw base::UnavailableError("OSMesa cannot make its context current");
    }
  }

  void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  [[nodiscard]] Function load(const std::string& name) const override {
    return OSMesaGetProcAddress(name.c_str());
  }

 private:
  std::vector<unsigned char> picture_;
  OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Platform> make_osmesa_platform() {
  return std::make_unique<OsmesaPlatform>();
}

}  // namespace tetraglass::project::gl
