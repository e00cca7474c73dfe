#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "graph/api/context.hpp"
#include "tests/support/temporary_folder.hpp"

namespace atrium::test {

/// Lets a node write into a folder of its own, and keeps what it warns of.
class WritingHost : public ContextHost {
 public:
  TemporaryFolder folder;
  std::vector<std::string> warnings;
  std::filesystem::path output_folder() override { return folder.path(); }
  void log(Level level, std::string_view text) override {
    if (level == Level::warning) warnings.emplace_back(text);
  }
};

}  // namespace atrium::test
