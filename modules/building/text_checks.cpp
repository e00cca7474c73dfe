#include "graph/api/text_check.hpp"
#include "modules/building/write_cityjson.hpp"
#include "modules/building/write_ifc.hpp"
#include "modules/types/crs_name.hpp"

ATRIUM_TEXT_CHECKS({atrium::building::WriteCityjson::type, "crs", atrium::check_crs_name},
                   {atrium::building::WriteIfc::type, "crs", atrium::check_crs_name})
