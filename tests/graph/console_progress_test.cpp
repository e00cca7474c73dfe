#include "graph/run/console_progress.hpp"

#include <gtest/gtest.h>

#include <chrono>

namespace atrium::console_progress_test {
namespace {

class ConsoleProgressTest : public testing::Test {
 protected:
  ConsoleProgressTest() : file_(std::tmpfile()) { options_.stream = file_; }
  ~ConsoleProgressTest() override { std::fclose(file_); }

  std::string written() {
    std::string text(static_cast<std::size_t>(std::ftell(file_)), '\0');
    std::rewind(file_);
    text.resize(std::fread(text.data(), 1, text.size(), file_));
    return text;
  }
  // Until the ticker has written something more.
  void wait_for_tick() {
    const long before = std::ftell(file_);
    for (int i = 0; i < 10'000 && std::ftell(file_) < before + 2; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  static NodeRecord record(const std::string& node, NodeStatus status = NodeStatus::ok) {
    NodeRecord r;
    r.node = node;
    r.type = "test.type";
    r.status = status;
    r.wall = 1.5;
    r.message = "it broke";
    r.help = "mend it";
    return r;
  }
  // One node that works, one that warns, one that fails, one that is skipped.
  static void show(ConsoleProgress& progress) {
    progress.planned(4);
    progress.started("good");
    progress.progress("good", 0.5);
    progress.finished(record("good"));
    progress.started("odd");
    progress.message("odd", "3 points dropped", true);
    progress.message("odd", "a remark", false);
    progress.finished(record("odd"));
    progress.started("bad");
    progress.finished(record("bad", NodeStatus::failed));
    progress.finished(record("after", NodeStatus::skipped));
  }

  std::FILE* file_;
  ConsoleOptions options_;
};

constexpr auto failure = "error: bad (test.type): it broke\n  help: mend it\n";

TEST_F(ConsoleProgressTest, PlainLinesNameNodesAndEndWithNewlines) {
  {
    ConsoleProgress progress(options_);
    show(progress);
  }
  EXPECT_EQ(written(),
            std::string("good: 1.50 s\nwarning: odd: 3 points dropped\nodd: a remark\nodd: 1.50 s\n") + failure);
}

TEST_F(ConsoleProgressTest, QuietIsErrorsOnly) {
  options_.quiet = true;
  {
    ConsoleProgress progress(options_);
    show(progress);
  }
  EXPECT_EQ(written(), failure);
}

TEST_F(ConsoleProgressTest, ALargePipelineDoesNotListItsShortNodes) {
  {
    ConsoleProgress progress(options_);
    progress.planned(1000);
    NodeRecord brief = record("brief");
    brief.wall = 0.01;
    progress.finished(brief);
    progress.finished(record("long"));
  }
  EXPECT_EQ(written(), "long: 1.50 s\n");
}

TEST_F(ConsoleProgressTest, TheLiveLineShowsNodeAndShareFitsTheTerminalAndGoesAway) {
  options_.live = true;
  options_.tick = 0.005;
  {
    ConsoleProgress progress(options_);
    progress.planned(12);
    progress.finished(record("first"));
    progress.started("planes");
    progress.progress("planes", 0.4);
    wait_for_tick();
    for (int i = 0; i < 40; ++i) progress.started("another/node/" + std::to_string(i));
    wait_for_tick();
    wait_for_tick();
  }
  const std::string text = written();
  EXPECT_NE(text.find("\r[1/12] planes 40 %  0:0"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_TRUE(text.ends_with("\r\x1b[K"));
  std::size_t longest = 0;
  for (std::size_t at = 0, next = 0; next != std::string::npos; at = next + 1) {
    next = text.find('\r', at);
    const std::string shown = text.substr(at, next - at);
    longest = std::max(longest, shown.substr(0, shown.find('\x1b')).size());
  }
  EXPECT_EQ(longest, 79U);
}

TEST_F(ConsoleProgressTest, StillRunningNodesAreNamedInALog) {
  options_.tick = 0.005;
  {
    ConsoleProgress progress(options_);
    progress.planned(2);
    progress.started("slow");
    wait_for_tick();
  }
  EXPECT_NE(written().find("[0/2] slow 0:0"), std::string::npos);
}

TEST(ClockText, IsMinutesOrHours) {
  EXPECT_EQ(clock_text(7.4), "0:07");
  EXPECT_EQ(clock_text(59.7), "1:00");
  EXPECT_EQ(clock_text(7500), "2:05:00");
  EXPECT_EQ(clock_text(-1), "0:00");
}

}  // namespace
}  // namespace atrium::console_progress_test
