#include "graph/api/text_check.hpp"
#include "modules/io/write_mesh.hpp"
#include "modules/types/crs_name.hpp"

ATRIUM_TEXT_CHECKS({atrium::io::WriteMesh::type, "crs", atrium::check_crs_name})
