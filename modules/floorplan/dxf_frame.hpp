#pragma once
#include <string>
#include <vector>

#include "modules/floorplan/dxf_groups.hpp"
#include "modules/floorplan/plan_view.hpp"

namespace atrium::floorplan {

struct DxfLayer {
  std::string name;
  int colour = 7;        ///< AutoCAD colour index
  int line_weight = 25;  ///< hundredths of a millimetre
};

/// What a DXF file of release 2000 holds besides its entities. Lengths in metres, in the file's coordinates.
struct DxfFrame {
  std::vector<DxfLayer> layers;  ///< without "0", which each file has
  Bounds2 extents;               ///< of the entities
  Bounds2 view;                  ///< in sight when the file is opened
  DxfHandle next_handle = 0;     ///< above all that are used
};

/// The block that the entities of the drawing belong to.
constexpr DxfHandle dxf_model_space = 0x1F;
/// The first handle that entities may have, with that many layers.
DxfHandle first_entity_handle(std::size_t layers);

/// All sections before that of the entities.
DxfGroups dxf_beginning(const DxfFrame& frame);
/// The objects, and the file's end.
DxfGroups dxf_end(const DxfFrame& frame);

}  // namespace atrium::floorplan
