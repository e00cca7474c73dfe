#pragma once
#include "modules/types/mesh.hpp"

namespace atrium::scene {

/// The objects with every column that a structure has, so that both can be one mesh; colours of their own, else those
/// of the class. Without `colours` none.
Mesh objects_of(const Mesh& objects, bool colours);

/// Both in one, relative to a's origin. They have the same columns.
Mesh joined(Mesh a, const Mesh& b);

}  // namespace atrium::scene
