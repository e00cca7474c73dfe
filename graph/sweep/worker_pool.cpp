#include "graph/sweep/worker_pool.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "graph/api/clocks.hpp"
#include "graph/api/error.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/suggest.hpp"
#include "graph/cache/upkeep.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
constexpr double grace = 5;  // seconds between asking a worker to end and ending it
constexpr int tick_milliseconds = 20;

/// "x/y" of "ID/x/y".
std::string address(const std::string& node) { return node.substr(node.find('/') + 1); }

/// The error that a worker ended with.
std::string said(const std::string& printed) {
  constexpr std::string_view mark = "atrium: error: ";
  const auto at = printed.rfind(mark);
  if (at == std::string::npos) return {};
  const std::string text = printed.substr(at + mark.size());
  return ": " + text.substr(0, text.find('\n'));
}

}  // namespace

struct WorkerPool::Worker {
  PoolTask task;
  WorkerProcess process;
  double start, clock;
  std::set<std::string> nodes = {};  ///< that run
  bool whole = false, killed_for_others = false, asked_to_end = false;
  std::string killed = {};                     ///< why, if we did
  std::optional<std::uint64_t> expected = {};  ///< memory; nothing: it is to be alone
  std::uint64_t memory = 0;

  Worker(PoolTask given, int threads)
      : task(std::move(given)), process(task.command(threads)), start(wall_seconds()), clock(start) {}
};

WorkerPool::WorkerPool(PoolOptions options, OnEvent on_event, OnEnd on_end)
    : options_(options), on_event_(std::move(on_event)), on_end_(std::move(on_end)) {
  if (options_.threads <= 0) options_.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  most_ = static_cast<std::size_t>(options_.threads);
}

WorkerPool::~WorkerPool() = default;

bool WorkerPool::cancelled() const { return options_.cancel != nullptr && options_.cancel->load(); }

void WorkerPool::add(PoolTask task) { waiting_.push_back(std::move(task)); }

void WorkerPool::run() {
  while (true) {
    start_what_fits();
    if (running_.empty()) return;
    wait();
    if (cancelled() && cancelled_at_ == 0) {
      cancelled_at_ = wall_seconds();
      for (const auto& worker : running_) worker->asked_to_end = worker->process.terminate();
    }
    if (options_.memory > 0) check_memory();
    for (const auto& worker : running_) check(*worker);
    // Some have ended: their places are taken before others hear of it.
    for (std::size_t i = 0; i < running_.size();) {
      if (!running_[i]->process.ended()) {
        ++i;
        continue;
      }
      const std::unique_ptr<Worker> ended = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      end(*ended);
    }
    if (on_tick) on_tick();
  }
}

void WorkerPool::start_what_fits() {
  const bool stopping = cancelled() || (options_.stop != nullptr && options_.stop->load());
  if (stopping) return;
  for (auto task = waiting_.begin(); task != waiting_.end() && running_.size() < most_;) {
    if (!fits(*task)) {
      ++task;
      continue;
    }
    PoolTask next = std::move(*task);
    waiting_.erase(task);
    start(std::move(next));
    task = waiting_.begin();
  }
}

bool WorkerPool::fits(const PoolTask& task) const {
  if (running_.empty() || options_.memory == 0) return true;
  const auto expected = task.memory();
  if (task.alone || !expected) return false;
  std::uint64_t needed = *expected;
  for (const auto& worker : running_) {
    if (!worker->expected) return false;
    needed += std::max(*worker->expected, worker->memory);
  }
  return needed <= options_.memory;
}

void WorkerPool::start(PoolTask task) {
  const auto places = std::min(static_cast<std::size_t>(options_.threads), running_.size() + waiting_.size() + 1);
  task.place = 0;
  const auto taken = [&](const auto& worker) { return worker->task.place == task.place; };
  while (std::any_of(running_.begin(), running_.end(), taken)) ++task.place;
  const auto expected = task.alone ? std::nullopt : task.memory();
  try {
    running_.push_back(std::make_unique<Worker>(task, std::max(1, options_.threads / static_cast<int>(places))));
    running_.back()->expected = expected;
  } catch (const Error& error) {
    if (!try_again()) throw;
    refused(std::move(task), error.what());
  }
}

/// Whether it makes sense after a process was refused: when one of ours ends there is room; others' may end soon.
bool WorkerPool::try_again() {
  if (cancelled()) return false;
  if (!running_.empty()) return true;
  constexpr std::size_t most_refusals = 10;
  if (++refusals_alone_ > most_refusals) return false;
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return true;
}

void WorkerPool::refused(PoolTask task, const std::string& why) {
  most_ = std::max<std::size_t>(running_.size(), 1);
  on_event_(task, {{"e", "said"},
                   {"node", ""},
                   {"text", fmt::format("{}: {} run side by side from here on (-j)", why, most_)},
                   {"warning", true}});
  waiting_.push_front(std::move(task));
}

void WorkerPool::wait() const {
  std::vector<pollfd> files;
  for (const auto& worker : running_)
    for (const int file : worker->process.files())
      if (file >= 0) files.push_back({file, POLLIN, 0});
  ::poll(files.data(), files.size(), tick_milliseconds);
}

void WorkerPool::read(Worker& worker) {
  for (const auto& line : worker.process.read()) {
    const Json event = read_json(line);
    if (!event.is_object()) continue;
    const std::string kind = event.value("e", "");
    worker.whole = worker.whole || kind == "end";
    if (kind == "started") worker.nodes.insert(event.value("node", ""));
    if (kind == "finished") {
      worker.nodes.erase(event.at("record").value("node", ""));
      if (worker.task.timed_by_node) worker.clock = wall_seconds();
    }
    on_event_(worker.task, event);
  }
}

void WorkerPool::check(Worker& worker) {
  read(worker);
  const double now = wall_seconds();
  if (options_.timeout > 0 && now - worker.clock > options_.timeout && worker.killed.empty()) {
    worker.killed = fmt::format("ended after {:g} s (--timeout)", options_.timeout);
    worker.process.end();
  }
  if (cancelled_at_ > 0 && !worker.asked_to_end) worker.asked_to_end = worker.process.terminate();
  if (cancelled_at_ > 0 && now - cancelled_at_ > grace) worker.process.end();
}

/// Ends the last worker that was started if all of them hold too much.
void WorkerPool::check_memory() {
  std::uint64_t sum = 0;
  for (const auto& worker : running_) sum += worker->memory = worker->process.memory();
  if (sum <= options_.memory) return;
  Worker& last = *running_.back();
  if (!last.killed.empty() || last.killed_for_others) return;
  if (running_.size() > 1)
    last.killed_for_others = true;
  else
    last.killed = fmt::format("ended when it held {} of memory (--mem)", size_text(last.memory));
  last.process.end();
}

void WorkerPool::end(Worker& worker) {
  read(worker);  // the rest of what it said
  const int failure = worker.process.failure();
  const std::string no_start = "cannot start a process: " + std::generic_category().message(failure);
  if ((failure == EAGAIN || failure == ENOMEM) && try_again()) return refused(std::move(worker.task), no_start);
  const int status = *worker.process.ended();
  const bool done = worker.whole && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (worker.killed_for_others && !done && cancelled_at_ == 0) {
    worker.task.alone = true;
    waiting_.push_back(std::move(worker.task));
    return;
  }
  PoolEnd end;
  end.how = done ? PoolEnd::How::done : cancelled_at_ > 0 ? PoolEnd::How::cancelled : PoolEnd::How::crashed;
  end.printed = worker.process.printed();
  end.nodes.assign(worker.nodes.begin(), worker.nodes.end());
  end.reason = !worker.killed.empty() ? worker.killed : failure != 0 ? no_start : how_ended(status);
  if (worker.killed.empty() && WIFEXITED(status)) end.reason += said(end.printed);
  if (worker.killed.empty() && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
    end.reason += ", perhaps by the system for lack of memory";
  std::vector<std::string> names;
  for (const auto& node : end.nodes) names.push_back(address(node));
  end.message = end.reason;
  if (!names.empty()) end.message += fmt::format(" in node {}", fmt::join(names, " or "));
  on_end_(worker.task, end);
}

}  // namespace atrium
