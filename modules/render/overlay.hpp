#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/render/point_colours.hpp"
#include "modules/types/cloud.hpp"

class vtkRenderer;

namespace atrium::render {

/// Words and marks on top of a picture. Sizes are in pixels of the picture.
struct Overlay {
  std::string title;                                   ///< top left
  std::vector<std::pair<std::string, Colour>> legend;  ///< bottom left: colour swatches with their names
  double scale_bar = 0;                ///< bottom right: metres per picture width (parallel views); 0: none
  std::optional<ColourScale> colours;  ///< right: what the colours of points mean
  double text_size = 1 / 45.0;         ///< height of a line, as a share of the picture's height
  bool dark_background = false;
};

/// The width that a colour bar takes at the right, in lines of text.
inline constexpr double colour_bar_width = 8.5;

/// What the title and the legend cover, pixels from the lower left corner.
std::vector<Eigen::AlignedBox2d> plates_of(const Overlay& overlay, int width, int height);

/// `front` is a renderer of a layer above that of the picture: marks of one layer hide each other's overlaps.
void add_overlay(vtkRenderer* picture, vtkRenderer* front, const Overlay& overlay, int width, int height);

/// A round length (1, 2 or 5 times a power of ten) of at most a quarter of the picture's width.
double round_bar_length(double metres_across);

/// How a colour bar counts lengths: the unit that suits its range, and round marks within it.
struct BarMarks {
  std::string unit;  ///< "mm", "cm" or "m"
  double factor;     ///< how many of it are a metre
  std::vector<double> values;
};
BarMarks bar_marks(double low, double high);

}  // namespace atrium::render
