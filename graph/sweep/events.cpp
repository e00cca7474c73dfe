#include "graph/sweep/events.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>

#include "graph/api/json_fields.hpp"
#include "graph/api/json_text.hpp"
#include "graph/api/text.hpp"
#include "graph/run/node_json.hpp"

namespace atrium {
namespace {

using Json = nlohmann::ordered_json;
constexpr double worth_saying = 0.01;  // of a node's work
constexpr std::tuple totals_of_run{json_field("wall", &RunResult::wall),
                                   json_field("cpu", &RunResult::cpu),
                                   json_field("peak_memory", &RunResult::peak_memory),
                                   json_field("loaded", &RunResult::loaded),
                                   json_field("kept", &RunResult::kept),
                                   json_field("cache_problems", &RunResult::cache_problems)};

}  // namespace

double epoch_seconds() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

RunResult read_totals(const Json& event) {
  RunResult totals;
  read_fields(event, totals, totals_of_run);
  return totals;
}

void EventSink::begin() {
  write({{"e", "begin"}, {"time", epoch_seconds()}, {"host", host_name()}, {"process", ::getpid()}});
}

void EventSink::end(const RunResult& run) {
  Json event{{"e", "end"}};
  event.update(fields_json(run, totals_of_run));
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

void EventSink::finished(const NodeRecord& node) { write({{"e", "finished"}, {"record", whole_node_json(node)}}); }
void EventSink::described(const NodeRecord& node) { write({{"e", "described"}, {"record", whole_node_json(node)}}); }

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
