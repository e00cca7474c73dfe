#include "modules/io/write_truth.hpp"

#include "graph/api/write_output.hpp"
#include "modules/io/truth_json.hpp"

namespace atrium::io {

void WriteTruth::run(const In& in, const Params& params, Context& context) {
  write_output(context, params.path.path, truth_to_json(*in.truth));
}

}  // namespace atrium::io
