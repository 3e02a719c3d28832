#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "project/gl/context.h"

/// OpenGL's objects: made by their constructors, deleted by their destructors, moved but not
/// copied. Each refers to its context, which outlives it.
namespace tetraglass::project::gl {

/// The name of an object and what deletes it.
class Name {
 public:
  using Delete = void (*)(const Context&, unsigned);

  Name(const Context& context, unsigned name, Delete del)
      : context_(&context), name_(name), delete_(del) {}
  ~Name() { reset(); }
  Name(Name&& other) noexcept
      : context_(other.context_), name_(std::exchange(other.name_, 0)), delete_(other.delete_) {}
  Name& operator=(Name&& other) noexcept {
    if (this == &other) return *this;
    reset();
    context_ = other.context_;
    name_ = std::exchange(other.name_, 0);
    delete_ = other.delete_;
    return *this;
  }
  Name(const Name&) = delete;
  Name& operator=(const Name&) = delete;

  [[nodiscard]] unsigned get() const { return name_; }
  [[nodiscard]] const Context& context() const { return *context_; }

 private:
  void reset() {
    if (name_ != 0) delete_(*context_, std::exchange(name_, 0));
  }

  const Context* context_;
  unsigned name_;
  Delete delete_;
};

/// How a texel is stored: components and type.
enum class Texel { r32f, rgba32f, r32ui, rgba32ui };

/// The bytes of a texel.
[[nodiscard]] std::size_t texel_bytes(Texel texel);

/// A block of memory of the context.
class Buffer {
 public:
  explicit Buffer(const Context& context);

  /// Replaces the content. Throws UnavailableError where there is no memory for it.
  void upload(std::span<const std::byte> bytes);

  [[nodiscard]] unsigned get() const { return name_.get(); }

 private:
  Name name_;
};

/// A buffer that shaders read texel by texel (samplerBuffer).
class TextureBuffer {
 public:
  TextureBuffer(const Context& context, Texel texel);

  /// Replaces the content: whole texels. `what` names it in errors ("cells"). Throws
  /// UnavailableError where it has more texels than the context can hold.
  template <class T>
  void upload(const std::vector<T>& values, const char* what) {
    upload(std::as_bytes(std::span(values)), what);
  }

  void bind(int unit) const;

 private:
  void upload(std::span<const std::byte> bytes, const char* what);

  Texel texel_;
  Buffer buffer_;
  Name texture_;
};

/// A texture of RGBA32F samples.
class Table {
 public:
  /// `size`: width, height and depth in texels; depth 0 makes a 2D texture. `rgba` has 4 floats a
  /// texel. `linear` interpolates between texel centres, otherwise the nearest one counts; the
  /// edges extend outwards. Throws UnavailableError where it is larger than the context can hold.
  Table(const Context& context, std::array<int, 3> size, std::span<const float> rgba, bool linear);

  void bind(int unit) const;

 private:
  Name texture_;
};

/// What the frame is drawn into: a color texture and, if asked for, 32 bits of float depth.
class Target {
 public:
  /// Throws UnavailableError where the context cannot draw into it.
  Target(const Context& context, Texel color, bool depth, int width, int height);

  /// Makes all colors `value` (every component) and all depths 1, and draws into the lower left
  /// width x height from now on.
  void begin(float value, int width, int height) const;

  /// Reads the lower left width x height, rows from the bottom, `stride` pixels from one row to the
  /// next. 1 float a pixel for r32f, else 4.
  void read(int width, int height, float* pixels, int stride) const;

 private:
  Texel texel_;
  Name color_texture_;
  std::optional<Name> depth_texture_;
  Name framebuffer_;
};

/// Counts the fragments that are drawn between `begin` and `end`.
class FragmentCounter {
 public:
  explicit FragmentCounter(const Context& context);

  void begin() const;
  void end() const;

  /// Of the last begin and end; waits for the drawing.
  [[nodiscard]] std::uint64_t count() const;

 private:
  Name query_;
};

/// The four faces of a run of cells as triangles: vertex 4 k + i is corner i of the k-th cell.
class CellFaces {
 public:
  explicit CellFaces(const Context& context);

  /// Draws cells 0 to count - 1 with the current program.
  void draw(std::size_t count) const;

 private:
  Buffer indices_;
  Name vertex_array_;
};

}  // namespace tetraglass::project::gl
