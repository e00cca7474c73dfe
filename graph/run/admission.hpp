#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "graph/run/runner.hpp"

namespace atrium {

/// Lets a node run only if what runs already leaves it the memory that it will probably need: what is resident, or was
/// when nothing ran plus what the running nodes were expected to need, whichever is more. A node alone always may; one
/// of which nothing is known waits until it is alone. Not safe to use from several threads.
class Admission {
 public:
  Admission(std::uint64_t limit, const std::function<std::optional<std::uint64_t>(const PipelineNode&)>& estimate)
      : limit_(limit), estimate_(estimate) {}
  /// False: `later` gives it back when another node is done.
  bool admit(std::size_t n, const PipelineNode& node);
  /// The node is done; `growth`: what it needed, if that is known.
  void done(std::size_t n, const std::string& type, std::optional<std::uint64_t> growth);
  /// The nodes that were refused; they may try again.
  std::vector<std::size_t> later();

 private:
  std::uint64_t limit_;
  const std::function<std::optional<std::uint64_t>(const PipelineNode&)>& estimate_;
  std::map<std::size_t, std::uint64_t> running_;  ///< node: what it is expected to need
  std::uint64_t reserved_ = 0, idle_ = 0;
  std::map<std::string, std::uint64_t> learned_;  ///< by type: the most that a node of this run needed
  std::vector<std::size_t> refused_;
};

}  // namespace atrium
