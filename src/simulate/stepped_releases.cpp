#include "simulate/stepped_releases.h"

#include <algorithm>

#include "physics/touch.h"
#include "simulate/tolerances.h"

namespace carom {

using namespace stepped_tolerance;

namespace {

/// A cluster's active contacts on its path of `length` (s).
class ReleaseSearch {
 public:
  ReleaseSearch(const World& world, const FreeMotion& free, const ClusterMotion& motion, const Cluster& cluster,
                double length);

  struct Release {
    double time;           // s, since the path began; never: the contact lasts
    std::uint8_t feature;  // beyond
  };
  std::size_t size() const { return active_.size(); }
  const ClusterContact& contact(std::size_t k) const { return *active_[k]; }
  /// Of active contact k.
  Release find(std::size_t k);

 private:
  void go(double t);
  double force_now(std::size_t k) const;
  double force_after(double t, std::size_t k);
  std::uint8_t feature_now(std::size_t k) const;
  std::uint8_t feature_after(double t, std::size_t k);
  double zero_of_force(std::size_t k);

  const World& world_;
  const FreeMotion& free_;
  const ClusterMotion& motion_;
  const Cluster& cluster_;
  const double length_;  // s
  ClusterState state_;
  std::vector<Vec3> a_;                   // m/s^2
  std::vector<ContactConstraint> pairs_;  // by active contact
  std::vector<const ClusterContact*> active_;
  std::vector<double> first_, last_;  // N, forces at the path's ends
  std::vector<std::uint8_t> last_feature_;
};

ReleaseSearch::ReleaseSearch(const World& world, const FreeMotion& free, const ClusterMotion& motion,
                             const Cluster& cluster, double length)
    : world_(world),
      free_(free),
      motion_(motion),
      cluster_(cluster),
      length_(length),
      state_(motion.start(cluster)),
      a_(state_.x.size()) {
  for (const ClusterContact& contact : cluster.contacts)
    if (contact.active) active_.push_back(&contact);
  if (active_.empty()) return;
  go(0);
  for (std::size_t k = 0; k < size(); ++k) first_.push_back(force_now(k));
  go(length);
  for (std::size_t k = 0; k < size(); ++k) {
    last_.push_back(force_now(k));
    last_feature_.push_back(world.is_plane(active_[k]->b) ? active_[k]->feature : feature_now(k));
  }
}

/// The cluster goes to t (s) after its path began, with its forces there.
void ReleaseSearch::go(double t) {
  motion_.carry(cluster_, t, state_);
  motion_.accelerate(cluster_, state_, state_.end_x, state_.end_v, a_, pairs_);
}

/// N, what is left of a force, and a little: one that is only rounding does not end.
double ReleaseSearch::force_now(std::size_t k) const {
  const ClusterContact& c = *active_[k];
  const double weight = world_.mass[c.a] * free_.acceleration(c.a, state_.x[c.of_a], state_.v[c.of_a]).norm();
  return pairs_[k].force + force_rounding * weight;
}

double ReleaseSearch::force_after(double t, std::size_t k) {
  go(t);
  return force_now(k);
}

std::uint8_t ReleaseSearch::feature_now(std::size_t k) const {
  const ClusterContact& c = *active_[k];
  const Vec3 xb = c.of_b != ContactConstraint::fixed ? state_.end_x[c.of_b] : world_.fixed_position(c.b);
  return touch(world_, c.a, state_.end_x[c.of_a], c.b, xb).feature;
}

std::uint8_t ReleaseSearch::feature_after(double t, std::size_t k) {
  motion_.carry(cluster_, t, state_);
  return feature_now(k);
}

/// s: by regula falsi, the Illinois way; never: the force does not change its sign from the path's start to its end.
double ReleaseSearch::zero_of_force(std::size_t k) {
  double low = 0, high = length_, at_low = first_[k], at_high = last_[k];
  if (!(at_low > 0 && at_high < 0)) return never;
  for (int pass = 0; pass < release_passes && high - low > release_precision * length_; ++pass) {
    const double t = high - (high - low) * at_high / (at_high - at_low);
    const double at = force_after(t, k);
    if (at < 0) {
      high = t;
      at_high = at;
      at_low *= 0.5;
    } else {
      low = t;
      at_low = at;
      at_high *= 0.5;
    }
    if (at == 0) break;
  }
  return high;
}

ReleaseSearch::Release ReleaseSearch::find(std::size_t k) {
  const ClusterContact& c = *active_[k];
  const double ends = zero_of_force(k);
  if (world_.is_plane(c.b)) return {ends, c.feature};  // flat for ever
  if ((ends < never ? feature_after(ends, k) : last_feature_[k]) == c.feature) return {ends, c.feature};
  double low = 0, high = std::min(ends, length_);
  while (high - low > rim_precision * length_) {
    const double t = 0.5 * (low + high);
    (feature_after(t, k) == c.feature ? low : high) = t;
  }
  return {high, feature_after(high, k)};
}

}  // namespace

void predict_releases(const StepShared& shared, const ClusterMotion& motion, const Cluster& cluster,
                      StepEvents& events) {
  const double from = shared.paths.start[cluster.bodies.front()];
  ReleaseSearch search(shared.world, shared.free, motion, cluster, shared.clock.length() - from);
  for (std::size_t k = 0; k < search.size(); ++k) {
    const ReleaseSearch::Release release = search.find(k);
    if (!(release.time < never)) continue;
    const ClusterContact& c = search.contact(k);
    events.push(from + release.time, StepEventKind::release, c.a, c.b, release.feature);
  }
}

}  // namespace carom
