#pragma once
// The part of oneTBB that Atrium calls, on std::thread: for the build with ThreadSanitizer, which cannot see the
// synchronisation inside of a library that is not instrumented. tests/support/threads precedes the library's headers
// there. Not fast: a loop starts its threads anew.
#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#define ATRIUM_TESTS_HAVE_OWN_TBB 1  // graph/run/run_threads.cpp: no helpers are needed

namespace tbb {

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter /*which*/, std::size_t value) : before_(limit().exchange(value)) {}
  ~global_control() { limit() = before_; }
  global_control(const global_control&) = delete;
  global_control& operator=(const global_control&) = delete;
  static std::size_t active_value(parameter /*which*/) { return limit(); }

 private:
  static std::atomic<std::size_t>& limit() {
    static std::atomic<std::size_t> value{std::max(2U, std::thread::hardware_concurrency())};
    return value;
  }
  std::size_t before_;
};

namespace detail {

struct Arena {
  int concurrency = 0;  ///< 0: as global_control says
  int index = 0;        ///< of this thread
};
inline Arena& here() {
  thread_local Arena arena;
  return arena;
}
inline int concurrency() {
  const int all = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
  return here().concurrency > 0 ? std::min(here().concurrency, all) : all;
}

/// Calls work(index) on so many threads, this one included, and throws the first exception of any of them.
inline void on_threads(int threads, const std::function<void(int)>& work) {
  std::mutex mutex;
  std::exception_ptr first;
  const Arena arena = here();
  const auto one = [&](int index) {
    try {
      work(index);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i)
    others.emplace_back([&, i] {
      here() = {arena.concurrency, i};
      one(i);
    });
  one(arena.index);
  for (auto& thread : others) thread.join();
  if (first) std::rethrow_exception(first);
}

}  // namespace detail

class task_arena {
 public:
  explicit task_arena(int concurrency, unsigned /*reserved*/ = 1) : concurrency_(concurrency) {}
  template <class F>
  void execute(F&& work) {
    const detail::Arena before = std::exchange(detail::here(), {concurrency_, 0});
    const auto back = [&] { detail::here() = before; };
    try {
      work();
    } catch (...) {
      back();
      throw;
    }
    back();
  }

 private:
  int concurrency_;
};

namespace this_task_arena {
template <class F>
auto isolate(F&& work) {
  return work();  // a thread that waits here takes no other work anyway
}
inline int max_concurrency() { return detail::concurrency(); }
inline int current_thread_index() { return detail::here().index; }
}  // namespace this_task_arena

/// Tasks run while wait() is called, on so many threads as the arena has.
class task_group {
 public:
  template <class F>
  void run(F task) {
    const std::lock_guard lock(mutex_);
    tasks_.emplace_back(std::move(task));
    ++open_;
    change_.notify_one();
  }
  void wait() {
    detail::on_threads(detail::concurrency(), [this](int /*index*/) { work(); });
  }

 private:
  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      change_.wait(lock, [this] { return !tasks_.empty() || open_ == 0; });
      if (tasks_.empty()) return;
      try {
        const std::function<void()> task = std::move(tasks_.back());
        tasks_.pop_back();
        lock.unlock();
        task();
      } catch (...) {
        lock.lock();
        open_ -= tasks_.size() + 1;
        tasks_.clear();
        change_.notify_all();
        throw;
      }
      lock.lock();
      if (--open_ == 0) change_.notify_all();
    }
  }
  std::mutex mutex_;
  std::condition_variable change_;
  std::deque<std::function<void()>> tasks_;
  std::size_t open_ = 0;
};

template <class Index, class F>
void parallel_for(Index begin, Index end, const F& work) {
  if (begin >= end) return;
  std::atomic<Index> next = begin;
  const int threads = static_cast<int>(std::min<std::size_t>(end - begin, detail::concurrency()));
  detail::on_threads(threads, [&](int /*index*/) {
    try {
      for (Index i = next++; i < end; i = next++) work(i);
    } catch (...) {
      next = end;
      throw;
    }
  });
}

template <class It, class... Before>
void parallel_sort(It begin, It end, Before... before) {
  std::sort(begin, end, before...);
}

}  // namespace tbb
