#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
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

/// A two-dimensional texture of one level, without content. `format`: OpenGL's sized format.
[[nodiscard]] Name make_image(const Context& context, unsigned format, int width, int height);

/// How a texel is stored: components and type.
enum class Texel { r8, r16, r16f, r32f, rgba8, rgba16f, rgba32f, r32ui, rgba32ui };

/// The bytes of a texel.
[[nodiscard]] std::size_t texel_bytes(Texel texel);

/// A block of memory of the context.
class Buffer {
 public:
  explicit Buffer(const Context& context);

  /// Replaces the content. Throws UnavailableError where there is no memory for it.
  void upload(std::span<const std::byte> bytes);

  /// Replaces the content by one that is not set. Throws as `upload`.
  void reserve(std::size_t bytes);

  [[nodiscard]] unsigned get() const { return name_.get(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  Name name_;
  std::size_t bytes_ = 0;
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

  [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

 private:
  void upload(std::span<const std::byte> bytes, const char* what);

  Texel texel_;
  Buffer buffer_;
  Name texture_;
};

/// A texture of samples between which the shaders interpolate, or the nearest of which they take.
class Table {
 public:
  /// `size`: width, height and depth in texels; depth 0 makes a 2D texture. `values` has one float
  /// per component of a texel. `linear` interpolates between texel centres, otherwise the nearest
  /// one counts; the edges extend outwards. Throws UnavailableError where it is larger than the
  /// context can hold.
  Table(const Context& context, Texel texel, std::array<int, 3> size, std::span<const float> values,
        bool linear);

  void bind(int unit) const;

 private:
  Name texture_;
};

/// Samples by direction, between which the shaders interpolate; across the edges of the cube, too.
class CubeMap {
 public:
  /// `rgba`: six faces of `size` x `size` texels of four floats, in the order of OpenGL. Throws
  /// UnavailableError where it is larger than the context can hold.
  CubeMap(const Context& context, int size, std::span<const float> rgba);

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

  /// Sets the depths of the lower left width x height, row by row. The target has depth.
  void set_depths(std::span<const float> depths, int width, int height) const;

  /// Reads the lower left width x height, rows from the bottom, `stride` pixels from one row to the
  /// next. One float per component.
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

/// The four faces of cells, from vertices that only have numbers: as triangles (vertex 4 k + i is
/// corner i of the k-th cell) or as strips of 6 vertices.
class CellFaces {
 public:
  CellFaces(const Context& context, bool strips);

  /// Draws cells 0 to count - 1 with the current program.
  void draw(std::size_t count) const;

 private:
  bool strips_;
  Buffer indices_;
  Name vertex_array_;
};

/// Plain vertex arrays: attribute i of every vertex lies in an array of its own.
class VertexArrays {
 public:
  explicit VertexArrays(const Context& context);

  /// Attribute `location` of each vertex: N floats or 16-bit integers, which shaders read as
  /// floats. Returns the bytes of the array. Throws UnavailableError where there is no memory for
  /// it.
  template <class Number, std::size_t N>
  std::size_t add(unsigned location, const std::vector<std::array<Number, N>>& values) {
    static_assert(std::is_same_v<Number, float> || std::is_same_v<Number, std::int16_t>);
    return add(location, std::as_bytes(std::span(values)), N, std::is_same_v<Number, float>);
  }

  /// Draws the first `vertices` as triangles.
  void draw(std::size_t vertices) const;

  /// Draws runs of `size` vertices as triangles, each from its first.
  void draw_runs(const std::vector<int>& firsts, int size) const;

 private:
  std::size_t add(unsigned location, std::span<const std::byte> bytes, std::size_t components,
                  bool floats);

  Name vertex_array_;
  std::vector<Buffer> buffers_;
};

}  // namespace tetraglass::project::gl
