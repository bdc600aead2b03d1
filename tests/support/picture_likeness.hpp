// How like two pictures look. Not ImageMagick's or scikit-image's measure, though it is the same formula: those give the mean of a picture, in
// which a shadow that is lost in one corner disappears; and they would be the test programs' largest dependency by far.
#pragma once

#include <algorithm>
#include <vector>

#include "client-sdk/picture/render_scene.hpp"

namespace mechane::test {

/// 1: the same.
struct Likeness {
  double mean = 0;   ///< of all places
  double worst = 0;  ///< of the fiftieth part of all places that is least alike
};

/// Structural similarity (Wang, Bovik, Sheikh, Simoncelli 2004, eq. 13, with their constants) of red, green and blue, in squares of 8 pixels,
/// one every 4. Pictures of different sizes are not alike.
[[nodiscard]] inline Likeness likeness(const picture::ImageData& a, const picture::ImageData& b) {
  constexpr std::size_t kSquare = 8;
  constexpr double kCount = kSquare * kSquare;
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255;
  constexpr double kC2 = 0.03 * 255 * 0.03 * 255;
  if (a.width != b.width || a.height != b.height || a.width < kSquare || a.height < kSquare) return {};
  std::vector<double> places;
  for (std::size_t top = 0; top + kSquare <= a.height; top += kSquare / 2) {
    for (std::size_t left = 0; left + kSquare <= a.width; left += kSquare / 2) {
      double place = 0;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
        for (std::size_t pixel = 0; pixel < kSquare * kSquare; ++pixel) {
          const std::size_t at = 4 * ((top + pixel / kSquare) * a.width + left + pixel % kSquare) + channel;
          const double x = a.rgba[at];
          const double y = b.rgba[at];
          sum_a += x;
          sum_b += y;
          sum_aa += x * x;
          sum_bb += y * y;
          sum_ab += x * y;
        }
        const double mean_a = sum_a / kCount;
        const double mean_b = sum_b / kCount;
        const double variances = (sum_aa + sum_bb) / kCount - mean_a * mean_a - mean_b * mean_b;
        const double covariance = sum_ab / kCount - mean_a * mean_b;
        place += (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
                 ((mean_a * mean_a + mean_b * mean_b + kC1) * (variances + kC2)) / 3;
      }
      places.push_back(place);
    }
  }
  const std::size_t least = std::max<std::size_t>(places.size() / 50, 1);
  std::ranges::partial_sort(places, places.begin() + static_cast<std::ptrdiff_t>(least));
  Likeness out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    out.mean += places[i] / static_cast<double>(places.size());
    if (i < least) out.worst += places[i] / static_cast<double>(least);
  }
  return out;
}

}  // namespace mechane::test
