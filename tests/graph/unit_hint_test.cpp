#include <gtest/gtest.h>

#include "graph/api/error.hpp"
#include "graph/api/parameter.hpp"

namespace atrium::unit_hint_test {
namespace {

std::string help_for(const std::string& text) {
  ParamInfo info;
  info.name = "size";
  info.kind = ParamKind::number;
  info.unit = metres;
  info.initial = 1.0;
  try {
    parse_param(info, {{text}, false, false});
  } catch (const Error& error) {
    return error.help();
  }
  return "nothing is wrong";
}

TEST(UnitHint, IsForTheSameLettersAndForWordsOnly) {
  EXPECT_TRUE(help_for("2 kg").starts_with("units of a length: ")) << help_for("2 kg");
  EXPECT_TRUE(help_for("2 s m").starts_with("units of a length: ")) << help_for("2 s m");
  EXPECT_TRUE(help_for("2 CM").starts_with("did you mean 'cm'? units of a length: ")) << help_for("2 CM");
}

}  // namespace
}  // namespace atrium::unit_hint_test
