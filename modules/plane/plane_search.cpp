#include "modules/plane/plane_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrium::plane {
namespace {

constexpr std::uint32_t finest_sampled_level =
    4;  // cells of 8 times `distance`: smaller ones hold more noise than plane
constexpr std::size_t least_batch = 256;
constexpr std::size_t largest_batch = 4096;
constexpr std::uint64_t batch_streams = 1U << 20U;  // below: streams of the divisions
constexpr int competitions = 16;

}  // namespace

PlaneSearch::PlaneSearch(const MortonOrder& order, const Connectivity& connectivity, const Settings& settings,
                         const Context& context)
    : order_(order),
      connectivity_(connectivity),
      settings_(settings),
      min_points_(static_cast<double>(settings.min_points)),
      context_(context),
      owner_(order.index.size(), -1) {
  if (settings_.max_planes == 0) settings_.max_planes = std::numeric_limits<std::size_t>::max();
}

std::vector<Patch> PlaneSearch::run() {
  divide();
  std::vector<Patch> patches;
  const auto all = static_cast<double>(subsets_->live());
  while (patches.size() < settings_.max_planes && static_cast<double>(subsets_->live()) >= min_points_) {
    context_.check_cancelled();
    auto found = extract();
    if (found) {
      take_out(*found, static_cast<std::int32_t>(patches.size()));
      patches.push_back(std::move(found->patch));
      context_.progress(1 - static_cast<double>(subsets_->live()) / all);
    } else if (confident(min_points_)) {
      break;
    } else {
      draw();
    }
  }
  return patches;
}

bool PlaneSearch::confident(double points) const { return std::exp(-points * coverage_) <= settings_.probability; }

void PlaneSearch::divide() {
  subsets_ = std::make_unique<RandomSubsets>(order_, owner_, context_.random(divisions_++).bits(), context_);
  sampler_ = std::make_unique<LocalizedSampler>(*subsets_, finest_sampled_level, settings_.tolerance);
  coverage_ = 0;
  drawn_ = 0;
}

void PlaneSearch::draw() {
  const std::size_t count = std::clamp(drawn_ / 8 / least_batch * least_batch, least_batch, largest_batch);
  for (Candidate& c : sampler_->draw(count, min_points_, batch_streams * ++batches_, context_)) {
    c.round = round_;
    candidates_.push(c);
  }
  drawn_ += count;
  // P(n) = n / (N d 2^(k-1)) with k = 3 points (Schnabel et al., equation 9).
  coverage_ += static_cast<double>(count) /
               (static_cast<double>(subsets_->live()) * static_cast<double>(sampler_->levels()) * 4);
}

void PlaneSearch::rescore(Candidate& candidate) const {
  candidate.round = round_;
  candidate.scored = 1;
  candidate.supporters = (*subsets_)[0].count(candidate.plane, settings_.tolerance);
  estimate_support(candidate, *subsets_);
}

std::optional<FittedPatch> PlaneSearch::extract() {
  int budget = competitions;
  while (!candidates_.empty()) {
    Candidate best = candidates_.top();
    if (best.round == round_ && !confident(best.expected)) return std::nullopt;
    candidates_.pop();
    if (best.round != round_) {
      // Points have gone since: the old score was an upper bound.
      rescore(best);
      if (best.upper >= min_points_) candidates_.push(best);
    } else if (best.patch >= 0) {
      return std::move(fitted_[static_cast<std::size_t>(best.patch)]);
    } else if (shadowed(best)) {
      if (best.upper >= min_points_) candidates_.push(best);
    } else if (compete(best, budget)) {
      if (best.upper >= min_points_) candidates_.push(best);
    } else if (auto found = fit(best)) {
      return found;
    }
  }
  return std::nullopt;
}

/// Nearly the same plane as one that was fitted already has no larger component than that one: it waits behind it.
bool PlaneSearch::shadowed(Candidate& candidate) const {
  for (const FittedPatch& other : fitted_) {
    const auto points = static_cast<double>(other.points);
    const Plane& plane = other.patch.plane;
    if (candidate.expected <= points * 0.999) continue;
    if (plane.normal.dot(candidate.plane.normal.cast<double>()) < 0.999) continue;
    const double distance = candidate.plane.normal.cast<double>().dot(other.mean) + candidate.plane.offset;
    if (std::abs(distance) > settings_.tolerance.distance) continue;
    candidate.expected = points * 0.999;
    candidate.upper = std::min(candidate.upper, points);
    return true;
  }
  return false;
}

/// Scores the candidate on one more subset if it cannot be told yet that it is better than the next one; false: it can.
bool PlaneSearch::compete(Candidate& candidate, int& budget) {
  if (candidate.scored == subsets_->size() || budget == 0 || candidates_.empty()) return false;
  if (candidates_.top().upper <= candidate.lower) return false;
  --budget;
  candidate.supporters += subsets_->count(candidate.scored, candidate.plane, settings_.tolerance, context_);
  ++candidate.scored;
  estimate_support(candidate, *subsets_);
  return true;
}

/// The candidate's largest component if that is still better than all others; else it goes back with its true size.
std::optional<FittedPatch> PlaneSearch::fit(Candidate candidate) {
  auto found = fit_patch(candidate.plane, *subsets_, settings_.tolerance, connectivity_, context_);
  if (!found) return std::nullopt;
  const auto points = static_cast<double>(found->points);
  if (points < min_points_) {
    fitted_.push_back(std::move(*found));  // so that nobody tries it again
    return std::nullopt;
  }
  if (candidates_.empty() || points >= candidates_.top().expected) return found;
  candidate.expected = candidate.lower = candidate.upper = points;
  candidate.patch = static_cast<std::int32_t>(fitted_.size());
  fitted_.push_back(std::move(*found));
  candidates_.push(candidate);
  return std::nullopt;
}

void PlaneSearch::take_out(const FittedPatch& found, std::int32_t number) {
  for (std::size_t k = 0; k < found.support.size(); ++k)
    for (const std::uint32_t i : found.support[k]) owner_[(*subsets_)[k].place[i]] = number;
  subsets_->take_out(found.support);
  fitted_.clear();
  ++round_;
  if (2 * subsets_->live() < subsets_->built()) divide();
  // The plane may have further components.
  Candidate rest;
  rest.plane = {found.patch.plane.normal.cast<float>(), static_cast<float>(found.patch.plane.offset)};
  rescore(rest);
  if (rest.upper >= min_points_) candidates_.push(rest);
}

}  // namespace atrium::plane
