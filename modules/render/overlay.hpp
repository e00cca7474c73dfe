#pragma once
#include <string>
#include <utility>
#include <vector>

#include "modules/types/cloud.hpp"

class vtkRenderer;

namespace atrium::render {

/// Words and marks on top of a picture. Sizes are in pixels of the picture.
struct Overlay {
  std::string title;                                   ///< top left
  std::vector<std::pair<std::string, Colour>> legend;  ///< bottom left: colour swatches with their names
  double scale_bar = 0;  ///< bottom right: metres per picture width (parallel views); 0: none
  bool dark_background = false;
};

void add_overlay(vtkRenderer* renderer, const Overlay& overlay, int width, int height);

/// A round length (1, 2 or 5 times a power of ten) of at most a quarter of the picture's width.
double round_bar_length(double metres_across);

}  // namespace atrium::render
