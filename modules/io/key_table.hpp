#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "modules/io/piece_vector.hpp"

namespace atrium::io {

/// Numbers keys from 0 on in the order in which they come: a hash table with open addressing that is at most three
/// quarters full. At most 2³² - 2 keys; 13 to 19 bytes each.
class KeyTable {
 public:
  /// The key's number, which is size() for a new one.
  std::uint32_t add(std::uint64_t key) {
    if (!keys_.empty() && keys_[last_] == key) return last_;  // the same key often follows
    if (4 * (keys_.size() + 1) > 3 * table_.size()) grow();
    const std::size_t at = slot(key);
    if (table_[at] == 0) {
      keys_.push_back(key);
      table_[at] = static_cast<std::uint32_t>(keys_.size());
    }
    return last_ = table_[at] - 1;
  }
  std::size_t size() const { return keys_.size(); }
  std::uint64_t key(std::size_t number) const { return keys_[number]; }
  /// Gives back what only add() needs, which must not be called again.
  void close() { table_ = {}; }

 private:
  /// Of a key, or where it would be.
  std::size_t slot(std::uint64_t key) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 20U) & mask;
    while (table_[at] != 0 && keys_[table_[at] - 1] != key) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    const std::size_t size = std::max<std::size_t>(64, 2 * table_.size());
    table_ = {};  // not both at once
    table_.resize(size, 0);
    for (std::size_t i = 0; i < keys_.size(); ++i) table_[slot(keys_[i])] = static_cast<std::uint32_t>(i + 1);
  }

  std::vector<std::uint32_t> table_;  // number plus 1; a power of two long
  PieceVector<std::uint64_t> keys_;
  std::uint32_t last_ = 0;
};

}  // namespace atrium::io
