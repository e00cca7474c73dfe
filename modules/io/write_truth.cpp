#include "modules/io/write_truth.hpp"

#include "modules/io/truth_json.hpp"

namespace atrium::io {

void WriteTruth::run(const In& in, const Params& params, Context& context) {
  const auto target = context.output(params.path.path);
  AtomicFile file(target);
  file.write(truth_to_json(*in.truth));
  file.commit();
  context.wrote(target);
}

}  // namespace atrium::io
