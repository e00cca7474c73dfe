#include "graph/api/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace atrium {
namespace {

/// Damerau's distance in its restricted form (no piece is edited twice); more than `limit` is given as limit + 1.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t longer = std::max(a.size(), b.size());
  const std::size_t shorter = std::min(a.size(), b.size());
  if (longer - shorter > limit) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > limit) return limit + 1;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest_word = 80;
  if (word.empty() || word.size() > longest_word) return {};
  // A third of the letters may be wrong, and one in a short word.
  std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;
  std::string result;
  for (const auto& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate, best - 1);
    if (distance >= best || distance >= std::max(word.size(), candidate.size())) continue;
    best = distance;
    result = candidate;
    if (best == 0) break;
  }
  if (!result.empty() || word.size() < 3) return result;
  // An abbreviation or a part of a longer name: 'dist' for 'distance'.
  for (const auto& candidate : candidates)
    if (candidate.size() > word.size() && candidate.find(word) != std::string::npos) return candidate;
  return result;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string found = nearest(word, candidates);
  return found.empty() ? std::string{} : fmt::format("did you mean '{}'?", found);
}

std::string join_words(const std::vector<std::string>& words, std::size_t limit) {
  std::string text;
  for (std::size_t i = 0; i < std::min(limit, words.size()); ++i) {
    if (i > 0) text += ", ";
    text += words[i];
  }
  if (words.size() > limit) text += fmt::format(", … ({} more)", words.size() - limit);
  return text;
}

}  // namespace atrium
