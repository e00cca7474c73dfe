#pragma once
#include <string>
#include <vector>

#include "modules/floorplan/dxf_groups.hpp"
#include "modules/floorplan/plan_view.hpp"
#include "modules/floorplan/units.hpp"

namespace atrium::floorplan {

struct DxfLayer {
  std::string name;
  int colour = 7;        ///< AutoCAD colour index
  int line_weight = 25;  ///< hundredths of a millimetre
};

/// A block without a name of its own, which one entity shows: the lines and the text of a dimension.
struct DxfBlock {
  std::string name;  ///< "*D1"
  DxfHandle record = 0, begin = 0, end = 0;
  DxfGroups entities;  ///< their owner is `record`
};

/// Sizes of dimensions, millimetres of paper.
constexpr double dxf_extension_gap = 2, dxf_extension_over = 1, dxf_tick = 0.7, dxf_digits = 2, dxf_text_gap = 0.7;

/// What a DXF file of release 2000 holds besides its entities. Lengths in the file's coordinates and unit.
struct DxfFrame {
  std::vector<DxfLayer> layers;  ///< without "0", which each file has
  Bounds2 extents;               ///< of the entities
  Bounds2 view;                  ///< in sight when the file is opened
  DxfHandle next_handle = 0;     ///< above all that are used
  std::vector<DxfBlock> blocks;
  Units units = Units::metres;  ///< of the coordinates; inches for feet
  double mm = 0.1;              ///< units of the file that are a millimetre of paper
  std::string comment;          ///< stands at the file's beginning
};

/// The block that the entities of the drawing belong to.
constexpr DxfHandle dxf_model_space = 0x1F;
/// The dimension style that the header and dimensions name.
constexpr const char* dxf_dimension_style = "ATRIUM";
/// The first handle that entities may have, with that many layers.
DxfHandle first_entity_handle(std::size_t layers);

/// All sections before that of the entities.
DxfGroups dxf_beginning(const DxfFrame& frame);
/// The objects, and the file's end.
DxfGroups dxf_end(const DxfFrame& frame);

}  // namespace atrium::floorplan
