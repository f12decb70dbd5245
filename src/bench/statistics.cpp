// Means and spreads over an ensemble of runs that differ by rounding, and a run's deviation from them.
// The spread is that of one more member, so that the mean's own uncertainty is included.
#include "bench/statistics.h"

#include <numeric>

#include "physics/world.h"
#include "std.h"

namespace carom {

Statistics statistics_of(const World& world, const RecordedRun& run, double duration, size_t from) {
  Statistics statistics;
  uint64_t struck = 0;  // number of bodies, over all collisions
  double on_fixed = 0;  // N s
  for (const Impact& impact : run.impacts) {
    if (impact.approach_speed < run.least_speed()) continue;
    const bool bodies = world.second_body(impact.b) != no_entity;
    struck += bodies ? 2 : 1;
    if (!bodies) on_fixed += impact.impulse;
  }

  statistics.collision_rate = double(struck) / (double(world.body_count()) * duration);
  statistics.force_on_fixed = on_fixed / duration;

  for (size_t k = from; k < run.states.size(); ++k)
    for (const Vec3& v : run.states[k].velocity) statistics.speeds.push_back(v.norm());
  ranges::sort(statistics.speeds);
  statistics.mean_speed = std::accumulate(statistics.speeds.begin(), statistics.speeds.end(), 0.0) /
                          max(1.0, double(statistics.speeds.size()));
  return statistics;
}

double distance(span<const double> a, span<const double> b) {
  double most = 0;
  for (size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double x = min(a[i], b[j]);
    while (i < a.size() && a[i] <= x) ++i;
    while (j < b.size() && b[j] <= x) ++j;
    most = max(most, std::abs(double(i) / double(a.size()) - double(j) / double(b.size())));
  }
  return most;
}

namespace {

/// (value - mean of the sample) / (standard deviation of one more draw). 0 for a sample without spread.
double deviation_from(const vector<double>& sample, double value) {
  const auto n = double(sample.size());
  const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  double squares = 0;
  for (const double x : sample) squares += (x - mean) * (x - mean);
  const double spread = sqrt(squares / (n - 1) * (1 + 1 / n));
  return spread > 1e-9 * std::abs(mean) ? (value - mean) / spread : 0;
}

template <typename Get>
vector<double> each(const vector<Statistics>& members, const Get& get) {
  vector<double> values(members.size());
  std::transform(members.begin(), members.end(), values.begin(), get);
  return values;
}

double rate(const Statistics& s) {
  return s.collision_rate;
}
double speed(const Statistics& s) {
  return s.mean_speed;
}
double force(const Statistics& s) {
  return s.force_on_fixed;
}

double mean_of(const vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

Ensemble::Ensemble(vector<Statistics> members) : members_(std::move(members)) {
  mean_.collision_rate = mean_of(each(members_, rate));
  mean_.mean_speed = mean_of(each(members_, speed));
  mean_.force_on_fixed = mean_of(each(members_, force));

  // Each member counts as one more run beside the others.
  for (size_t m = 0; m < members_.size(); ++m) {
    vector<double> others;
    for (size_t k = 0; k < members_.size(); ++k)
      if (k != m) others.insert(others.end(), members_[k].speeds.begin(), members_[k].speeds.end());
    ranges::sort(others);
    distances_.push_back(distance(members_[m].speeds, others));
    speeds_.insert(speeds_.end(), members_[m].speeds.begin(), members_[m].speeds.end());
  }
  ranges::sort(speeds_);
}

Deviation Ensemble::deviation(const Statistics& run) const {
  Deviation most{0, "collision_rate_per_s"};
  const auto take = [&](double value, const char* of) {
    if (value > most.value) most = {value, of};
  };
  take(std::abs(deviation_from(each(members_, rate), run.collision_rate)), "collision_rate_per_s");
  take(std::abs(deviation_from(each(members_, speed), run.mean_speed)), "mean_speed_m_per_s");
  take(std::abs(deviation_from(each(members_, force), run.force_on_fixed)), "force_on_fixed_N");
  take(deviation_from(distances_, speed_distance(run)), "speed_distance");
  return most;
}

}  // namespace carom
