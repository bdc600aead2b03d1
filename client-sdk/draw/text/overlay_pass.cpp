#include "client-sdk/draw/text/overlay_pass.hpp"

#include <array>
#include <cmath>

#include <epoxy/gl.h>

namespace mechane::draw {
namespace {

/// A vertex of overlay.vert.
struct Vertex {
  float x, y, u, v;
  std::array<float, 4> colour;
  std::array<float, 4> shape;
};

struct Quad {
  float x, y, width, height;
  float u0, v0, u1, v1;
};

/// Turned about its middle, clockwise.
void add_quad(std::vector<Vertex>& out, const Quad& q, const Eigen::Vector4f& colour, const std::array<float, 4>& shape,
              float turn_rad = 0) {
  const std::array<float, 4> c{colour.x(), colour.y(), colour.z(), colour.w()};
  const float cosine = std::cos(turn_rad), sine = std::sin(turn_rad);
  const float hw = q.width / 2, hh = q.height / 2;
  const auto corner = [&](float x, float y, float u, float v) {
    return Vertex{q.x + hw + cosine * x - sine * y, q.y + hh + sine * x + cosine * y, u, v, c, shape};
  };
  const Vertex a = corner(-hw, -hh, q.u0, q.v0);
  const Vertex b = corner(-hw, hh, q.u0, q.v1);
  const Vertex d = corner(hw, hh, q.u1, q.v1);
  const Vertex e = corner(hw, -hh, q.u1, q.v0);
  out.insert(out.end(), {a, b, d, a, d, e});
}

void add_shape(std::vector<Vertex>& out, const OverlayShape& shape) {
  const float hw = shape.width / 2;
  const float hh = shape.height / 2;
  // One pixel larger on all sides, for the soft edge.
  const Quad quad{shape.x - 1, shape.y - 1, shape.width + 2, shape.height + 2, -hw - 1, -hh - 1, hw + 1, hh + 1};
  add_quad(out, quad, shape.colour, {hw, hh, shape.corner_radius, 1}, shape.turn_rad);
}

}  // namespace

OverlayPass::OverlayPass(Program program, std::unique_ptr<Typesetter> typesetter)
    : program_(std::move(program)),
      typesetter_(std::move(typesetter)),
      atlas_(make_texture()),
      array_(make_vertex_array()),
      vertices_(make_buffer()) {
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  constexpr std::array<int, 4> kSizes{2, 2, 4, 4};
  describe_floats(kSizes, sizeof(Vertex));
}

Expected<OverlayPass> OverlayPass::create(const std::string& font_folder) {
  Expected<Program> program = Program::link({"overlay.vert"}, {"overlay.frag"});
  if (!program) return tl::unexpected(program.error());
  GLint most_side = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most_side);
  Expected<std::unique_ptr<Typesetter>> typesetter =
      Typesetter::create(font_folder, static_cast<std::uint32_t>(most_side));
  if (!typesetter) return tl::unexpected(typesetter.error());
  return OverlayPass(std::move(*program), std::move(*typesetter));
}

void OverlayPass::upload_atlas() {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, atlas_.get());
  if (atlas_revision_ == typesetter_->atlas_revision()) return;
  atlas_revision_ = typesetter_->atlas_revision();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const auto side = static_cast<GLsizei>(typesetter_->atlas_side());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, side, side, 0, GL_RED, GL_UNSIGNED_BYTE, typesetter_->atlas().data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

const OverlayLayout& OverlayPass::lay_out(const picture::RenderScene& scene, picture::PixelSize size) {
  const std::string* inset_caption = scene.inset ? &scene.inset->caption : nullptr;
  const MeasureText measure = [this](Face face, int px, std::string_view text) {
    return typesetter_->width(face, px, text);
  };
  layout_ = draw::lay_out(scene.overlay, size, measure, inset_caption);
  return layout_;
}

void OverlayPass::draw() {
  std::vector<Vertex> vertices;
  for (const OverlayShape& shape : layout_.shapes)
    add_shape(vertices, shape);
  std::vector<TextLine> lines;
  for (const OverlayText& text : layout_.texts)
    lines.push_back({text.face, text.size_px, text.text});
  const std::vector<SetLine> set = typesetter_->set_lines(lines);
  for (std::size_t i = 0; i < set.size(); ++i) {
    const OverlayText& text = layout_.texts[i];
    for (const PlacedGlyph& g : set[i].glyphs) {
      const Quad quad{std::round(text.x) + g.x, text.baseline + g.y, g.width, g.height, g.u0, g.v0, g.u1, g.v1};
      add_quad(vertices, quad, text.colour, {0, 0, 0, 0});
    }
  }
  if (vertices.empty()) return;
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  program_.use();
  program_.set("size",
               Eigen::Vector2f(static_cast<float>(layout_.size.width), static_cast<float>(layout_.size.height)));
  program_.set("atlas", 0);
  upload_atlas();
  glBindVertexArray(array_.get());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.get());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
               GL_STREAM_DRAW);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  glDisable(GL_BLEND);
}

}  // namespace mechane::draw
