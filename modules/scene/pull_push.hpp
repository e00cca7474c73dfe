#pragma once
#include <Eigen/Core>
#include <vector>

namespace atrium::scene {

/// A pixel: mean colour (three channels) and coverage: 0 where nothing is known, 1 where enough points tell.
using WeightedColour = Eigen::Array4f;

struct WeightedImage {
  int width = 0, height = 0;
  std::vector<WeightedColour> pixels;
  std::vector<float> confidence;  ///< per pixel, 0 … 1: how far what is known is believed
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Fills what is unknown, and blends what is less than known, from ever coarser versions of the image (Gortler et al.,
/// "The Lumigraph", 1996, section 3.5). A pixel keeps the share coverage · confidence of its own colour. In a coarser
/// pixel coverage adds up, confidence is averaged: many doubtful pixels make no trusted one. All pixels are covered
/// afterwards if any was believed at all; else nothing changes.
void pull_push(WeightedImage& image);

}  // namespace atrium::scene
