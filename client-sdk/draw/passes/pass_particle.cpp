#include <array>

#include <epoxy/gl.h>

#include "client-sdk/draw/passes/particles.hpp"
#include "client-sdk/draw/passes/passes.hpp"

namespace mechane::draw {
namespace {

constexpr int kDepthUnit = 5;
constexpr std::array<int, 4> kParticleSizes{3, 1, 4, 3};
constexpr std::size_t kParticleFloats = 11;

}  // namespace

Expected<ParticlePass> ParticlePass::create(Shading shading) {
  Expected<Program> program =
      Program::link(shading, {"tone.glsl", "sky.glsl", "lighting.glsl", "puff.glsl", "particle.vert"},
                    {"sky.glsl", "lighting.glsl", "puff.glsl", "noise.glsl", "particle.frag"});
  if (!program) return tl::unexpected(program.error());
  ParticlePass pass(std::move(*program));
  glBindVertexArray(pass.vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, pass.buffer_.get());
  describe_floats(kParticleSizes, kParticleFloats * sizeof(float));
  for (GLuint attribute = 0; attribute < kParticleSizes.size(); ++attribute)
    glVertexAttribDivisor(attribute, 1);
  return pass;
}

void ParticlePass::draw(const PassInput& input) const {
  const std::vector<Particle> particles = particles_of(input.scene, input.view.p_WE);
  if (particles.empty()) return;
  std::vector<float> floats;
  floats.reserve(particles.size() * kParticleFloats);
  for (const Particle& p : particles) {
    floats.insert(floats.end(), {p.p_W.x(), p.p_W.y(), p.p_W.z(), p.radius_m, p.colour.x(), p.colour.y(), p.colour.z(),
                                 p.opacity, p.spin_rad, p.seed, static_cast<float>(p.shape)});
  }
  glBindVertexArray(vertex_array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(floats.size() * sizeof(float)), floats.data(), GL_STREAM_DRAW);
  begin_blending();
  program_.use();
  set_lighting(program_, input);
  program_.set("V_CW", input.view.V_CW);
  program_.set("P", input.view.P);
  program_.set("depth_to_m", Eigen::Vector2f(input.view.P(2, 2), input.view.P(2, 3)));
  program_.set("depth", kDepthUnit);
  glActiveTexture(GL_TEXTURE0 + kDepthUnit);
  glBindTexture(GL_TEXTURE_2D, input.depth_of_solid.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(particles.size()));
  end_blending();
}

}  // namespace mechane::draw
