#include "modules/scene/pull_push.hpp"

#include <algorithm>

namespace atrium::scene {
namespace {

/// Half the size: means of 2 × 2 pixels.
WeightedImage pulled(const WeightedImage& fine) {
  WeightedImage coarse;
  coarse.width = (fine.width + 1) / 2;
  coarse.height = (fine.height + 1) / 2;
  coarse.pixels.reserve(static_cast<std::size_t>(coarse.width) * coarse.height);
  coarse.confidence.reserve(coarse.pixels.capacity());
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      WeightedColour sum = WeightedColour::Zero();
      float coverage = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, fine.height); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, fine.width); ++u) {
          const std::size_t i = fine.index(u, v);
          WeightedColour colour = fine.pixels[i];
          const float covered = colour[3];
          colour[3] = 1;
          sum += colour * (covered * fine.confidence[i]);
          coverage += covered;
        }
      const float weight = sum[3];
      if (weight > 0) sum /= weight;
      sum[3] = std::min(coverage, 1.0F);
      coarse.pixels.push_back(sum);
      coarse.confidence.push_back(coverage > 0 ? weight / coverage : 0);
    }
  return coarse;
}

/// What a pixel lacks to weight 1 comes from the coarser image, which is known everywhere, between its pixels.
void push(const WeightedImage& coarse, WeightedImage& fine) {
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      WeightedColour& pixel = fine.pixels[fine.index(x, y)];
      const float weight = pixel[3] * fine.confidence[fine.index(x, y)];
      if (weight >= 1) continue;
      // Centres of coarse pixels stand at 2i + 0.5: the nearest has 3/4, the next 1/4 along each axis.
      const int u = x / 2, v = y / 2;
      const int s = std::clamp(x % 2 == 0 ? u - 1 : u + 1, 0, coarse.width - 1);
      const int t = std::clamp(y % 2 == 0 ? v - 1 : v + 1, 0, coarse.height - 1);
      const auto at = [&](int i, int j) { return coarse.pixels[coarse.index(i, j)]; };
      const WeightedColour near = 0.75F * at(u, v) + 0.25F * at(s, v);
      const WeightedColour next = 0.75F * at(u, t) + 0.25F * at(s, t);
      pixel = pixel * weight + (0.75F * near + 0.25F * next) * (1 - weight);
      pixel[3] = 1;
    }
}

}  // namespace

void pull_push(WeightedImage& image) {
  bool known = false;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i][3] = std::min(image.pixels[i][3], 1.0F);
    known = known || image.pixels[i][3] * image.confidence[i] > 0;
  }
  if (!known) return;
  std::vector<WeightedImage> levels;
  const auto last = [&]() -> WeightedImage& { return levels.empty() ? image : levels.back(); };
  while (last().width > 1 || last().height > 1) levels.push_back(pulled(last()));
  last().pixels.front()[3] = 1;
  for (std::size_t i = levels.size(); i-- > 0;) push(levels[i], i == 0 ? image : levels[i - 1]);
}

}  // namespace atrium::scene
