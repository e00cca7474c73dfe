#include "step.hpp"

#include <chrono>
#include <cstdio>
#include <thread>

namespace atrium::trial {

Step::Out Step::run(const In& in, const Params& params, Context& context) {
  if (params.mode == Mode::fail) throw Error("told to fail", "do not tell it");
  if (params.mode == Mode::print) std::printf("a remark of a library\n");
  if (params.mode == Mode::wait || params.mode == Mode::ignore) context.info("waiting");
  while (params.mode == Mode::wait || params.mode == Mode::ignore) {
    if (params.mode == Mode::wait) context.check_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  double sum = params.value == 0 ? context.random().uniform() : params.value;
  if (in.after) sum += *in.after;
  return {sum, "the sum is " + std::to_string(sum)};
}

}  // namespace atrium::trial
