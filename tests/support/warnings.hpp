#pragma once
#include <memory>
#include <string>
#include <vector>

#include "graph/api/context.hpp"

namespace atrium::test {

/// A context that keeps the warnings.
class Warnings {
 public:
  Context& context() { return context_; }
  const std::vector<std::string>& texts() const { return host_->texts; }

 private:
  struct Host : ContextHost {
    void log(Level level, std::string_view text) override {
      if (level == Level::warning) texts.emplace_back(text);
    }
    std::vector<std::string> texts;
  };
  std::shared_ptr<Host> host_ = std::make_shared<Host>();
  Context context_{1, host_, false};
};

}  // namespace atrium::test
