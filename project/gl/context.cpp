#include "project/gl/context.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/errors.h"
#include "project/gl/functions.inl"

namespace tetraglass::project::gl {
namespace {

thread_local const Context* current_context = nullptr;

template <class F>
void load(const Platform& platform, const char* name, F& function) {
  function = reinterpret_cast<F>(platform.load(name));
  if (function == nullptr) throw base::UnavailableError(fmt::format("this OpenGL lacks {}", name));
}

int integer(const Functions& gl, GLenum what) {
  GLint values[2] = {0, 0};  // the dimensions of a viewport are two
  gl.GetIntegerv(what, values);
  return values[0];
}

std::string text_of_error(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enumerant";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "incomplete framebuffer";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return fmt::format("error {:#x}", error);
  }
}

// Called from within OpenGL's functions, so it must not throw: the next `check` does.
void APIENTRY remember_message(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* text,
                               const void* message) {
  auto& first = *static_cast<std::string*>(const_cast<void*>(message));
  if (type == GL_DEBUG_TYPE_ERROR && first.empty()) first = text;
}

}  // namespace

bool wants_debug_output() {
#ifdef NDEBUG
  return std::getenv("TETRAGLASS_GL_DEBUG") != nullptr;
#else
  return true;
#endif
}

std::unique_ptr<Context> Context::create(ContextKind kind) {
  switch (kind) {
    case ContextKind::osmesa:
      return std::unique_ptr<Context>(new Context(make_osmesa_platform()));
    case ContextKind::egl:
      return std::unique_ptr<Context>(new Context(make_egl_platform()));
    case ContextKind::none:
      break;
  }
  throw base::UnavailableError(
      "the gl projector needs an OpenGL context; use --context osmesa or egl");
}

std::unique_ptr<Context> Context::create(std::unique_ptr<Platform> platform) {
  return std::unique_ptr<Context>(new Context(std::move(platform)));
}

Context::Context(std::unique_ptr<Platform> platform)
    : platform_(std::move(platform)), functions_(std::make_unique<Functions>()) {
  make_current();
#define TETRAGLASS_GL_LOAD(name) load(*platform_, "gl" #name, functions_->name);
  TETRAGLASS_GL_FUNCTIONS(TETRAGLASS_GL_LOAD)
#undef TETRAGLASS_GL_LOAD
  const auto* renderer = reinterpret_cast<const char*>(functions_->GetString(GL_RENDERER));
  description_ =
      fmt::format("{}: {}", platform_->name(), renderer != nullptr ? renderer : "unknown");
  read_limits();
  listen_to_errors();
}

Context::~Context() {
  if (current_context == this) {
    platform_->release();
    current_context = nullptr;
  }
}

void Context::release() const {
  if (current_context != this) return;
  platform_->release();
  current_context = nullptr;
}

void Context::make_current() const {
  if (current_context == this) return;
  if (current_context != nullptr) current_context->platform_->release();
  current_context = nullptr;
  platform_->make_current();
  current_context = this;
}

const Functions& Context::gl() const {
  make_current();
  return *functions_;
}

void Context::read_limits() {
  const Functions& gl = *functions_;
  limits_.texture_buffer_texels = static_cast<std::size_t>(integer(gl, GL_MAX_TEXTURE_BUFFER_SIZE));
  GLint viewport[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  limits_.table_2d = integer(gl, GL_MAX_TEXTURE_SIZE);
  limits_.table_3d = integer(gl, GL_MAX_3D_TEXTURE_SIZE);
  limits_.tile = std::min({viewport[0], viewport[1], limits_.table_2d});
  limits_.subpixel_bits = integer(gl, GL_SUBPIXEL_BITS);
  // llvmpipe leaves all loops of a shader, without a word, after 65535 iterations together
  // (LP_MAX_TGSI_LOOP_ITERATIONS). Sorting n fragments takes 1.5 n of the outer loops, each with
  // log2(n) + 1 of the inner one at most, and n to blend them: 62976 for this n.
  const bool llvmpipe = description_.find("llvmpipe") != std::string::npos;
  limits_.sorted_fragments = llvmpipe ? 3072 : std::numeric_limits<std::uint32_t>::max();
}

bool Context::has_extension(const std::string& name) const {
  const GLint count = integer(gl(), GL_NUM_EXTENSIONS);
  for (GLint i = 0; i < count; ++i) {
    const auto* extension = gl().GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
    if (name == reinterpret_cast<const char*>(extension)) return true;
  }
  return false;
}

void Context::listen_to_errors() {
  if (!wants_debug_output()) return;
  functions_->Enable(GL_DEBUG_OUTPUT);
  functions_->Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  functions_->DebugMessageCallback(&remember_message, &message_);
}

void Context::check(const std::string& doing) const {
  const GLenum error = gl().GetError();
  const std::string message = std::exchange(message_, {});
  if (error == GL_OUT_OF_MEMORY) {
    throw base::UnavailableError(fmt::format("{}: OpenGL is out of memory", doing));
  }
  if (error != GL_NO_ERROR || !message.empty()) {
    throw base::Error(fmt::format("{}: OpenGL says: {}", doing,
                                  message.empty() ? text_of_error(error) : message));
  }
}

}  // namespace tetraglass::project::gl
