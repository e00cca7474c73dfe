#pragma once
#include <cstdint>
#include <mutex>
#include <optional>

namespace atrium {

/// Finds out how much memory a node needs. The system tells of the process as a whole only, so it is known of a node
/// that runs alone from its beginning to its end, and of no other.
class MemoryWatch {
 public:
  /// A node begins; to be handed to end().
  std::size_t begin();
  /// How far the process's memory rose above what was there when the node began; nothing if anything else went on
  /// meanwhile.
  std::optional<std::uint64_t> end(std::size_t node);
  /// Something else takes memory, or gives it back.
  void disturb();
  /// Peak resident memory of the process up to the most recent counter reset.
  std::uint64_t peak_before();

 private:
  std::mutex mutex_;
  std::size_t running_ = 0;
  std::size_t number_ = 0;  ///< of nodes that began
  std::size_t alone_ = 0;   ///< the node that is alone since its beginning; 0: none is
  std::uint64_t before_ = 0, peak_ = 0;
};

}  // namespace atrium
