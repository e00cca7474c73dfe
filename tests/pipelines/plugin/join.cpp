#include "join.hpp"

namespace atrium::trial {

Join::Out Join::run(const In& in, const Params& /*params*/, Context& /*context*/) {
  return {static_cast<double>(in.a->points.size() + in.b->points.size())};
}

}  // namespace atrium::trial
