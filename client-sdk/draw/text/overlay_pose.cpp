// A pose of the hand on its disc, within a ring that fills, with a few words under it.
#include <algorithm>
#include <cmath>

#include "client-sdk/draw/text/overlay_page.hpp"
#include "server/base/math.hpp"

namespace mechane::draw {
namespace {

constexpr float kDisc = 150;        // radius
constexpr float kLeastDisc = 90;    // words become smaller before the disc is
constexpr float kRing = 1.11F;      // the radius of the ring's middle, over the disc's
constexpr float kWithRing = 1.18F;  // to the ring's outer edge
constexpr float kDots = 28;         // the poses, under the words
constexpr int kRingDots = 60;
constexpr float kLine = 3.5F;  // an outline, on the largest disc
constexpr float kPosePadding = 28;
constexpr auto kWholeTurn_rad = static_cast<float>(2 * kPi);

/// Its middle, pixels of the page.
struct Disc {
  float x = 0, y = 0, radius = 0;
};

Eigen::Vector4f opaque_ink(const Page& page) {
  return {page.colours.ink.x(), page.colours.ink.y(), page.colours.ink.z(), 1};
}

/// A bar from one place to another, with round ends.
void add_bar(Page& page, const Eigen::Vector2f& from, const Eigen::Vector2f& to, float radius,
             const Eigen::Vector4f& colour) {
  const Eigen::Vector2f middle = (from + to) / 2, along = to - from;
  const float half = along.norm() / 2 + radius;
  page.out.shapes.push_back(
      {middle.x() - half, middle.y() - radius, 2 * half, 2 * radius, radius, colour, std::atan2(along.y(), along.x())});
}

void add_drawing(Page& page, const std::vector<picture::HandStroke>& strokes, const Disc& disc) {
  const Eigen::Vector2f middle(disc.x, disc.y);
  const Eigen::Vector4f dark = opaque_ink(page);
  const float line = std::max(1.5F, kLine / kDisc * disc.radius);
  for (std::size_t begin = 0, end = 0; begin < strokes.size(); begin = end) {
    while (end < strokes.size() && strokes[end].part == strokes[begin].part)
      ++end;
    for (const bool outline : {true, false}) {
      for (std::size_t i = begin; i < end; ++i) {
        const picture::HandStroke& s = strokes[i];
        add_bar(page, middle + disc.radius * s.from, middle + disc.radius * s.to,
                disc.radius * s.radius + (outline ? line : 0), outline ? dark : page.colours.paper);
      }
    }
  }
}

/// All is done.
void add_tick(Page& page, const Disc& disc) {
  const Eigen::Vector4f dark = opaque_ink(page);
  const auto at = [&disc](float x, float y) {
    return Eigen::Vector2f(disc.x + disc.radius * x, disc.y + disc.radius * y);
  };
  add_bar(page, at(-0.42F, 0.05F), at(-0.12F, 0.35F), 0.09F * disc.radius, dark);
  add_bar(page, at(-0.12F, 0.35F), at(0.45F, -0.32F), 0.09F * disc.radius, dark);
}

/// Dots, clockwise from the top.
void add_ring(Page& page, float held, const Disc& disc) {
  const float radius = kRing * disc.radius;
  const float dot = 0.42F * kWholeTurn_rad * radius / kRingDots;
  const auto full = static_cast<int>(std::lround(std::clamp(held, 0.0F, 1.0F) * kRingDots));
  for (int i = 0; i < kRingDots; ++i) {
    const float angle = kWholeTurn_rad * (static_cast<float>(i) + 0.5F) / kRingDots;
    const Eigen::Vector2f at(disc.x + radius * std::sin(angle), disc.y - radius * std::cos(angle));
    add_bar(page, at, at, dot, i < full ? page.colours.water : page.colours.faint);
  }
}

/// Lines in the middle of the page from `y` on; returns where they end.
float add_lines(Page& page, const std::string& text, Face face, float size, const Eigen::Vector4f& colour, float y,
                float most) {
  for (const std::string& line : page.lines(face, size, text, most)) {
    page.add_text((page.width - page.measure(face, size, line)) / 2, y + page.tx(size), face, size, colour, line);
    y += page.tx(1.35F * size);
  }
  return y;
}

/// Adds the words from y = 0 on; returns their height.
float add_words(Page& page, const picture::OverlayPose& pose, float most) {
  float y = add_lines(page, pose.again, Face::bold, 21, page.colours.gold, 0, most);
  y = add_lines(page, pose.text, Face::bold, 36, page.colours.paper, y, most);
  return add_lines(page, pose.more, Face::regular, 23, page.colours.paper, y, most);
}

/// The radius of the largest disc that fits above words of that height, in a panel of this width in the room; negative: none fits.
float disc_radius(const Page& page, float width, float words, const Box& room) {
  const float padding = page.px(kPosePadding);
  const float most = std::min(width - 2 * padding, room.height - words - page.tx(kDots) - 3 * padding);
  return std::min(page.px(kDisc), most / (2 * kWithRing));
}

}  // namespace

void add_pose(Page& page, const picture::OverlayPose& pose, const Box& room) {
  const float padding = page.px(kPosePadding);
  const float width = std::min(room.width, page.tx(680));
  const std::size_t shapes = page.out.shapes.size(), texts = page.out.texts.size();
  const float wanted = page.scale;
  float words = add_words(page, pose, width - 2 * padding);
  while (disc_radius(page, width, words, room) < page.px(kLeastDisc) && page.scale > 0.3F) {
    page.scale *= 0.92F;
    page.out.texts.resize(texts);
    words = add_words(page, pose, width - 2 * padding);
  }
  if (disc_radius(page, width, words, room) < 0) {  // the picture says enough
    page.out.texts.resize(texts);
    words = 0;
  }
  const float radius = std::max(disc_radius(page, width, words, room), 1.0F);
  const float ring = 2 * kWithRing * radius, dots = page.tx(kDots);
  const float height = ring + words + dots + 3 * padding;
  const Box box{room.x + (room.width - width) / 2, std::round(room.y + (room.height - height) / 2), width, height};
  page.move_down(shapes, texts, page.out.targets.size(), box.y + 2 * padding + ring);
  page.add_panel(box);
  const Disc disc{box.x + width / 2, box.y + padding + ring / 2, radius};
  add_bar(page, {disc.x, disc.y}, {disc.x, disc.y}, radius, page.colours.gold);
  pose.drawing.empty() ? add_tick(page, disc) : add_drawing(page, pose.drawing, disc);
  add_ring(page, pose.held, disc);
  const std::size_t first_dot = page.out.shapes.size();
  const float wide = page.add_dots(disc.x, box.below() - padding - page.tx(5), pose.done, pose.total);
  for (std::size_t i = first_dot; i < page.out.shapes.size(); ++i)
    page.out.shapes[i].x += wide / 2;
  page.scale = wanted;
}

}  // namespace mechane::draw
