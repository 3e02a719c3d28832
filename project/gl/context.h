#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "project/gl/platform.h"
#include "project/plan.h"

namespace tetraglass::project::gl {

struct Functions;

/// What this OpenGL can hold.
struct Limits {
  std::size_t texture_buffer_texels = 0;
  int tile = 0;           ///< largest width and height of a target, in pixels
  int table_2d = 0;       ///< largest width and height of a 2D texture, in texels
  int table_3d = 0;       ///< ... and of a 3D texture
  int subpixel_bits = 0;  ///< the rasterizer rounds vertices to 2^-subpixel_bits pixels
  /// The most fragments of one pixel that a shader can sort (fragment_lists.h).
  std::size_t sorted_fragments = 0;
};

/// An OpenGL 4.5 core context, current on the thread that made it, with its functions loaded.
/// Everything of project/gl refers to one, is used on its thread and dies before it.
class Context {
 public:
  /// Throws UnavailableError, with the reason, where no such context can be had.
  [[nodiscard]] static std::unique_ptr<Context> create(ContextKind kind);

  /// On a platform of the caller's, a window's say. Throws UnavailableError where its OpenGL lacks
  /// a function.
  [[nodiscard]] static std::unique_ptr<Context> create(std::unique_ptr<Platform> platform);

  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Free of cost where it is current already.
  void make_current() const;

  /// Not current any more: before others than this class make a context current on the thread.
  void release() const;

  /// The table of functions; the context is made current first.
  [[nodiscard]] const Functions& gl() const;

  [[nodiscard]] const Limits& limits() const { return limits_; }

  /// Whether it has an extension ("GL_EXT_texture_compression_s3tc").
  [[nodiscard]] bool has_extension(const std::string& name) const;

  /// "osmesa: llvmpipe (LLVM 15.0.6, 256 bits)"
  [[nodiscard]] const std::string& description() const { return description_; }

  /// Throws UnavailableError where OpenGL ran out of memory and Error for any other of its errors
  /// since the last call, both beginning with `doing` ("drawing cells"), in OpenGL's own words
  /// where debug output is wanted (platform.h).
  void check(const std::string& doing) const;

 private:
  explicit Context(std::unique_ptr<Platform> platform);
  void read_limits();
  void listen_to_errors();

  std::unique_ptr<Platform> platform_;
  std::unique_ptr<Functions> functions_;
  Limits limits_;
  std::string description_;
  mutable std::string message_;  ///< the first error that OpenGL reported by itself
};

}  // namespace tetraglass::project::gl
