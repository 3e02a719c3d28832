#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "project/gl/objects.h"

namespace tetraglass::project::gl {

/// The text of one of the shader files beside this one ("cell.vert.glsl"); empty where there is no
/// such file.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// The source of a shader for one purpose: the version, a `#define` for each switch, and the file
/// with its `#include "..."` lines replaced by the files they name. Throws Error for a file that is
/// not there.
[[nodiscard]] std::string shader_source(const std::string& file,
                                        const std::vector<std::string>& switches);

/// A vertex and a fragment stage, linked.
class Program {
 public:
  /// Throws Error with the driver's log where the sources do not compile.
  Program(const Context& context, const std::string& vertex_source,
          const std::string& fragment_source);

  void use() const;

  /// Uniforms that the program has no use for are passed over.
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, double value) const;
  void set(const char* uniform, const Eigen::Vector2f& value) const;
  void set(const char* uniform, const Eigen::Vector3f& value) const;
  void set(const char* uniform, const Eigen::Vector4f& value) const;
  void set(const char* uniform, const Eigen::Vector2d& value) const;
  void set(const char* uniform, const Eigen::Vector3d& value) const;
  void set(const char* uniform, const Eigen::Matrix3d& value) const;
  void set(const char* uniform, const Eigen::Matrix4f& value) const;

 private:
  [[nodiscard]] int location(const char* uniform) const;

  Name program_;
};

}  // namespace tetraglass::project::gl
