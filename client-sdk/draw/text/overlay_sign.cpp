#include "client-sdk/draw/text/overlay_sign.hpp"

#include <span>

namespace mechane::draw {
namespace {

using Sign = picture::OverlayNotice::Sign;

/// A box with round corners on a tile of 100 x 100, origin in its upper left corner; `cut`: a hole through what lies below it.
struct Stroke {
  float x, y, width, height, corner;
  bool cut = false;
};

/// A handle on its foot, and the fingers and the thumb around it.
constexpr Stroke kTake[] = {
    {45, 8, 10, 84, 5},    {24, 80, 52, 12, 6},   {28, 26, 44, 46, 12, true}, {31, 29, 38, 9, 4.5F},
    {31, 40, 38, 9, 4.5F}, {31, 51, 38, 9, 4.5F}, {34, 62, 32, 8, 4},         {24, 30, 10, 34, 5},
};
/// An open hand: cuff, palm, fingers, thumb.
constexpr Stroke kWear[] = {
    {30, 42, 42, 36, 15},  {30, 20, 9, 40, 4.5F}, {41, 12, 9, 48, 4.5F}, {52, 14, 9, 46, 4.5F},
    {63, 24, 9, 36, 4.5F}, {14, 44, 10, 22, 5},   {14, 54, 26, 14, 7},   {33, 82, 36, 9, 3},
};
constexpr Stroke kWait[] = {{16, 43, 15, 15, 7.5F}, {42.5F, 43, 15, 15, 7.5F}, {69, 43, 15, 15, 7.5F}};
constexpr Stroke kTarget[] = {
    {22, 22, 56, 56, 28}, {29, 29, 42, 42, 21, true}, {47, 12, 6, 26, 3},  {47, 62, 6, 26, 3},
    {12, 47, 26, 6, 3},   {62, 47, 26, 6, 3},         {45, 45, 10, 10, 5},
};
/// A thermometer, with its column and its scale.
constexpr Stroke kWarm[] = {
    {34, 10, 26, 62, 13},       {29, 54, 36, 36, 18},  {40, 16, 14, 54, 7, true},
    {35, 60, 24, 24, 12, true}, {44, 26, 6, 46, 3},    {39, 64, 16, 16, 8},
    {66, 18, 12, 5, 2.5F},      {66, 31, 12, 5, 2.5F}, {66, 44, 12, 5, 2.5F},
};
/// A plug above its socket.
constexpr Stroke kUnplugged[] = {
    {46, 8, 8, 16, 0},   {30, 20, 40, 20, 6}, {36, 36, 7, 16, 2},       {57, 36, 7, 16, 2},
    {30, 60, 40, 20, 6}, {46, 76, 8, 16, 0},  {36, 60, 7, 11, 2, true}, {57, 60, 7, 11, 2, true},
};

std::span<const Stroke> strokes_of(Sign sign) {
  switch (sign) {
    case Sign::take:
      return kTake;
    case Sign::wear:
      return kWear;
    case Sign::wait:
      return kWait;
    case Sign::target:
      return kTarget;
    case Sign::warm:
      return kWarm;
    case Sign::unplugged:
      return kUnplugged;
  }
  return {};
}

}  // namespace

void add_sign(Page& page, Sign sign, const Box& tile) {
  const float unit = tile.width / 100;
  Eigen::Vector4f dark = page.colours.ink;
  dark.w() = 1;
  page.add_shape(tile, 0.16F * tile.width, page.colours.gold);
  for (const Stroke& s : strokes_of(sign)) {
    page.add_shape({tile.x + unit * s.x, tile.y + unit * s.y, unit * s.width, unit * s.height}, unit * s.corner,
                   s.cut ? page.colours.gold : dark);
  }
}

}  // namespace mechane::draw
