#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace atrium {

/// The candidate that a mistyped word most likely meant (fewest insertions, deletions, replacements and swaps of
/// neighbouring letters; the first of equals), or "" when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "did you mean 'x'?", or "" when nothing is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// word(item) for each item: candidates from a table.
template <class Items, class F>
std::vector<std::string> words_of(const Items& items, F word) {
  std::vector<std::string> words;
  words.reserve(items.size());
  for (const auto& item : items) words.push_back(word(item));
  return words;
}

/// "a, b, c": at most `limit` of the words, then how many more there are.
std::string join_words(const std::vector<std::string>& words, std::size_t limit = 12);

}  // namespace atrium
