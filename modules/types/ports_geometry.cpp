#include "modules/types/ports.hpp"

ATRIUM_PORT(, Adjacency);
ATRIUM_PORT(, Cloud);
ATRIUM_PORT(, Mesh);
ATRIUM_PORT(, Metrics);
ATRIUM_PORT(, Pictures);
ATRIUM_PORT(, PlaneMeshes);
ATRIUM_PORT(, PlanePrimitives);
ATRIUM_PORT(, Poses);
ATRIUM_PORT(, Structure);
ATRIUM_PORT(, Textures);
ATRIUM_PORT(, Transform);
