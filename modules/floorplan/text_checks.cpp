#include "graph/api/text_check.hpp"
#include "modules/floorplan/write_dxf.hpp"
#include "modules/floorplan/write_geojson.hpp"
#include "modules/types/crs_name.hpp"

ATRIUM_TEXT_CHECKS({atrium::floorplan::WriteDxf::type, "crs", atrium::check_crs_name},
                   {atrium::floorplan::WriteGeojson::type, "crs", atrium::check_crs_name})
