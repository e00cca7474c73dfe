#pragma once
#include <stdexcept>
#include <string>
#include <utility>

namespace atrium {

/// What a node, reader or writer throws when it cannot give a right result: what is wrong and where (file, line, byte
/// offset), and in `help` what would be right. The runner adds the node's path.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, std::string help = {})
      : std::runtime_error(message), help_(std::move(help)) {}
  const std::string& help() const { return help_; }

 private:
  std::string help_;
};

/// Thrown by Context::check_cancelled when the user has asked the run to end. Nodes let it pass.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace atrium
