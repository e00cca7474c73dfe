#include "write.hpp"

namespace atrium::trial {

Write::Out Write::run(const In& in, const Params& params, Context& context) {
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  file.write(std::to_string(*in.value) + "\n");
  file.commit();
  context.wrote(target);
  context.warn("only one number");
  return {};
}

}  // namespace atrium::trial
