#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "project/gl/objects.h"
#include "project/gl/program.h"

namespace tetraglass::project::gl {

/// A rectangle of pixels of the target, in whole rows or parts of one row.
struct Patch {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  std::size_t fragments = 0;
};

/// Cuts a picture of `width` columns into patches with at most `most` fragments each, which cover
/// every pixel that has one exactly once. `counts`: the fragments of each pixel, row by row. Throws
/// UnavailableError where one pixel alone has more, or more than `longest`.
[[nodiscard]] std::vector<Patch> patches(std::span<const std::uint32_t> counts, int width,
                                         std::size_t most, std::size_t longest);

/// The order `fragments`: every pixel's segments are gathered in a list, sorted by their depth and
/// blended there: exact for any mesh, cycles and overlaps included. No fragment is ever lost: they
/// are counted first, and a picture with more of them than the lists hold is drawn in patches.
///
/// Per frame: `begin_counting`, draw, `counts`; for each of the patches `begin_patch`, draw,
/// `resolve`.
class FragmentLists {
 public:
  /// Fragments that are held at once: 20 bytes each, 84 MB, which OSMesa's 128 MB buffers hold.
  static constexpr std::size_t kMost = std::size_t{1} << 22;

  /// For targets of up to width x height pixels. Throws UnavailableError where there is no memory.
  FragmentLists(const Context& context, int width, int height, std::size_t most = kMost);

  /// The `#define`s of a program that counts, and of one that gathers.
  static constexpr const char* kCountSwitch = "COUNT_FRAGMENTS";
  static constexpr const char* kGatherSwitch = "GATHER_FRAGMENTS";

  /// What is drawn next is counted only. The target is bound.
  void begin_counting() const;

  /// The fragments of each pixel of the lower left width x height.
  [[nodiscard]] std::vector<std::uint32_t> counts(int width, int height) const;

  /// What is drawn next goes to the lists of the patch's pixels.
  void begin_patch(const Patch& patch, std::span<const std::uint32_t> counts, int width) const;

  /// Sorts and blends the lists of the patch into the target.
  void resolve(const Patch& patch) const;

  [[nodiscard]] std::size_t most() const { return most_; }
  [[nodiscard]] std::size_t bytes() const;

  /// Whether targets of this size fit.
  [[nodiscard]] bool hold(int width, int height) const {
    return width <= width_ && height <= height_;
  }

 private:
  void clear_counts() const;
  void bind() const;

  int width_;
  int height_;
  std::size_t most_;
  Name counts_;
  Name firsts_;
  Buffer depths_;
  Buffer lights_;
  Program resolve_;
  VertexArrays triangle_;
};

}  // namespace tetraglass::project::gl
