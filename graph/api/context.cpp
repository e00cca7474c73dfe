#include "graph/api/context.hpp"

#include <fcntl.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>

#include "graph/api/error.hpp"

namespace atrium {
namespace {

double cpu_seconds_of_thread() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Tells the host what a helping thread's piece cost (the loop's own thread is timed by who runs the node).
class HelpTimer {
 public:
  HelpTimer(ContextHost& host, bool helping)
      : host_(host), helping_(helping), start_(helping ? cpu_seconds_of_thread() : 0) {}
  ~HelpTimer() {
    if (helping_) host_.helped(cpu_seconds_of_thread() - start_);
  }
  HelpTimer(const HelpTimer&) = delete;
  HelpTimer& operator=(const HelpTimer&) = delete;

 private:
  ContextHost& host_;
  bool helping_;
  double start_;
};

}  // namespace

std::uint64_t Context::seed() const {
  if (!random_)
    throw Error("the node type draws randomness but does not say so",
                "add `static constexpr bool random = true;` to its struct");
  return seed_;
}

void Context::parallel_chunks(std::size_t total, std::size_t size,
                              const std::function<void(std::size_t, std::size_t, std::size_t)>& work) const {
  if (total == 0) return;
  const std::size_t chunk = std::max<std::size_t>(size, 1);
  const std::size_t chunks = (total + chunk - 1) / chunk;
  const auto caller = std::this_thread::get_id();
  const auto one = [&](std::size_t i) {
    check_cancelled();
    const HelpTimer timer(*host_, std::this_thread::get_id() != caller);
    work(i, i * chunk, std::min(total, (i + 1) * chunk));
  };
  if (chunks == 1) {
    one(0);
    return;
  }
  // Isolated: a thread that waits here must not pick up another node's work.
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, chunks, one); });
}

void Context::parallel_for(std::size_t total, const std::function<void(std::size_t, std::size_t)>& work,
                           std::size_t size) const {
  parallel_chunks(total, size, [&](std::size_t, std::size_t begin, std::size_t end) { work(begin, end); });
}

void Context::check_cancelled() const {
  if (cancelled()) throw Cancelled();
}

std::filesystem::path Context::output(const std::string& relative) const {
  std::filesystem::path target = std::filesystem::absolute(host_->output_folder() / relative);
  std::error_code error;
  std::filesystem::create_directories(target.parent_path(), error);
  if (error) throw Error("cannot make the folder " + target.parent_path().string() + ": " + error.message());
  return target;
}

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
  // Two threads, or two processes, may write the same file: each has its own beside it, and the last one stays.
  static std::atomic<std::uint64_t> number = 0;
  temporary_ = target_.parent_path() / ("." + target_.filename().string() + "." + std::to_string(::getpid()) + "-" +
                                        std::to_string(++number) + ".part");
  file_ = std::fopen(temporary_.c_str(), "wb");
  if (file_ == nullptr) throw Error("cannot write " + target_.string() + ": " + std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (file_ != nullptr) std::fclose(file_);
  std::error_code ignored;
  if (!done_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::write(const void* data, std::size_t size) {
  if (size > 0 && std::fwrite(data, 1, size, file_) != size)
    throw Error("cannot write " + target_.string() + ": " + std::strerror(errno));
}

void AtomicFile::publish(bool flush) {
  const bool flushed = std::fflush(file_) == 0 && (!flush || ::fsync(::fileno(file_)) == 0);
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!flushed || !closed) throw Error("cannot write " + target_.string() + ": " + std::strerror(errno));
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) throw Error("cannot write " + target_.string() + ": " + error.message());
  done_ = true;
}

}  // namespace atrium
