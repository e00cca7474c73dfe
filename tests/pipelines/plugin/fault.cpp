#include "fault.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

namespace atrium::trial {
namespace {

void flood() {
  const std::string line(9999, 'x');
  for (int i = 0; i < 10'000; ++i) std::fprintf(stderr, "%s\n", line.c_str());
}

void devour(Context& context) {
  std::vector<std::vector<char>> taken;
  while (taken.size() < 100) {
    taken.emplace_back(10'000'000, 'x');
    context.check_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

Fault::Out Fault::run(const In& in, const Params& params, Context& context) {
  if (params.mode == Mode::abort) std::abort();
  if (params.mode == Mode::segv) std::raise(SIGSEGV);
  if (params.mode == Mode::exit) std::_Exit(7);
  if (params.mode == Mode::devour) devour(context);
  if (params.mode == Mode::flood) flood();
  if (params.mode == Mode::hang) context.info("hanging");
  while (params.mode == Mode::hang) {
    context.check_cancelled();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(params.work));
  Out out;
  const Eigen::Vector3f first = in.after ? in.after->points.front() : Eigen::Vector3f::Zero();
  for (std::int64_t i = 0; i < params.points; ++i) {
    out.cloud.points.emplace_back(first + Eigen::Vector3f(static_cast<float>(i), static_cast<float>(params.number), 1));
    out.sum += out.cloud.points.back().y();
  }
  if (params.mode == Mode::fickle)
    out.cloud.points.back().z() =
        static_cast<float>(std::chrono::steady_clock::now().time_since_epoch().count() % 1000003);
  if (params.mode == Mode::nan) out.sum = std::nan("");
  return out;
}

}  // namespace atrium::trial
