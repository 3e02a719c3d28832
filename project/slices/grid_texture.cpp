#include "project/slices/grid_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "base/errors.h"
#include "project/gl/functions.inl"
#include "project/value_scale.h"

namespace tetraglass::project::slices {
namespace {

using Eigen::Vector3i;
using gl::Functions;

void delete_texture(const gl::Context& context, unsigned name) {
  context.gl().DeleteTextures(1, &name);
}

gl::Name make_texture(const gl::Context& context, GLenum target) {
  GLuint name = 0;
  context.gl().CreateTextures(target, 1, &name);
  return {context, name, &delete_texture};
}

/// How numbers from 0 to 1 are stored: times `most`, rounded, and that times `step`, as integers
/// that OpenGL takes for parts of `full`.
struct Rounding {
  double most;
  double step;
  double full;
};

Rounding rounding(TexelBits texels) {
  switch (texels) {
    case TexelBits::bits8:
      return {255, 1, 255};
    case TexelBits::bits12:  // in 16 bits: no OpenGL stores 12
      return {4095, 16, 65535};
    case TexelBits::bits16:
    case TexelBits::floats:
      break;
  }
  return {65535, 1, 65535};
}

/// Calls set(place in the texture, point of the grid) for all points of the block.
template <class Set>
void for_points(const Block& block, const mesh::RectilinearGrid& grid, std::optional<int> layers,
                Set set) {
  const Vector3i size = points_of(block);
  // In a texture the axis of the layers is the slowest, the others follow in their order.
  const int slow = layers.value_or(2);
  const int fast = slow == 0 ? 1 : 0;
  const int middle = slow == 2 ? 1 : 2;
  const std::array<std::size_t, 3> stride = {1, grid.size(0), grid.size(0) * grid.size(1)};
  tbb::parallel_for(0, size[slow], [&](int layer) {
    std::size_t place = static_cast<std::size_t>(layer) * static_cast<std::size_t>(size[middle]) *
                        static_cast<std::size_t>(size[fast]);
    Vector3i at;
    at[slow] = block.low[slow] + layer;
    for (at[middle] = block.low[middle]; at[middle] <= block.high[middle]; ++at[middle]) {
      for (at[fast] = block.low[fast]; at[fast] <= block.high[fast]; ++at[fast], ++place) {
        set(place, static_cast<std::size_t>(at.x()) + static_cast<std::size_t>(at.y()) * stride[1] +
                       static_cast<std::size_t>(at.z()) * stride[2]);
      }
    }
  });
}

/// The components of the texels, from 0 to 1 where they are to be rounded.
std::vector<float> texels(const Scene& scene, const SlicesPlan& plan, const Block& block,
                          std::optional<int> layers, double length) {
  const Vector3i size = points_of(block);
  const std::size_t points = static_cast<std::size_t>(size.x()) *
                             static_cast<std::size_t>(size.y()) *
                             static_cast<std::size_t>(size.z());
  const std::vector<double>& values = scene.field.values;
  if (plan.classify == Classify::pre) {
    std::vector<float> result(4 * points);
    for_points(block, *scene.grid, layers, [&](std::size_t place, std::size_t point) {
      const preint::Medium medium = scene.transfer_function.at(values[point]);
      const double alpha = -std::expm1(-medium.extinction * length);
      for (std::size_t c = 0; c < 3; ++c) {
        result[4 * place + c] =
            static_cast<float>(medium.color[static_cast<Eigen::Index>(c)] * alpha);
      }
      result[4 * place + 3] = static_cast<float>(alpha);
    });
    return result;
  }
  const ValueScale scale(scene.field);
  const bool floats = plan.texels == TexelBits::floats;
  std::vector<float> result(points);
  for_points(block, *scene.grid, layers, [&](std::size_t place, std::size_t point) {
    const float value = scale.scaled(values[point]);
    result[place] = floats ? value : 0.5F * value + 0.5F;
  });
  return result;
}

template <class Integer>
std::vector<Integer> rounded(const std::vector<float>& numbers, const Rounding& by) {
  std::vector<Integer> result(numbers.size());
  tbb::parallel_for(std::size_t{0}, numbers.size(), [&](std::size_t i) {
    const double part = std::clamp(static_cast<double>(numbers[i]), 0.0, 1.0);
    result[i] = static_cast<Integer>(std::lround(part * by.most) * std::lround(by.step));
  });
  return result;
}

struct Format {
  GLenum stored;
  GLenum components;
  GLenum type;
};

Format format_of(const SlicesPlan& plan) {
  const bool colors = plan.classify == Classify::pre;
  const GLenum components = colors ? GL_RGBA : GL_RED;
  // A single number is what S3TC makes of an opacity: RGTC stores that part alone.
  if (plan.compress) {
    return {
        static_cast<GLenum>(colors ? GL_COMPRESSED_RGBA_S3TC_DXT5_EXT : GL_COMPRESSED_RED_RGTC1),
        components, GL_UNSIGNED_BYTE};
  }
  switch (plan.texels) {
    case TexelBits::bits8:
      return {static_cast<GLenum>(colors ? GL_RGBA8 : GL_R8), components, GL_UNSIGNED_BYTE};
    case TexelBits::bits12:
    case TexelBits::bits16:
      return {static_cast<GLenum>(colors ? GL_RGBA16 : GL_R16), components, GL_UNSIGNED_SHORT};
    case TexelBits::floats:
      break;
  }
  return {static_cast<GLenum>(colors ? GL_RGBA32F : GL_R32F), components, GL_FLOAT};
}

void check_compression(const gl::Context& context, const SlicesPlan& plan) {
  if (plan.compress && plan.classify == Classify::pre &&
      !context.has_extension("GL_EXT_texture_compression_s3tc")) {
    throw base::UnavailableError("this OpenGL has no S3TC: leave out --compress");
  }
}

/// What a texture takes: compressed ones 4 bits a number, in blocks of 4 x 4.
std::size_t texture_bytes(const SlicesPlan& plan, const Vector3i& stored) {
  const auto product = [](int a, int b, int c) {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
  };
  if (!plan.compress) return bytes_per_point(plan) * product(stored.x(), stored.y(), stored.z());
  const std::size_t block = plan.classify == Classify::pre ? 16 : 8;
  return block * product((stored.x() + 3) / 4, (stored.y() + 3) / 4, stored.z());
}

void check_size(const gl::Context& context, const Vector3i& size, bool layers) {
  const int most = layers ? context.limits().table_2d : context.limits().table_3d;
  if (size.maxCoeff() > most) {
    throw base::UnavailableError(
        fmt::format("a grid of {} x {} x {} points does not fit into textures of this OpenGL, of "
                    "at most {} each way; draw its cells (--projector auto)",
                    size.x(), size.y(), size.z(), most));
  }
}

/// The size of a texture of so many points: in one of layers, their axis is the last.
Vector3i stored(const Vector3i& points, std::optional<int> layers) {
  const int slow = layers.value_or(2);
  return {points[slow == 0 ? 1 : 0], points[slow == 2 ? 1 : 2], points[slow]};
}

void upload(const Functions& gl, GLuint name, const Vector3i& size, const Format& format,
            const SlicesPlan& plan, const std::vector<float>& numbers) {
  const auto send = [&](const void* pixels) {
    gl.TextureSubImage3D(name, 0, 0, 0, 0, size.x(), size.y(), size.z(), format.components,
                         format.type, pixels);
  };
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (format.type == GL_FLOAT) {
    send(numbers.data());
  } else if (format.type == GL_UNSIGNED_BYTE) {
    send(rounded<std::uint8_t>(numbers, rounding(plan.texels)).data());
  } else {
    send(rounded<std::uint16_t>(numbers, rounding(plan.texels)).data());
  }
}

}  // namespace

GridTexture::GridTexture(const gl::Context& context, const Scene& scene, const SlicesPlan& plan,
                         const Vector3i& room, std::optional<int> layers)
    : scene_(scene),
      plan_(plan),
      room_(room),
      layers_(layers),
      texture_(make_texture(context, layers ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_3D)) {
  check_size(context, room, layers.has_value());
  check_compression(context, plan);
  const Functions& gl = context.gl();
  const GLuint name = texture_.get();
  const Format format = format_of(plan);
  const Vector3i texels = stored(room, layers);
  gl.TextureStorage3D(name, 1, format.stored, texels.x(), texels.y(), texels.z());
  // Beside a block that is smaller, what is multiplied by 0 must be numbers.
  if (!plan.compress) gl.ClearTexImage(name, 0, format.components, format.type, nullptr);
  const GLint filter = plan.filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
  gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    gl.TextureParameteri(name, axis, GL_CLAMP_TO_EDGE);
  }
  context.check("making a texture for the grid");
  bytes_ = texture_bytes(plan, texels);
  const Rounding by = rounding(plan.texels);
  const double part = plan.texels == TexelBits::floats ? 1 : by.full / (by.most * by.step);
  const bool shifted = plan.classify != Classify::pre && plan.texels != TexelBits::floats;
  value_ = {static_cast<float>(shifted ? 2 * part : part), shifted ? -1.0F : 0.0F};
}

void GridTexture::load(const Block& block, double length) {
  const gl::Context& context = texture_.context();
  const Vector3i size = points_of(block);
  upload(context.gl(), texture_.get(), stored(size, layers_), format_of(plan_), plan_,
         texels(scene_, plan_, block, layers_, length));
  context.check("handing the grid to the shaders");
  scale_ = room_.cast<float>().cwiseInverse();
  offset_ = (0.5F * Eigen::Vector3f::Ones() - block.low.cast<float>()).cwiseProduct(scale_);
  if (!layers_) return;
  // Layers are counted, not measured.
  scale_[*layers_] = 1;
  offset_[*layers_] = -static_cast<float>(block.low[*layers_]);
  last_layer_ = size[*layers_] - 1;
}

void GridTexture::bind(const gl::Program& program, int unit) const {
  texture_.context().gl().BindTextureUnit(static_cast<GLuint>(unit), texture_.get());
  program.set("grid", unit);
  program.set("texel_scale", scale_);
  program.set("texel_offset", offset_);
  program.set("last_layer", static_cast<float>(last_layer_));
  program.set("texel_value", value_);
}

Vector3i points_of(const Block& block) {
  return block.high - block.low + Vector3i::Ones();
}

std::size_t bytes_per_point(const SlicesPlan& plan) {
  const std::size_t components = plan.classify == Classify::pre ? 4 : 1;
  switch (plan.texels) {
    case TexelBits::bits8:
      return components;
    case TexelBits::bits12:
    case TexelBits::bits16:
      return 2 * components;
    case TexelBits::floats:
      break;
  }
  return 4 * components;
}

}  // namespace tetraglass::project::slices
