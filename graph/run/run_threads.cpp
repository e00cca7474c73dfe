#include "graph/run/run_threads.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <new>
#include <system_error>

namespace atrium {

#ifdef ATRIUM_TESTS_HAVE_OWN_TBB  // tests/support/threads: its loops start their threads themselves

struct RunThreads::Arena {
  explicit Arena(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}
  tbb::global_control limit;
  tbb::task_arena arena;
  const int threads = tbb::this_task_arena::max_concurrency();
};

class RunThreads::Helper {};

RunThreads::RunThreads(int wanted) : arena_(std::make_unique<Arena>(wanted)) {}
int RunThreads::number() const { return arena_->threads; }

#else

/// All of its places are for threads that come by themselves, none is for oneTBB's own; and of those there is none.
struct RunThreads::Arena {
  explicit Arena(int threads)
      : none(tbb::global_control::max_allowed_parallelism, 1), arena(threads, static_cast<unsigned>(threads)) {}
  tbb::global_control none;
  tbb::task_arena arena;
};

/// A thread that waits in the arena for a task that is never run: meanwhile it takes part in all others.
class RunThreads::Helper {
 public:
  explicit Helper(tbb::task_arena& arena) : arena_(arena), open_(group_.defer([] {})) {}
  ~Helper() {
    release();
    if (running_) ::pthread_join(thread_, nullptr);
  }
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;

  /// The system's reason if it cannot be had, 0 otherwise.
  int start() {
    constexpr std::size_t stack = std::size_t{4} << 20U;  // that of oneTBB's own
    pthread_attr_t attributes;
    if (const int reason = ::pthread_attr_init(&attributes); reason != 0) return reason;
    ::pthread_attr_setstacksize(&attributes, stack);
    const int reason = ::pthread_create(&thread_, &attributes, &Helper::help, this);
    ::pthread_attr_destroy(&attributes);
    running_ = reason == 0;
    return reason;
  }
  void release() { open_ = {}; }

 private:
  static void* help(void* given) {
    auto* self = static_cast<Helper*>(given);
    try {
      self->arena_.execute([self] { self->group_.wait(); });
    } catch (...) {  // no memory to help with: the others do it
    }
    return nullptr;
  }
  tbb::task_arena& arena_;
  tbb::task_group group_;
  tbb::task_handle open_;
  pthread_t thread_{};
  bool running_ = false;
};

RunThreads::RunThreads(int wanted) : arena_(std::make_unique<Arena>(wanted)) {
  start_helpers(wanted - 1);
  if (!shortage_.empty()) shortage_ += fmt::format("; the run goes on with {} (-j)", number());
}

void RunThreads::start_helpers(int wanted) {
  while (helpers_.size() < static_cast<std::size_t>(wanted)) {
    auto helper = std::make_unique<Helper>(arena_->arena);
    const int reason = helper->start();
    if (reason == 0) {
      helpers_.push_back(std::move(helper));
      continue;
    }
    shortage_ = fmt::format("of {} threads the system gives {} only ({})", wanted + 1, number(),
                            std::generic_category().message(reason));
    for (std::size_t i = helpers_.size() / 2; i < helpers_.size(); ++i) helpers_[i]->release();
    helpers_.resize(helpers_.size() / 2);
    return;
  }
}

int RunThreads::number() const { return 1 + static_cast<int>(helpers_.size()); }

#endif

RunThreads::~RunThreads() {
#ifndef ATRIUM_TESTS_HAVE_OWN_TBB
  for (const auto& helper : helpers_) helper->release();  // all, before the first is waited for
#endif
}

void RunThreads::execute(const std::function<void()>& work) { arena_->arena.execute(work); }

}  // namespace atrium
