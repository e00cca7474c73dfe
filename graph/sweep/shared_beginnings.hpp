#pragma once
#include "graph/sweep/worker.hpp"

namespace atrium {

/// What several of the wanted variants need and `cached` does not hold (by node of the merged graph), as tasks that do
/// not need each other.
std::vector<WorkerTask> shared_beginnings(const SweepPlan& plan, const std::vector<bool>& wanted,
                                          const std::vector<bool>& cached);

}  // namespace atrium
