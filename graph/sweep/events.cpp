#include "graph/sweep/events.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>

#include "graph/api/json_text.hpp"
#include "graph/run/record_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
constexpr double worth_saying = 0.01;  // of a node's work

}  // namespace

double epoch_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

Json totals_json(const ProcessTotals& totals) {
  return {{"wall", totals.wall},     {"cpu", totals.cpu},   {"peak_memory", totals.peak_memory},
          {"loaded", totals.loaded}, {"kept", totals.kept}, {"cache_problems", totals.cache_problems}};
}

ProcessTotals read_totals(const Json& json) {
  return {json.at("wall").get<double>(),
          json.at("cpu").get<double>(),
          json.at("peak_memory").get<std::uint64_t>(),
          json.at("loaded").get<std::uint64_t>(),
          json.at("kept").get<std::uint64_t>(),
          json.at("cache_problems").get<std::vector<std::string>>()};
}

void EventSink::begin() {
  write({{"e", "begin"}, {"time", epoch_seconds()}, {"host", host_name()}, {"process", ::getpid()}});
}

void EventSink::end(const RunResult& run) {
  Json event{{"e", "end"}};
  event.update(totals_json({run.wall, run.cpu, run.peak_memory, run.loaded, run.kept, run.cache_problems}));
  write(event);
}

void EventSink::started(const std::string& node) { write({{"e", "started"}, {"node", node}}); }

void EventSink::progress(const std::string& node, double share) {
  {
    const std::lock_guard lock(mutex_);
    double& said = shares_[node];
    if (!(share >= said + worth_saying)) return;
    said = share;
  }
  write({{"e", "share"}, {"node", node}, {"share", share}});
}

void EventSink::finished(const NodeRecord& node) { write({{"e", "finished"}, {"record", record_json(node)}}); }
void EventSink::described(const NodeRecord& node) { write({{"e", "described"}, {"record", record_json(node)}}); }

void EventSink::message(const std::string& node, std::string_view text, bool warning) {
  write({{"e", "said"}, {"node", node}, {"text", text}, {"warning", warning}});
}

void EventSink::write(const Json& event) {
  const std::string text = json_text(event) + "\n";
  const std::lock_guard lock(mutex_);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t size = ::write(file_, text.data() + done, text.size() - done);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return;
    done += static_cast<std::size_t>(size);
  }
}

}  // namespace atrium
