#include "modules/types/ports.hpp"

ATRIUM_PORT(, Building);
ATRIUM_PORT(, CellComplex);
ATRIUM_PORT(, FloorPlan);
ATRIUM_PORT(, GroundTruth);
ATRIUM_PORT(, SimulatedScene);
