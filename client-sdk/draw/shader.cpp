#include "client-sdk/draw/shader.hpp"

#include <epoxy/gl.h>

#include "server/base/assert.hpp"

namespace mechane::draw {

// Defined in the file that CMake makes from shaders/.
const char* find_shader_source(std::string_view name);

std::string_view shader_source(std::string_view name) {
  const char* text = find_shader_source(name);
  MECHANE_ASSERT(text != nullptr);
  return text;
}

namespace {

std::string log_of(GLuint name, bool is_program) {
  std::string text(2000, '\0');
  GLsizei length = 0;
  if (is_program) {
    glGetProgramInfoLog(name, static_cast<GLsizei>(text.size()), &length, text.data());
  } else {
    glGetShaderInfoLog(name, static_cast<GLsizei>(text.size()), &length, text.data());
  }
  text.resize(static_cast<std::size_t>(length));
  return text;
}

Expected<GLuint> compile(GLenum stage, const std::vector<std::string_view>& files) {
  std::string source = "#version 330 core\n";
  std::string names;
  for (const std::string_view file : files) {
    source += "#line 1\n";
    source += shader_source(file);
    names += names.empty() ? "" : " + ";
    names += file;
  }
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    std::string reason = log_of(shader, false);
    glDeleteShader(shader);
    return fail(ErrorCode::not_supported, "the graphics driver does not compile a shader: " + reason, names,
                "update the graphics driver");
  }
  return shader;
}

}  // namespace

Expected<Program> Program::link(std::initializer_list<std::string_view> vertex,
                                std::initializer_list<std::string_view> fragment) {
  return link_files(vertex, fragment);
}

Expected<Program> Program::link(Shading shading, std::initializer_list<std::string_view> vertex,
                                std::initializer_list<std::string_view> fragment) {
  const bool low = shading == Shading::screen;
  Files vertex_files = low ? Files{"low.glsl"} : Files{};
  Files fragment_files = low ? Files{"low.glsl", "tone.glsl", "screen.glsl"} : Files{"linear.glsl"};
  vertex_files.insert(vertex_files.end(), vertex.begin(), vertex.end());
  fragment_files.insert(fragment_files.end(), fragment.begin(), fragment.end());
  return link_files(vertex_files, fragment_files);
}

Expected<Program> Program::link_files(const Files& vertex, const Files& fragment) {
  const Expected<GLuint> v = compile(GL_VERTEX_SHADER, vertex);
  if (!v) return tl::unexpected(v.error());
  const Expected<GLuint> f = compile(GL_FRAGMENT_SHADER, fragment);
  if (!f) {
    glDeleteShader(*v);
    return tl::unexpected(f.error());
  }
  ProgramName program(glCreateProgram());
  glAttachShader(program.get(), *v);
  glAttachShader(program.get(), *f);
  glLinkProgram(program.get());
  glDeleteShader(*v);
  glDeleteShader(*f);
  GLint linked = 0;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    return fail(ErrorCode::not_supported, "the graphics driver does not link a shader: " + log_of(program.get(), true),
                std::string(fragment.back()), "update the graphics driver");
  }
  return Program(std::move(program));
}

void Program::use() const {
  glUseProgram(name_.get());
}

void Program::set(const char* name, int value) const {
  glUniform1i(glGetUniformLocation(name_.get(), name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(glGetUniformLocation(name_.get(), name), value);
}
void Program::set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(glGetUniformLocation(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Vec3f& value) const {
  glUniform3fv(glGetUniformLocation(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(glGetUniformLocation(name_.get(), name), 1, value.data());
}
void Program::set(const char* name, const Eigen::Matrix3f& value) const {
  glUniformMatrix3fv(glGetUniformLocation(name_.get(), name), 1, GL_FALSE, value.data());
}
void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  glUniformMatrix4fv(glGetUniformLocation(name_.get(), name), 1, GL_FALSE, value.data());
}
void Program::set(const char* name, const std::vector<Eigen::Vector4f>& values) const {
  if (values.empty()) return;
  glUniform4fv(glGetUniformLocation(name_.get(), name), static_cast<GLsizei>(values.size()), values.front().data());
}
void Program::set(const char* name, const std::vector<Eigen::Matrix3f>& values) const {
  if (values.empty()) return;
  glUniformMatrix3fv(glGetUniformLocation(name_.get(), name), static_cast<GLsizei>(values.size()), GL_FALSE,
                     values.front().data());
}
void Program::set(const char* name, const std::vector<Eigen::Matrix4f>& values) const {
  if (values.empty()) return;
  glUniformMatrix4fv(glGetUniformLocation(name_.get(), name), static_cast<GLsizei>(values.size()), GL_FALSE,
                     values.front().data());
}
void Program::set(const char* name, const std::array<Vec3f, 9>& values) const {
  glUniform3fv(glGetUniformLocation(name_.get(), name), 9, values.front().data());
}

}  // namespace mechane::draw
