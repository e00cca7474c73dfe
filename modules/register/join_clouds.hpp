#pragma once
#include "graph/api/context.hpp"
#include "graph/api/node.hpp"
#include "modules/types/cloud.hpp"
#include "modules/types/poses.hpp"

namespace atrium::registration {

/// All points of the clouds, moved by their poses, in the first one's frame and origin (and with its unit and reference
/// system), with the columns that all of them have; sensors and sources as register.gicp says. Warns of what is
/// dropped.
Cloud join(const Inputs<Cloud>& clouds, const Poses& poses, const Context& context);

}  // namespace atrium::registration
