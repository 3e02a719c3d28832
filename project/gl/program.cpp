#include "project/gl/program.h"

#include <regex>
#include <sstream>

#include <fmt/format.h>

#include "base/errors.h"
#include "project/gl/functions.inl"

namespace tetraglass::project::gl {
namespace {

void append_file(const std::string& file, std::string& source) {
  static const std::regex kInclude(R"re(^#include "([^"]+)"$)re");
  const std::string_view text = shader_text(file);
  if (text.empty()) throw base::Error(fmt::format("there is no shader file '{}'", file));
  std::istringstream lines{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_match(line, match, kInclude)) {
      append_file(match[1], source);
      source += fmt::format("#line {} // {}\n", number + 1, file);
    } else {
      source += line + '\n';
    }
  }
}

void delete_shader(const Context& context, unsigned name) {
  context.gl().DeleteShader(name);
}
void delete_program(const Context& context, unsigned name) {
  context.gl().DeleteProgram(name);
}

// GetLog and GetParameter: of shaders or of programs.
template <class GetParameter, class GetLog>
void throw_on_failure(unsigned name, GLenum status, GetParameter get_parameter, GetLog get_log,
                      const std::string& doing) {
  GLint good = GL_FALSE;
  get_parameter(name, status, &good);
  if (good == GL_TRUE) return;
  GLint size = 0;
  get_parameter(name, GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(size), '\0');
  get_log(name, size, nullptr, log.data());
  throw base::Error(fmt::format("{} failed: {}", doing, log.c_str()));
}

Name compile(const Context& context, GLenum stage, const std::string& source) {
  const Functions& gl = context.gl();
  Name shader(context, gl.CreateShader(stage), &delete_shader);
  const GLchar* text = source.c_str();
  gl.ShaderSource(shader.get(), 1, &text, nullptr);
  gl.CompileShader(shader.get());
  throw_on_failure(
      shader.get(), GL_COMPILE_STATUS, gl.GetShaderiv, gl.GetShaderInfoLog,
      stage == GL_VERTEX_SHADER ? "compiling the vertex shader" : "compiling the fragment shader");
  return shader;
}

}  // namespace

std::string shader_source(const std::string& file, const std::vector<std::string>& switches) {
  std::string source = "#version 450 core\n";
  for (const std::string& name : switches) source += fmt::format("#define {}\n", name);
  source += "#line 1\n";
  append_file(file, source);
  return source;
}

Program::Program(const Context& context, const std::string& vertex_source,
                 const std::string& fragment_source)
    : program_(context, context.gl().CreateProgram(), &delete_program) {
  const Functions& gl = context.gl();
  const Name vertex = compile(context, GL_VERTEX_SHADER, vertex_source);
  const Name fragment = compile(context, GL_FRAGMENT_SHADER, fragment_source);
  gl.AttachShader(program_.get(), vertex.get());
  gl.AttachShader(program_.get(), fragment.get());
  gl.LinkProgram(program_.get());
  throw_on_failure(program_.get(), GL_LINK_STATUS, gl.GetProgramiv, gl.GetProgramInfoLog,
                   "linking the shaders");
}

void Program::use() const {
  program_.context().gl().UseProgram(program_.get());
}

int Program::location(const char* uniform) const {
  return program_.context().gl().GetUniformLocation(program_.get(), uniform);
}

void Program::set(const char* uniform, int value) const {
  program_.context().gl().ProgramUniform1i(program_.get(), location(uniform), value);
}

void Program::set(const char* uniform, float value) const {
  program_.context().gl().ProgramUniform1f(program_.get(), location(uniform), value);
}

void Program::set(const char* uniform, double value) const {
  program_.context().gl().ProgramUniform1d(program_.get(), location(uniform), value);
}

void Program::set(const char* uniform, const Eigen::Vector2f& value) const {
  program_.context().gl().ProgramUniform2f(program_.get(), location(uniform), value.x(), value.y());
}

void Program::set(const char* uniform, const Eigen::Vector3f& value) const {
  program_.context().gl().ProgramUniform3f(program_.get(), location(uniform), value.x(), value.y(),
                                           value.z());
}

void Program::set(const char* uniform, const Eigen::Vector4f& value) const {
  program_.context().gl().ProgramUniform4f(program_.get(), location(uniform), value.x(), value.y(),
                                           value.z(), value.w());
}

void Program::set(const char* uniform, const Eigen::Vector2d& value) const {
  program_.context().gl().ProgramUniform2d(program_.get(), location(uniform), value.x(), value.y());
}

void Program::set(const char* uniform, const Eigen::Vector3d& value) const {
  program_.context().gl().ProgramUniform3d(program_.get(), location(uniform), value.x(), value.y(),
                                           value.z());
}

void Program::set(const char* uniform, const Eigen::Matrix3d& value) const {
  // Both Eigen and OpenGL store matrices by columns.
  program_.context().gl().ProgramUniformMatrix3dv(program_.get(), location(uniform), 1, GL_FALSE,
                                                  value.data());
}

void Program::set(const char* uniform, const Eigen::Matrix4f& value) const {
  program_.context().gl().ProgramUniformMatrix4fv(program_.get(), location(uniform), 1, GL_FALSE,
                                                  value.data());
}

}  // namespace tetraglass::project::gl
