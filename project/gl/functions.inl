// The OpenGL functions that project/gl calls, loaded from the context into one table. The one place that names
// OpenGL's header; included by .cpp files of project/gl, project/slices and their tests only.
#pragma once

#define GL_GLEXT_PROTOTYPES  // declares the functions for their types; none is linked
#include <GL/glcorearb.h>

#define TETRAGLASS_GL_FUNCTIONS(X) \
  X(AttachShader)               \
  X(BeginQuery)                 \
  X(BindBufferBase)             \
  X(BindFramebuffer)            \
  X(BindImageTexture)           \
  X(BindTextureUnit)            \
  X(BindVertexArray)            \
  X(BlendEquation)              \
  X(BlendFunc)                  \
  X(CheckNamedFramebufferStatus)\
  X(ClearNamedFramebufferfv)    \
  X(ClearTexImage)              \
  X(ColorMask)                  \
  X(CompileShader)              \
  X(CreateBuffers)              \
  X(CreateFramebuffers)         \
  X(CreateProgram)              \
  X(CreateQueries)              \
  X(CreateShader)               \
  X(CreateTextures)             \
  X(CreateVertexArrays)         \
  X(CullFace)                   \
  X(DebugMessageCallback)       \
  X(DeleteBuffers)              \
  X(DeleteFramebuffers)         \
  X(DeleteProgram)              \
  X(DeleteQueries)              \
  X(DeleteShader)               \
  X(DeleteTextures)             \
  X(DeleteVertexArrays)         \
  X(DepthFunc)                  \
  X(DepthMask)                  \
  X(Disable)                    \
  X(DrawArrays)                 \
  X(DrawElementsBaseVertex)     \
  X(Enable)                     \
  X(EnableVertexArrayAttrib)    \
  X(EndQuery)                   \
  X(Finish)                     \
  X(FrontFace)                  \
  X(GetError)                   \
  X(GetIntegerv)                \
  X(GetProgramInfoLog)          \
  X(GetProgramiv)               \
  X(GetQueryObjectui64v)        \
  X(GetShaderInfoLog)           \
  X(GetShaderiv)                \
  X(GetString)                  \
  X(GetStringi)                 \
  X(GetTextureSubImage)         \
  X(GetUniformLocation)         \
  X(LinkProgram)                \
  X(MemoryBarrier)              \
  X(MultiDrawArrays)            \
  X(NamedBufferData)            \
  X(NamedFramebufferTexture)    \
  X(PixelStorei)                \
  X(ProgramUniform1d)           \
  X(ProgramUniform1f)           \
  X(ProgramUniform1i)           \
  X(ProgramUniform2d)           \
  X(ProgramUniform2f)           \
  X(ProgramUniform3d)           \
  X(ProgramUniform3f)           \
  X(ProgramUniform4f)           \
  X(ProgramUniformMatrix3dv)    \
  X(ProgramUniformMatrix4fv)    \
  X(ReadPixels)                 \
  X(Scissor)                    \
  X(ShaderSource)               \
  X(TextureBuffer)              \
  X(TextureParameteri)          \
  X(TextureStorage2D)           \
  X(TextureStorage3D)           \
  X(TextureSubImage2D)          \
  X(TextureSubImage3D)          \
  X(UseProgram)                 \
  X(VertexArrayAttribBinding)   \
  X(VertexArrayAttribFormat)    \
  X(VertexArrayElementBuffer)   \
  X(VertexArrayVertexBuffer)    \
  X(Viewport)

namespace tetraglass::project::gl {

struct Functions {
#define TETRAGLASS_GL_MEMBER(name) decltype(&::gl##name) name = nullptr;
  TETRAGLASS_GL_FUNCTIONS(TETRAGLASS_GL_MEMBER)
#undef TETRAGLASS_GL_MEMBER
};

}  // namespace tetraglass::project::gl
