#include "client-sdk/fit/palette.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace mechane::fit {
namespace {

// Paul Tol's 'muted' scheme (SRON/EPS/TN/09-002), safe for all common kinds of colour vision, its darkest last, the
// indigo lightened.
constexpr std::array<std::uint32_t, 9> kPartColours{0xCC6677, 0x88CCEE, 0xDDCC77, 0x44AA99, 0xAA4499,
                                                    0x999933, 0x117733, 0x882255, 0x4B5AA5};
constexpr std::array<std::uint32_t, 6> kErrorScale{0xF4EFDC, 0xF3CF7E, 0xEB9A4A, 0xCB5B45, 0x8A2C55, 0x3B1441};
constexpr std::array<std::uint32_t, 6> kDepthScale{0xF3EEDB, 0xC6D8A8, 0x86BDA0, 0x4A97A3, 0x32668F, 0x232F62};

float decode(float s) {
  return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}
float encode(float l) {
  return l <= 0.0031308F ? 12.92F * l : 1.055F * std::pow(l, 1 / 2.4F) - 0.055F;
}

std::span<const std::uint32_t> stops_of(Scale scale) {
  return scale == Scale::error ? std::span<const std::uint32_t>(kErrorScale) : kDepthScale;
}

}  // namespace

Colour from_srgb(std::uint32_t rgb) {
  const auto channel = [&](int shift) { return decode(static_cast<float>(rgb >> shift & 255U) / 255); };
  return {channel(16), channel(8), channel(0)};
}

std::uint32_t to_srgb(const Colour& colour) {
  std::uint32_t rgb = 0;
  for (int i = 0; i < 3; ++i)
    rgb = rgb << 8U | static_cast<std::uint32_t>(std::lround(255 * encode(std::clamp(colour[i], 0.0F, 1.0F))));
  return rgb;
}

std::string css(const Colour& colour) {
  return fmt::format("#{:06x}", to_srgb(colour));
}

std::vector<Colour> part_colours(const collision::Object& object) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < object.parts.size(); ++i) {
    std::array<double, kPartColours.size()> cost{};
    for (std::size_t k = 0; k < kPartColours.size(); ++k)
      cost[k] = 1e-3 * static_cast<double>((k + kPartColours.size() - i % kPartColours.size()) % kPartColours.size());
    for (std::size_t j = 0; j < i; ++j) {
      const geometry::Sphere& a = object.parts[i].bound_O;
      const geometry::Sphere& b = object.parts[j].bound_O;
      const double gap = (a.center - b.center).norm() / std::max(a.radius + b.radius, 1e-9);
      if (gap < 1) cost[chosen[j]] += 1 - gap;
    }
    chosen.push_back(static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin()));
  }
  std::vector<Colour> colours;
  colours.reserve(chosen.size());
  for (const std::size_t k : chosen)
    colours.push_back(from_srgb(kPartColours[k]));
  return colours;
}

Colour colour_at(Scale scale, double share) {
  const std::span<const std::uint32_t> stops = stops_of(scale);
  const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const auto blend = static_cast<float>(at - static_cast<double>(lower));
  // Interpolated in sRGB like a browser's gradient, so that bar and picture agree.
  Colour mixed;
  for (int i = 0; i < 3; ++i) {
    const int shift = 16 - 8 * i;
    const auto a = static_cast<float>(stops[lower] >> shift & 255U);
    const auto b = static_cast<float>(stops[lower + 1] >> shift & 255U);
    mixed[i] = decode((a + blend * (b - a)) / 255);
  }
  return mixed;
}

std::string css_gradient(Scale scale) {
  std::string list;
  for (const std::uint32_t stop : stops_of(scale))
    list += fmt::format(",#{:06x}", stop);
  return "linear-gradient(90deg" + list + ")";
}

Colour not_felt_colour() {
  return from_srgb(0x00A6D6);
}
Colour plain_colour() {
  return from_srgb(0xCFC8B8);
}

Colour origin_colour(geometry::SurfaceOrigin origin) {
  switch (origin) {
    case geometry::SurfaceOrigin::membrane:
      return from_srgb(0x2F6FB0);
    case geometry::SurfaceOrigin::sheet:
      return from_srgb(0xE0A030);
    case geometry::SurfaceOrigin::mesh:
      break;
  }
  return plain_colour();
}

}  // namespace mechane::fit
