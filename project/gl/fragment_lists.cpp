#include "project/gl/fragment_lists.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/errors.h"
#include "project/gl/functions.inl"

namespace tetraglass::project::gl {
namespace {

// Bindings of fragment_lists.glsl.
constexpr GLuint kCountsImage = 0;
constexpr GLuint kFirstsImage = 1;
constexpr GLuint kDepths = 0;
constexpr GLuint kLights = 1;

}  // namespace

std::vector<Patch> patches(std::span<const std::uint32_t> counts, int width, std::size_t most,
                           std::size_t longest) {
  const std::size_t largest = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  if (largest > std::min(most, longest)) {
    throw base::UnavailableError(
        fmt::format("a pixel meets {} cells, more than the fragment lists hold and sort here ({}); "
                    "use --projector cpu or reference",
                    largest, std::min(most, longest)));
  }
  std::vector<Patch> result;
  const auto columns = static_cast<std::size_t>(width);
  const int height = static_cast<int>(counts.size() / columns);
  Patch rows{0, 0, width, 0, 0};
  const auto flush = [&](int next) {
    if (rows.fragments > 0) result.push_back(rows);
    rows = {0, next, width, 0, 0};
  };
  for (int y = 0; y < height; ++y) {
    const std::span<const std::uint32_t> row =
        counts.subspan(static_cast<std::size_t>(y) * columns, columns);
    std::size_t sum = 0;
    for (const std::uint32_t count : row) sum += count;
    if (rows.fragments + sum > most) flush(y);
    if (sum <= most) {
      ++rows.height;
      rows.fragments += sum;
      continue;
    }
    Patch part{0, y, 0, 1, 0};
    for (int x = 0; x < width; ++x) {
      const std::size_t count = row[static_cast<std::size_t>(x)];
      if (part.fragments + count > most) {
        result.push_back(part);
        part = {x, y, 0, 1, 0};
      }
      ++part.width;
      part.fragments += count;
    }
    result.push_back(part);
    flush(y + 1);
  }
  flush(height);
  return result;
}

FragmentLists::FragmentLists(const Context& context, int width, int height, std::size_t most)
    : width_(width),
      height_(height),
      most_(most),
      counts_(make_image(context, GL_R32UI, width, height)),
      firsts_(make_image(context, GL_R32UI, width, height)),
      depths_(context),
      lights_(context),
      resolve_(context, shader_source("whole_target.vert.glsl", {}),
               shader_source("resolve_fragments.frag.glsl", {})),
      triangle_(context) {
  depths_.reserve(most * sizeof(float));
  lights_.reserve(most * 4 * sizeof(float));
  context.check("making the fragment lists");
}

std::size_t FragmentLists::bytes() const {
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  return 2 * pixels * sizeof(std::uint32_t) + depths_.bytes() + lights_.bytes();
}

void FragmentLists::bind() const {
  const Functions& gl = counts_.context().gl();
  gl.BindImageTexture(kCountsImage, counts_.get(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  gl.BindImageTexture(kFirstsImage, firsts_.get(), 0, GL_FALSE, 0, GL_READ_ONLY, GL_R32UI);
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kDepths, depths_.get());
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kLights, lights_.get());
}

void FragmentLists::clear_counts() const {
  const GLuint zero = 0;
  counts_.context().gl().ClearTexImage(counts_.get(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
}

void FragmentLists::begin_counting() const {
  const Functions& gl = counts_.context().gl();
  clear_counts();
  bind();
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

std::vector<std::uint32_t> FragmentLists::counts(int width, int height) const {
  const Functions& gl = counts_.context().gl();
  gl.MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  std::vector<std::uint32_t> result(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
  gl.PixelStorei(GL_PACK_ROW_LENGTH, 0);
  gl.GetTextureSubImage(counts_.get(), 0, 0, 0, 0, width, height, 1, GL_RED_INTEGER,
                        GL_UNSIGNED_INT, static_cast<GLsizei>(result.size() * 4), result.data());
  counts_.context().check("counting fragments");
  return result;
}

void FragmentLists::begin_patch(const Patch& patch, std::span<const std::uint32_t> counts,
                                int width) const {
  const Functions& gl = counts_.context().gl();
  std::vector<std::uint32_t> firsts;
  std::uint32_t sum = 0;
  for (int y = patch.y; y < patch.y + patch.height; ++y) {
    for (int x = patch.x; x < patch.x + patch.width; ++x) {
      firsts.push_back(sum);
      sum += counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(x)];
    }
  }
  gl.TextureSubImage2D(firsts_.get(), 0, patch.x, patch.y, patch.width, patch.height,
                       GL_RED_INTEGER, GL_UNSIGNED_INT, firsts.data());
  clear_counts();
  bind();
  gl.Enable(GL_SCISSOR_TEST);
  gl.Scissor(patch.x, patch.y, patch.width, patch.height);
  gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void FragmentLists::resolve(const Patch& patch) const {
  const Functions& gl = counts_.context().gl();
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  bind();
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_CULL_FACE);
  gl.Scissor(patch.x, patch.y, patch.width, patch.height);
  resolve_.use();
  triangle_.draw(3);
  gl.Disable(GL_SCISSOR_TEST);
}

}  // namespace tetraglass::project::gl
