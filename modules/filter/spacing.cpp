#include "modules/filter/spacing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/point_tree.hpp"

namespace atrium::filter {
namespace {

constexpr std::size_t fan = PointTree::fan;

/// No neighbour at distance d from a position is further than this from another one at distance `step`: with room for
/// rounding.
float reach_after(float d, float step) { return (d + step) * 1.0001F + 1e-12F; }

/// One thread's work: the leaves in their order, each point starting from what the one before has found.
class LeafSearch {
 public:
  LeafSearch(const std::vector<Eigen::Vector3f>& points, const PointTree& tree, std::size_t k)
      : points_(points), tree_(tree), k_(k), most_(32 + k / 4) {}

  /// Writes the mean distance of each point of a leaf, in their order.
  void leaf(std::size_t l, float* result) {
    const std::size_t begin = l * fan, end = std::min(begin + fan, tree_.size());
    Eigen::AlignedBox3f box;
    for (std::size_t i = begin; i < end; ++i) box.extend(at(i));
    const auto from_middle = [&](std::size_t i) { return (at(i) - box.center()).squaredNorm(); };
    std::size_t first = begin;  // a point in the middle: the others are near it
    for (std::size_t i = begin + 1; i < end; ++i)
      if (from_middle(i) < from_middle(first)) first = i;
    const bool alone = tree_.nodes_near(Eigen::AlignedBox3f(at(first)), reach(at(first)), most_, near_);
    result[first - begin] = alone ? select(at(first)) : search(at(first));
    float widest = 0;
    for (std::size_t i = begin; i < end; ++i) widest = std::max(widest, (at(i) - at(first)).norm());
    const bool shared = tree_.nodes_near(box, reach_after(reach(at(first)), widest), most_, near_);
    for (std::size_t i = begin; i < end; ++i)
      if (i != first) result[i - begin] = shared ? select(at(i)) : search(at(i));
  }
  /// Marks the points of a leaf whose mean distance is at most the limit.
  void leaf_at_most(std::size_t l, double limit, std::vector<std::uint8_t>& marks) {
    // k others nearer than this have a mean below the limit, however it is rounded.
    const float surely = static_cast<float>(limit * (1 - 1e-5));
    for (std::size_t i = l * fan; i < std::min(l * fan + fan, tree_.size()); ++i) {
      const bool near = tree_.has_within(at(i), surely, k_ + 1, l) || static_cast<double>(search(at(i))) <= limit;
      marks[tree_.order()[i]] = near ? 1 : 0;
    }
  }

 private:
  const Eigen::Vector3f& at(std::size_t i) const { return points_[tree_.order()[i]]; }

  float mean(double sum) const { return static_cast<float>(sum / static_cast<double>(k_)); }

  /// The k-th neighbour is no further than that of any point before, seen from here.
  float reach(const Eigen::Vector3f& p) const {
    float least = PointTree::everywhere;
    for (const Done& done : done_) least = std::min(least, reach_after(done.distance, (p - done.position).norm()));
    return least;
  }
  void remember(const Eigen::Vector3f& p, float distance) { done_[next_++ % fan] = {p, distance}; }

  float search(const Eigen::Vector3f& p) {
    tree_.k_nearest(p, k_ + 1, found_, reach(p));  // itself at 0, and k others
    double sum = 0;
    for (const Neighbour& n : found_) sum += static_cast<double>(std::sqrt(n.squared_distance));
    if (found_.size() > k_) remember(p, std::sqrt(found_.back().squared_distance));
    return mean(sum);
  }

  /// The same among the points below near_, which hold all within its reach.
  float select(const Eigen::Vector3f& p) {
    const float r = reach(p);
    tree_.squared_distances(p, r, near_, squares_);
    if (squares_.size() <= k_) return search(p);  // squares beyond what a float holds
    // On a surface the number of points grows with the square: those below this are probably enough.
    shrink(r * r * 1.3F * static_cast<float>(k_ + 1) / static_cast<float>(squares_.size()));
    const auto kth = squares_.begin() + static_cast<std::ptrdiff_t>(k_);
    std::nth_element(squares_.begin(), kth, squares_.end());
    double sum = 0;
    for (auto s = squares_.begin(); s <= kth; ++s) sum += static_cast<double>(std::sqrt(*s));
    remember(p, std::sqrt(*kth));
    return mean(sum);
  }

  /// Leaves only the squares up to a limit, if these are more than k.
  void shrink(float limit) {
    few_.resize(squares_.size());
    std::size_t count = 0;
    for (const float s : squares_) {  // without branches
      few_[count] = s;
      count += s <= limit ? 1 : 0;
    }
    if (count <= k_) return;
    few_.resize(count);
    squares_.swap(few_);
  }

  struct Done {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    float distance = PointTree::everywhere;  ///< of its k-th neighbour
  };
  const std::vector<Eigen::Vector3f>& points_;
  const PointTree& tree_;
  std::size_t k_;
  std::size_t most_;            ///< nodes; more are left to single searches
  std::array<Done, fan> done_;  ///< the last few
  std::size_t next_ = 0;
  std::vector<Neighbour> found_;
  std::vector<std::uint32_t> near_;
  std::vector<float> squares_, few_;
};

}  // namespace

Spacing::Spacing(const std::vector<Eigen::Vector3f>& points, std::size_t k, const Context& context)
    : points_(points), k_(k), tree_(points, context) {}

std::vector<float> Spacing::sample(std::size_t wanted, const Context& context) const {
  const std::size_t step = points_.size() / 4 < wanted ? 1 : points_.size() / std::max<std::size_t>(1, wanted);
  const std::size_t leaves = (points_.size() + fan - 1) / fan;
  const std::size_t chosen = (leaves + step - 1) / step;
  // Any one of each few leaves: the first of a node is not like the others, strays gather at the ends of the tree's
  // cuts.
  const auto leaf_of = [&](std::size_t s) { return s * step + mix_seed(1, s) % std::min(step, leaves - s * step); };
  std::vector<float> result(chosen * fan);
  context.parallel_for(
      chosen,
      [&](std::size_t begin, std::size_t end) {
        LeafSearch search(points_, tree_, k_);
        for (std::size_t s = begin; s < end; ++s) search.leaf(leaf_of(s), result.data() + s * fan);
      },
      512);
  if (leaf_of(chosen - 1) + 1 == leaves) result.resize(result.size() - (leaves * fan - points_.size()));
  return result;
}

std::vector<std::uint8_t> Spacing::at_most(double limit, const Context& context) const {
  std::vector<std::uint8_t> marks(points_.size());
  context.parallel_for((points_.size() + fan - 1) / fan,
                       [&](std::size_t begin, std::size_t end) {
                         LeafSearch search(points_, tree_, k_);
                         for (std::size_t l = begin; l < end; ++l) search.leaf_at_most(l, limit, marks);
                       },
                       512);
  return marks;
}

}  // namespace atrium::filter
