#include "project/gl/objects.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/errors.h"
#include "project/gl/functions.inl"

namespace tetraglass::project::gl {
namespace {

template <auto Member>
void delete_names(const Context& context, unsigned name) {
  (context.gl().*Member)(1, &name);
}

Name make_buffer(const Context& context) {
  GLuint name = 0;
  context.gl().CreateBuffers(1, &name);
  return {context, name, &delete_names<&Functions::DeleteBuffers>};
}

Name make_texture(const Context& context, GLenum target) {
  GLuint name = 0;
  context.gl().CreateTextures(target, 1, &name);
  return {context, name, &delete_names<&Functions::DeleteTextures>};
}

Name make_framebuffer(const Context& context) {
  GLuint name = 0;
  context.gl().CreateFramebuffers(1, &name);
  return {context, name, &delete_names<&Functions::DeleteFramebuffers>};
}

Name make_query(const Context& context) {
  GLuint name = 0;
  context.gl().CreateQueries(GL_SAMPLES_PASSED, 1, &name);
  return {context, name, &delete_names<&Functions::DeleteQueries>};
}

Name make_vertex_array(const Context& context) {
  GLuint name = 0;
  context.gl().CreateVertexArrays(1, &name);
  return {context, name, &delete_names<&Functions::DeleteVertexArrays>};
}

GLenum format_of(Texel texel) {
  switch (texel) {
    case Texel::r8:
      return GL_R8;
    case Texel::r16:
      return GL_R16;
    case Texel::r16f:
      return GL_R16F;
    case Texel::r32f:
      return GL_R32F;
    case Texel::rgba8:
      return GL_RGBA8;
    case Texel::rgba16f:
      return GL_RGBA16F;
    case Texel::rgba32f:
      return GL_RGBA32F;
    case Texel::r32ui:
      return GL_R32UI;
    case Texel::rgba32ui:
      return GL_RGBA32UI;
  }
  return 0;
}

bool has_one_component(Texel texel) {
  return texel == Texel::r8 || texel == Texel::r16 || texel == Texel::r16f ||
         texel == Texel::r32f || texel == Texel::r32ui;
}

}  // namespace

Name make_image(const Context& context, GLenum format, int width, int height) {
  Name texture = make_texture(context, GL_TEXTURE_2D);
  context.gl().TextureStorage2D(texture.get(), 1, format, width, height);
  return texture;
}

std::size_t texel_bytes(Texel texel) {
  switch (texel) {
    case Texel::r8:
      return 1;
    case Texel::r16:
    case Texel::r16f:
      return 2;
    case Texel::r32f:
    case Texel::rgba8:
    case Texel::r32ui:
      return 4;
    case Texel::rgba16f:
      return 8;
    case Texel::rgba32f:
    case Texel::rgba32ui:
      return 16;
  }
  return 0;
}

Buffer::Buffer(const Context& context) : name_(make_buffer(context)) {}

void Buffer::upload(std::span<const std::byte> bytes) {
  bytes_ = bytes.size();
  name_.context().gl().NamedBufferData(name_.get(), static_cast<GLsizeiptr>(bytes.size()),
                                       bytes.data(), GL_STATIC_DRAW);
  name_.context().check("filling a buffer");
}

void Buffer::reserve(std::size_t bytes) {
  bytes_ = bytes;
  name_.context().gl().NamedBufferData(name_.get(), static_cast<GLsizeiptr>(bytes), nullptr,
                                       GL_DYNAMIC_COPY);
  name_.context().check("making a buffer");
}

TextureBuffer::TextureBuffer(const Context& context, Texel texel)
    : texel_(texel), buffer_(context), texture_(make_texture(context, GL_TEXTURE_BUFFER)) {}

void TextureBuffer::upload(std::span<const std::byte> bytes, const char* what) {
  const Context& context = texture_.context();
  const std::size_t texels = bytes.size() / texel_bytes(texel_);
  if (texels > context.limits().texture_buffer_texels) {
    throw base::UnavailableError(
        fmt::format("{} {} are more than this OpenGL can hold ({}); use another --projector",
                    texels, what, context.limits().texture_buffer_texels));
  }
  buffer_.upload(bytes);
  context.gl().TextureBuffer(texture_.get(), format_of(texel_), buffer_.get());
  context.check(fmt::format("handing the {} to the shaders", what));
}

void TextureBuffer::bind(int unit) const {
  texture_.context().gl().BindTextureUnit(static_cast<GLuint>(unit), texture_.get());
}

Table::Table(const Context& context, Texel texel, std::array<int, 3> size,
             std::span<const float> values, bool linear)
    : texture_(make_texture(context, size[2] > 0 ? GL_TEXTURE_3D : GL_TEXTURE_2D)) {
  const Functions& gl = context.gl();
  const auto [width, height, depth] = size;
  const int most = depth > 0 ? context.limits().table_3d : context.limits().table_2d;
  if (std::max({width, height, depth}) > most) {
    throw base::UnavailableError(
        fmt::format("a table with an axis of {} samples is larger than this OpenGL can hold ({})",
                    std::max({width, height, depth}), most));
  }
  const GLuint name = texture_.get();
  const GLenum components = has_one_component(texel) ? GL_RED : GL_RGBA;
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (depth > 0) {
    gl.TextureStorage3D(name, 1, format_of(texel), width, height, depth);
    gl.TextureSubImage3D(name, 0, 0, 0, 0, width, height, depth, components, GL_FLOAT,
                         values.data());
  } else {
    gl.TextureStorage2D(name, 1, format_of(texel), width, height);
    gl.TextureSubImage2D(name, 0, 0, 0, width, height, components, GL_FLOAT, values.data());
  }
  const GLint filter = linear ? GL_LINEAR : GL_NEAREST;
  gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, filter);
  gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    gl.TextureParameteri(name, axis, GL_CLAMP_TO_EDGE);
  }
  context.check("handing a table to the shaders");
}

void Table::bind(int unit) const {
  texture_.context().gl().BindTextureUnit(static_cast<GLuint>(unit), texture_.get());
}

CubeMap::CubeMap(const Context& context, int size, std::span<const float> rgba)
    : texture_(make_texture(context, GL_TEXTURE_CUBE_MAP)) {
  if (size > context.limits().table_2d) {
    throw base::UnavailableError(
        fmt::format("a cube map of {} texels each way is larger than this OpenGL can hold ({})",
                    size, context.limits().table_2d));
  }
  const Functions& gl = context.gl();
  const GLuint name = texture_.get();
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TextureStorage2D(name, 1, GL_RGBA32F, size, size);
  gl.TextureSubImage3D(name, 0, 0, 0, 0, size, size, 6, GL_RGBA, GL_FLOAT, rgba.data());
  gl.TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  context.check("handing a cube map to the shaders");
}

void CubeMap::bind(int unit) const {
  texture_.context().gl().BindTextureUnit(static_cast<GLuint>(unit), texture_.get());
}

Target::Target(const Context& context, Texel color, bool depth, int width, int height)
    : texel_(color),
      color_texture_(make_image(context, format_of(color), width, height)),
      framebuffer_(make_framebuffer(context)) {
  const Functions& gl = context.gl();
  gl.NamedFramebufferTexture(framebuffer_.get(), GL_COLOR_ATTACHMENT0, color_texture_.get(), 0);
  if (depth) {
    depth_texture_ = make_image(context, GL_DEPTH_COMPONENT32F, width, height);
    gl.NamedFramebufferTexture(framebuffer_.get(), GL_DEPTH_ATTACHMENT, depth_texture_->get(), 0);
  }
  context.check(fmt::format("making a picture of {} x {} pixels", width, height));
  if (gl.CheckNamedFramebufferStatus(framebuffer_.get(), GL_FRAMEBUFFER) !=
      GL_FRAMEBUFFER_COMPLETE) {
    throw base::UnavailableError("this OpenGL cannot draw into pictures of this format");
  }
}

void Target::begin(float value, int width, int height) const {
  const Functions& gl = framebuffer_.context().gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.Viewport(0, 0, width, height);
  const GLfloat color[4] = {value, value, value, value};
  gl.ClearNamedFramebufferfv(framebuffer_.get(), GL_COLOR, 0, color);
  const GLfloat farthest = 1;
  if (!depth_texture_) return;
  gl.DepthMask(GL_TRUE);
  gl.ClearNamedFramebufferfv(framebuffer_.get(), GL_DEPTH, 0, &farthest);
}

void Target::set_depths(std::span<const float> depths, int width, int height) const {
  framebuffer_.context().gl().TextureSubImage2D(depth_texture_->get(), 0, 0, 0, width, height,
                                                GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
}

void Target::read(int width, int height, float* pixels, int stride) const {
  const Functions& gl = framebuffer_.context().gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
  gl.PixelStorei(GL_PACK_ROW_LENGTH, stride);
  gl.ReadPixels(0, 0, width, height, has_one_component(texel_) ? GL_RED : GL_RGBA, GL_FLOAT,
                pixels);
  framebuffer_.context().check("reading the picture back");
}

FragmentCounter::FragmentCounter(const Context& context) : query_(make_query(context)) {}

void FragmentCounter::begin() const {
  query_.context().gl().BeginQuery(GL_SAMPLES_PASSED, query_.get());
}

void FragmentCounter::end() const {
  query_.context().gl().EndQuery(GL_SAMPLES_PASSED);
}

std::uint64_t FragmentCounter::count() const {
  GLuint64 result = 0;
  query_.context().gl().GetQueryObjectui64v(query_.get(), GL_QUERY_RESULT, &result);
  return result;
}

namespace {

// As many cells as 16-bit indices reach, but for the one that ends a strip: the same indices serve
// every run, and stay in the cache.
constexpr std::size_t kRun = 10922;

constexpr std::uint16_t kStripEnd = 0xffff;

// Counter-clockwise from outside (mesh::kFaceVertices).
constexpr std::array<std::uint16_t, 12> kFaceIndices = {1, 2, 3, 0, 3, 2, 0, 1, 3, 0, 2, 1};

// The vertex stage makes them the corners 1, 0, 2, 3, 1, 0.
constexpr std::array<std::uint16_t, 6> kStripIndices = {0, 1, 2, 3, 4, 5};

std::vector<std::uint16_t> run_indices(bool strips) {
  std::vector<std::uint16_t> indices;
  for (std::size_t cell = 0; cell < kRun; ++cell) {
    if (strips) {
      for (const std::uint16_t index : kStripIndices) {
        indices.push_back(static_cast<std::uint16_t>(kStripIndices.size() * cell + index));
      }
      indices.push_back(kStripEnd);
    } else {
      for (const std::uint16_t index : kFaceIndices) {
        indices.push_back(static_cast<std::uint16_t>(4 * cell + index));
      }
    }
  }
  return indices;
}

}  // namespace

CellFaces::CellFaces(const Context& context, bool strips)
    : strips_(strips), indices_(context), vertex_array_(make_vertex_array(context)) {
  const std::vector<std::uint16_t> indices = run_indices(strips);
  indices_.upload(std::as_bytes(std::span(indices)));
  context.gl().VertexArrayElementBuffer(vertex_array_.get(), indices_.get());
}

void CellFaces::draw(std::size_t count) const {
  const Functions& gl = vertex_array_.context().gl();
  gl.BindVertexArray(vertex_array_.get());
  if (strips_) gl.Enable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
  const std::size_t vertices = strips_ ? kStripIndices.size() : 4;
  const std::size_t indices = strips_ ? kStripIndices.size() + 1 : kFaceIndices.size();
  for (std::size_t first = 0; first < count; first += kRun) {
    const std::size_t run = std::min(kRun, count - first);
    gl.DrawElementsBaseVertex(strips_ ? GL_TRIANGLE_STRIP : GL_TRIANGLES,
                              static_cast<GLsizei>(run * indices), GL_UNSIGNED_SHORT, nullptr,
                              static_cast<GLint>(vertices * first));
  }
  if (strips_) gl.Disable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
}

VertexArrays::VertexArrays(const Context& context) : vertex_array_(make_vertex_array(context)) {}

std::size_t VertexArrays::add(unsigned location, std::span<const std::byte> bytes,
                              std::size_t components, bool floats) {
  const Context& context = vertex_array_.context();
  const Functions& gl = context.gl();
  const GLuint array = vertex_array_.get();
  buffers_.emplace_back(context).upload(bytes);
  const std::size_t stride = components * (floats ? sizeof(float) : sizeof(std::int16_t));
  gl.VertexArrayVertexBuffer(array, location, buffers_.back().get(), 0,
                             static_cast<GLsizei>(stride));
  gl.VertexArrayAttribFormat(array, location, static_cast<GLint>(components),
                             floats ? GL_FLOAT : GL_SHORT, GL_FALSE, 0);
  gl.VertexArrayAttribBinding(array, location, location);
  gl.EnableVertexArrayAttrib(array, location);
  context.check("making a vertex array");
  return bytes.size();
}

void VertexArrays::draw(std::size_t vertices) const {
  const Functions& gl = vertex_array_.context().gl();
  gl.BindVertexArray(vertex_array_.get());
  gl.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices));
}

void VertexArrays::draw_runs(const std::vector<int>& firsts, int size) const {
  const Functions& gl = vertex_array_.context().gl();
  gl.BindVertexArray(vertex_array_.get());
  const std::vector<GLsizei> sizes(firsts.size(), size);
  gl.MultiDrawArrays(GL_TRIANGLES, firsts.data(), sizes.data(),
                     static_cast<GLsizei>(firsts.size()));
}

}  // namespace tetraglass::project::gl
