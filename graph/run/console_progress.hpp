#pragma once
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "graph/run/runner.hpp"

namespace atrium {

struct ConsoleOptions {
  std::FILE* stream = stderr;
  bool live = false;    ///< one line that is drawn again and again; otherwise plain lines only
  bool colour = false;  ///< warnings and errors stand out
  bool quiet = false;   ///< errors only
  double tick = 0;      ///< seconds between two drawings (live) or two "still running" lines; 0: 0.1 or 10
};

/// For the stream as it is: live on a terminal that can move its cursor, colours there unless NO_COLOR is set.
ConsoleOptions console_options(std::FILE* stream, bool quiet);

/// Tells a person on a terminal (or the reader of a log) how far a run is:
///   live:  [12/25] planes 40 %, normals  0:12, about 0:30 left
///   plain: "planes: 1.24 s" when a node is done (in a pipeline of more than 200 nodes: if it took a second), and every
///          10 s what is still running.
/// Warnings, texts and failures of nodes are lines of their own, with the node's path. A warning that many nodes give
/// is printed once; at the end a line says how often it was given.
class ConsoleProgress final : public ProgressSink {
 public:
  explicit ConsoleProgress(ConsoleOptions options);
  ~ConsoleProgress() override;  ///< takes the live line away
  ConsoleProgress(const ConsoleProgress&) = delete;
  ConsoleProgress& operator=(const ConsoleProgress&) = delete;

  void planned(std::size_t nodes) override;
  void started(const std::string& node) override;
  void progress(const std::string& node, double share) override;
  void finished(const NodeRecord& node) override;
  void reopened(const std::string& node) override;
  void message(const std::string& node, std::string_view text, bool warning) override;

 private:
  struct Running {
    double start = 0, share = 0;
  };
  void tick();
  // With mutex_ held:
  void line(const std::string& text);
  void draw();
  void erase();
  std::string running_nodes() const;
  std::string painted(std::string_view text, std::string_view colour) const;

  ConsoleOptions options_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ended_ = false, drawn_ = false;
  double start_;
  std::size_t nodes_ = 0, done_ = 0;
  std::map<std::string, Running> running_;
  std::map<std::string, std::size_t> warnings_;  ///< how often each was given, whatever node gave it
  std::thread ticker_;
};

/// "0:07", "12:30", "2:05:00".
std::string clock_text(double time);

}  // namespace atrium
