#pragma once
#include "modules/baseline/exchange.hpp"

namespace atrium::baseline {

/// What the helper program computes; why it cannot goes into reply.text.
Exchange computed(const Exchange& request);

}  // namespace atrium::baseline
