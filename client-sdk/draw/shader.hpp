// A shader program, and its uniforms by name. Sources are the files of shaders/, built into the program by CMake.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Dense>

#include "client-sdk/draw/gl_object.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"

namespace mechane::draw {

/// The text of shaders/<name>; an unknown name is our own bug and asserts.
[[nodiscard]] std::string_view shader_source(std::string_view name);

/// What the shaders of light give out.
enum class Shading : std::uint8_t {
  linear,  ///< linear light, for a later tone pass
  screen,  ///< screen colours at once, from cheaper light: for the qualities `low` and `cached`
};

class Program {
 public:
  /// Each stage is a list of files, concatenated after "#version 330 core". Errors: with the driver's message.
  [[nodiscard]] static Expected<Program> link(std::initializer_list<std::string_view> vertex,
                                              std::initializer_list<std::string_view> fragment);
  /// The same with the files before them that `shading` needs.
  [[nodiscard]] static Expected<Program> link(Shading shading, std::initializer_list<std::string_view> vertex,
                                              std::initializer_list<std::string_view> fragment);

  void use() const;
  // A uniform that the driver has optimised away is skipped. The program must be in use.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Vec3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix3f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;
  void set(const char* name, const std::vector<Eigen::Vector4f>& values) const;
  void set(const char* name, const std::vector<Eigen::Matrix3f>& values) const;
  void set(const char* name, const std::vector<Eigen::Matrix4f>& values) const;
  void set(const char* name, const std::array<Vec3f, 9>& values) const;

 private:
  using Files = std::vector<std::string_view>;
  [[nodiscard]] static Expected<Program> link_files(const Files& vertex, const Files& fragment);
  explicit Program(ProgramName name) : name_(std::move(name)) {}
  ProgramName name_;
};

}  // namespace mechane::draw
