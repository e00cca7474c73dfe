#pragma once
#include <atomic>

namespace atrium::cli {

/// While it lives, SIGINT and SIGTERM ask the run to end; a second one ends the program at once. A signal that is
/// ignored when the program begins stays so. A reader of stdout or stderr that ends (SIGPIPE) does not end the run.
class CancelOnSignal {
 public:
  CancelOnSignal();
  ~CancelOnSignal();
  CancelOnSignal(const CancelOnSignal&) = delete;
  CancelOnSignal& operator=(const CancelOnSignal&) = delete;

  const std::atomic<bool>* flag() const;
  /// What the program returns when a signal ended the run: 130 or 143.
  int exit_code() const;

 private:
  void (*on_pipe_)(int);  ///< what SIGPIPE did before
};

}  // namespace atrium::cli
