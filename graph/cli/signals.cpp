#include "graph/cli/signals.hpp"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

namespace atrium::cli {
namespace {

std::atomic<bool> cancel = false;
std::atomic<int> first_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// Only what is safe in a signal handler: lock-free atomics, write, _exit.
void handle(int signal) {
  const int number = errno;
  if (first_signal.exchange(signal) != 0) ::_exit(128 + signal);
  cancel = true;
  constexpr std::string_view text = "\natrium: ending; what is done is kept (once more: end at once)\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  errno = number;
}

/// A signal that is ignored stays so: that is how nohup and shells keep a job in the background alive.
void install(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace

CancelOnSignal::CancelOnSignal() {
  cancel = false;
  first_signal = 0;
  install(handle);
  on_pipe_ = std::signal(SIGPIPE, SIG_IGN);
}
CancelOnSignal::~CancelOnSignal() {
  install(SIG_DFL);
  std::signal(SIGPIPE, on_pipe_);
}

const std::atomic<bool>* CancelOnSignal::flag() const { return &cancel; }
int CancelOnSignal::exit_code() const { return 128 + first_signal.load(); }

}  // namespace atrium::cli
