#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace atrium::baseline {

/// A priority queue of very many entries, least first, of which most are out of date before their turn comes. Only the
/// band of the least is kept as a heap, small enough for the processor's cache; what comes later lies beside it without
/// order until the band is used up, and now and then is rid of what is out of date. Entries come out in exactly the
/// order of a heap of all of them, if operator< is a total order.
template <class Entry>
class BandedQueue {
 public:
  explicit BandedQueue(std::size_t least_band = 16384) : least_band_(least_band) {}

  void clear() {
    band_.clear();
    later_.clear();
    reach_ = Reach::nothing;
  }
  void push(const Entry& entry) {
    if (reach_ == Reach::nothing || (reach_ == Reach::bound && bound_ < entry)) {
      later_.push_back(entry);
      return;
    }
    band_.push_back(entry);
    std::push_heap(band_.begin(), band_.end(), After());
  }
  /// Takes the least entry for which is_current(entry) holds, and drops those before it; false if there is none.
  template <class IsCurrent>
  bool pop(Entry& entry, IsCurrent is_current) {
    while (!band_.empty() || next_band(is_current)) {
      entry = band_.front();
      std::pop_heap(band_.begin(), band_.end(), After());
      band_.pop_back();
      if (is_current(entry)) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t bands = 16, bands_between_looks = 4;
  enum class Reach { nothing, bound, everything };  ///< of the band
  struct After {
    bool operator()(const Entry& a, const Entry& b) const { return b < a; }
  };

  template <class IsCurrent>
  bool next_band(IsCurrent is_current) {
    if (bands_begun_++ % bands_between_looks == 0)
      std::erase_if(later_, [&](const Entry& entry) { return !is_current(entry); });
    if (later_.empty()) {
      reach_ = Reach::nothing;
      return false;
    }
    const std::size_t size = std::min(later_.size(), std::max(least_band_, later_.size() / bands));
    const auto first = later_.end() - static_cast<std::ptrdiff_t>(size);
    reach_ = first == later_.begin() ? Reach::everything : Reach::bound;
    if (reach_ == Reach::bound) std::nth_element(later_.begin(), first, later_.end(), After());
    bound_ = *first;  // the greatest of the band
    band_.assign(first, later_.end());
    later_.erase(first, later_.end());
    std::make_heap(band_.begin(), band_.end(), After());
    return true;
  }

  std::vector<Entry> band_;   // a heap
  std::vector<Entry> later_;  // in no order, all after the bound
  Entry bound_{};
  Reach reach_ = Reach::nothing;
  std::size_t least_band_, bands_begun_ = 0;
};

}  // namespace atrium::baseline
