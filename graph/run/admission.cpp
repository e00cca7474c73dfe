#include "graph/run/admission.hpp"

#include <algorithm>
#include <utility>

#include "graph/run/clocks.hpp"

namespace atrium {

bool Admission::admit(std::size_t n, const PipelineNode& node) {
  if (limit_ == 0) return true;
  std::optional<std::uint64_t> need = estimate_ ? estimate_(node) : std::nullopt;
  if (const auto known = learned_.find(node.type->type); !need && known != learned_.end()) need = known->second;
  const std::uint64_t expected = need.value_or(limit_);
  const std::uint64_t resident = resident_memory();
  if (running_.empty())
    idle_ = resident;
  else if (std::max(resident, idle_ + reserved_) + expected > limit_) {
    refused_.push_back(n);
    return false;
  }
  running_.emplace(n, expected);
  reserved_ += expected;
  return true;
}

void Admission::done(std::size_t n, const std::string& type, std::optional<std::uint64_t> growth) {
  if (limit_ == 0) return;
  const auto found = running_.find(n);
  if (found == running_.end()) return;
  reserved_ -= found->second;
  running_.erase(found);
  if (!growth) return;
  std::uint64_t& known = learned_[type];
  known = std::max(known, *growth);
}

std::vector<std::size_t> Admission::later() { return std::exchange(refused_, {}); }

}  // namespace atrium
