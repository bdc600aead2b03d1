#include "client-sdk/draw/draw_timer.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <epoxy/gl.h>

#include "client-sdk/draw/render_target.hpp"
#include "client-sdk/draw/shader.hpp"

namespace mechane::draw {
namespace {

constexpr picture::PixelSize kProbe{512, 512};
constexpr int kProbes = 4;  // together a million pixels

/// Of all cores, as if they shared the work evenly.
double processor_ms(std::clock_t time) {
  const double cores = std::max(std::thread::hardware_concurrency(), 1U);
  return 1e3 * static_cast<double>(time) / CLOCKS_PER_SEC / cores;
}

}  // namespace

Expected<DrawingSpeed> measure_drawing_speed() {
  const Expected<Program> sky =
      Program::link(Shading::linear, {"fullscreen.vert"}, {"sky.glsl", "noise.glsl", "clouds.glsl", "sky.frag"});
  if (!sky) return tl::unexpected(sky.error());
  const Expected<FloatTarget> target = FloatTarget::create(kProbe);
  if (!target) return tl::unexpected(target.error());
  const VertexArrayName no_vertices = make_vertex_array();
  target->bind();
  sky->use();
  sky->set("to_sun", Vec3f(Vec3f::UnitY()));
  sky->set("R_WP", Eigen::Matrix4f(Eigen::Matrix4f::Identity()));
  glBindVertexArray(no_vertices.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);  // compiles the shader
  glFinish();
  const auto began = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  for (int i = 0; i < kProbes; ++i)
    glDrawArrays(GL_TRIANGLES, 0, 3);
  glFinish();
  const double wall_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
  const std::clock_t used = std::clock() - cpu;
  // A driver that waits for a card may spin, but with one thread only, and far less than this long.
  const bool by_processor = wall_ms > 4 && 1e3 * static_cast<double>(used) / CLOCKS_PER_SEC > 0.5 * wall_ms;
  return DrawingSpeed{by_processor ? std::min(processor_ms(used), wall_ms) : wall_ms, by_processor};
}

void DrawTimer::begin() {
  measures_ = by_processor_ || !waits_;
  if (by_processor_) {
    began_ = std::clock();
  } else if (measures_) {
    if (!query_) query_ = make_query();
    glBeginQuery(GL_TIME_ELAPSED, query_.get());
  }
}

void DrawTimer::end() {
  if (by_processor_) {
    glFinish();
    ms_ = processor_ms(std::clock() - began_);
  } else if (measures_) {
    glEndQuery(GL_TIME_ELAPSED);
    waits_ = true;
  }
}

std::optional<double> DrawTimer::take() {
  if (waits_) {
    GLint ready = GL_FALSE;
    glGetQueryObjectiv(query_.get(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (ready == GL_FALSE) return std::nullopt;
    GLuint64 ns = 0;
    glGetQueryObjectui64v(query_.get(), GL_QUERY_RESULT, &ns);
    waits_ = false;
    ms_ = static_cast<double>(ns) / 1e6;
  }
  return std::exchange(ms_, std::nullopt);
}

}  // namespace mechane::draw
