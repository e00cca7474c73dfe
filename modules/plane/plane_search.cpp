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
// So many candidates in a row whose component is too small, best first: what is left is clutter. The pool of candidates
// in clutter is large (10,000 in a phone scan of 30,000 points), each costs a fit, and none gives a plane.
constexpr int patience = 400;
constexpr double telling_score = 8;  // on the first subset: less may be chance

FloatPlane to_float(const Plane& plane) { return {plane.normal.cast<float>(), static_cast<float>(plane.offset)}; }

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
      vain_fits_ = 0;
      context_.progress(1 - static_cast<double>(subsets_->live()) / all);
    } else if (vain_fits_ >= patience || confident(min_points_)) {
      break;
    } else {
      draw();
    }
  }
  return patches;
}

/// Whether a plane of `points` points would have been drawn by now: P(n, s) >= 1 - probability (Schnabel et al.,
/// equation 2).
/// What is too small to be told from chance on the first subset counts as soon as the smallest that can be told would
/// have been drawn: its own draws say nothing, and waiting for them would never end.
bool PlaneSearch::confident(double points) const {
  points = std::max(points, coverage_.back().least_points);
  double coverage = 0;
  for (const Coverage& c : coverage_)
    if (points >= c.least_points) coverage += c.sum;
  return std::exp(-points * coverage) <= settings_.probability;
}

void PlaneSearch::divide() {
  subsets_ = std::make_unique<RandomSubsets>(order_, owner_, context_.random(divisions_++).bits(), context_);
  sampler_ = std::make_unique<LocalizedSampler>(*subsets_, finest_sampled_level, settings_.tolerance);
  // What was fitted refers to the old subsets.
  fitted_.clear();
  std::vector<Candidate> kept;
  for (; !candidates_.empty(); candidates_.pop()) {
    kept.push_back(candidates_.top());
    kept.back().patch = -1;
  }
  candidates_ = Queue(Smaller(), std::move(kept));
  const double share = static_cast<double>((*subsets_)[0].live) / std::max(1.0, static_cast<double>(subsets_->live()));
  coverage_.push_back({0, subsets_->size() == 1 ? 0 : telling_score / share});
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
  coverage_.back().sum += static_cast<double>(count) /
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
  while (!candidates_.empty() && vain_fits_ < patience) {
    Candidate best = candidates_.top();
    if (best.round == round_ && !confident(best.expected)) return std::nullopt;
    candidates_.pop();
    bool keep = true;
    if (best.round != round_) {
      if (best.patch < 0 || !renew(best)) rescore(best);  // points have gone since: the old score was an upper bound
    } else if (best.patch >= 0) {
      Fitted& taken = fitted_[static_cast<std::size_t>(best.patch)];
      taken.sample.clear();
      return std::move(taken.found);
    } else if (!shadowed(best) && !compete(best, budget)) {
      keep = fit(best);
      if (!keep || best.upper < min_points_) ++vain_fits_;
    }
    if (keep && best.upper >= min_points_) candidates_.push(best);
  }
  return std::nullopt;
}

/// Whether the candidate's fitted component still holds after other planes took points; its size is then up to date.
bool PlaneSearch::renew(Candidate& candidate) {
  constexpr double tolerable_loss = 0.02;
  Fitted& fitted = fitted_[static_cast<std::size_t>(candidate.patch)];
  FittedPatch& found = fitted.found;
  std::size_t left = 0;
  for (std::size_t k = 0; k < found.support.size(); ++k) {
    const PointColumns& columns = (*subsets_)[k].columns;
    std::erase_if(found.support[k], [&](std::uint32_t i) { return !columns.is_live(i); });
    left += found.support[k].size();
  }
  const bool holds = static_cast<double>(left) >= (1 - tolerable_loss) * static_cast<double>(found.points);
  if (!holds) fitted.sample.clear();
  found.points = left;
  candidate.round = round_;
  candidate.expected = candidate.lower = candidate.upper = static_cast<double>(left);
  return holds;
}

/// A candidate that shares much of its support with a component that was fitted already is a worse version of it and
/// waits behind it: once that one's points are out, it is scored again.
bool PlaneSearch::shadowed(Candidate& candidate) const {
  for (const Fitted& other : fitted_) {
    const double behind = 0.999 * static_cast<double>(other.found.points);
    if (other.sample.empty() || candidate.expected <= behind) continue;
    const auto shared =
        static_cast<double>(std::count_if(other.sample.begin(), other.sample.end(), [&](const Eigen::Vector3f& p) {
          return std::abs(candidate.plane.normal.dot(p) + candidate.plane.offset) <= settings_.tolerance.distance;
        }));
    // What is too small to be taken will never go: only its twins are worth nothing.
    const double enough = behind >= min_points_ ? 0.3 : 0.9;
    if (shared < enough * static_cast<double>(other.sample.size())) continue;
    if (other.found.patch.plane.normal.dot(candidate.plane.normal.cast<double>()) < settings_.tolerance.min_cosine)
      continue;
    if (behind < min_points_ && candidate.expected > 1.2 * other.expected) continue;
    candidate.expected = behind;
    candidate.upper = std::min(candidate.upper, behind);
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

/// Gives the candidate its largest component and that one's size; false: it has none. Fits on part of the points first:
/// often that shows that the surface is known already.
bool PlaneSearch::fit(Candidate& candidate) {
  const std::size_t part = std::max<std::size_t>(1, subsets_->size() - 1);
  for (int step = 0; step < 2; ++step) {
    const auto found = fit_patch(candidate.plane, *subsets_, part, settings_.tolerance, connectivity_, context_);
    if (!found) continue;
    candidate.plane = to_float(found->patch.plane);
    if (shadowed(candidate)) return true;
  }
  auto found = fit_patch(candidate.plane, *subsets_, subsets_->size(), settings_.tolerance, connectivity_, context_);
  if (!found) return false;
  candidate.plane = to_float(found->patch.plane);
  fitted_.push_back({std::move(*found), candidate.expected, {}});
  take_sample(fitted_.back());
  candidate.patch = static_cast<std::int32_t>(fitted_.size()) - 1;
  candidate.expected = candidate.lower = candidate.upper = static_cast<double>(fitted_.back().found.points);
  return true;
}

void PlaneSearch::take_sample(Fitted& fitted) const {
  constexpr std::size_t size = 64;
  const std::size_t step = std::max<std::size_t>(1, fitted.found.points / size);
  std::size_t next = 0;
  for (std::size_t k = 0; k < fitted.found.support.size(); ++k) {
    const auto& part = fitted.found.support[k];
    for (; next < part.size(); next += step) fitted.sample.push_back((*subsets_)[k].columns.point(part[next]));
    next -= part.size();
  }
}

void PlaneSearch::take_out(const FittedPatch& found, std::int32_t number) {
  for (std::size_t k = 0; k < found.support.size(); ++k)
    context_.parallel_for(found.support[k].size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) owner_[(*subsets_)[k].place[found.support[k][i]]] = number;
    });
  subsets_->take_out(found.support, context_);
  ++round_;
  if (2 * subsets_->live() < subsets_->built()) divide();
  // The plane may have further components.
  Candidate rest;
  rest.plane = to_float(found.patch.plane);
  rescore(rest);
  if (rest.upper >= min_points_) candidates_.push(rest);
}

}  // namespace atrium::plane
