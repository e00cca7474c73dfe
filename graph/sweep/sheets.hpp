#pragma once
#include "graph/sweep/run.hpp"

namespace atrium {

/// Draws the sweep's sheets (`pictures:`): one picture of every variant with its label, by the node types
/// render.read_pictures and render.contact_sheet. A variant without its picture has an empty cell that says so. Returns
/// what went wrong.
std::vector<std::string> write_sheets(const SweepFile& sweep, const SweepPlan& plan,
                                      const std::vector<VariantResult>& results, Registry& registry,
                                      const SweepOptions& options);

}  // namespace atrium
