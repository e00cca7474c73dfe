#include "graph/api/context.hpp"

#include <fcntl.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <thread>

#include "graph/api/clocks.hpp"
#include "graph/api/error.hpp"
#include "graph/api/files.hpp"

namespace atrium {
namespace {

/// Tells the host what a helping thread's piece cost (the loop's own thread is timed by who runs the node). Of pieces
/// within pieces the outermost counts.
class HelpTimer {
 public:
  HelpTimer(ContextHost& host, bool helping)
      : host_(host), helping_(helping && !inside), outermost_(!inside), start_(helping_ ? thread_cpu_seconds() : 0) {
    inside = true;
  }
  ~HelpTimer() {
    if (outermost_) inside = false;
    if (helping_) host_.helped(thread_cpu_seconds() - start_);
  }
  HelpTimer(const HelpTimer&) = delete;
  HelpTimer& operator=(const HelpTimer&) = delete;

 private:
  static thread_local bool inside;
  ContextHost& host_;
  bool helping_, outermost_;
  double start_;
};
thread_local bool HelpTimer::inside = false;

/// So that a file's new name is there after a power failure, too. Where that cannot be had, the file is whole anyway.
void flush_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

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
  const std::size_t chunks = (total - 1) / chunk + 1;
  const auto caller = std::this_thread::get_id();
  const auto one = [&](std::size_t i) {
    check_cancelled();
    const HelpTimer timer(*host_, std::this_thread::get_id() != caller);
    work(i, i * chunk, i * chunk + std::min(chunk, total - i * chunk));
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
  // Two threads, or processes of two machines, may write the same file: each has its own beside it, and the last one
  // stays. Nothing that stands there already, a link least of all, is written into.
  temporary_ = target_.parent_path() / unfinished_file_name(target_.filename().string());
  const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor >= 0) file_ = ::fdopen(descriptor, "wb");
  if (file_ != nullptr) return;
  const int reason = errno;
  if (descriptor >= 0) {
    ::close(descriptor);
    ::unlink(temporary_.c_str());
  }
  throw Error("cannot write " + target_.string() + ": " + std::strerror(reason));
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
  if (flush) flush_folder(target_.parent_path());
}

}  // namespace atrium
