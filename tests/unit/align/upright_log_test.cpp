// What align.gravity says of each direction that may be up, in words.
#include <gtest/gtest.h>

#include <regex>

#include "modules/align/gravity.hpp"
#include "tests/support/rooms.hpp"

namespace atrium::align::upright_log_test {
namespace {

struct Host : ContextHost {
  std::vector<std::string> texts;
  void log(Level level, std::string_view text) override {
    if (level == Level::info) texts.emplace_back(text);
  }
};

TEST(UprightLog, SaysInWordsWhatSpeaksForADirection) {
  test::Rooms rooms;
  rooms.floor(0, 0, 5, 4).ceiling(0, 0, 5, 4, 2.5).walls({{0, 0}, {5, 0}, {5, 4}, {0, 4}}, 0, 0, 2.5);
  const auto host = std::make_shared<Host>();
  Context context{1, host, false};
  Gravity::run({input(rooms.planes()), {}}, {}, context);
  const std::regex line(
      "[+-][xyz] is up with [0-9.]+ %(; points for it \\(\\+\\) and against it \\(-\\): ([a-z ]+ [+-][0-9]+[.][0-9](, "
      ")?)+)?");
  int found = 0;
  for (const auto& text : host->texts) {
    if (std::regex_match(text, line)) ++found;
    EXPECT_EQ(text.find(" p 0."), std::string::npos) << text;
  }
  EXPECT_GE(found, 2) << host->texts.front();
}

}  // namespace
}  // namespace atrium::align::upright_log_test
