#pragma once
// Statistics of a chaotic motion, for runs without common trajectories.

#include "bench/recorded_run.h"
#include "std.h"

namespace carom {

struct Statistics {
  double collision_rate = 0;  // 1/s, for each body, without slow collisions (RecordedRun::least_speed)
  double mean_speed = 0;      // m/s
  double force_on_fixed = 0;  // N, the impulse on fixed things over time
  vector<double> speeds;      // m/s, of all bodies at all instants, ascending
};

/// `from`: the first of the run's instants at which speeds count.
Statistics statistics_of(const World& world, const RecordedRun& run, double duration, size_t from);

/// The Kolmogorov-Smirnov distance of two samples, each ascending.
/// It is the greatest difference of their distribution functions, 0 to 1.
double distance(span<const double> a, span<const double> b);

/// A deviation (see below) that rounding alone exceeds once in fifty runs.
/// It assumes twelve members (Student's t, four numbers).
inline constexpr double significant_deviation = 3.5;

struct Deviation {
  double value = 0;                         // in standard deviations
  const char* of = "collision_rate_per_s";  // the column that deviates most
};

/// Runs that differ by rounding alone, and the spread that chaos gives them.
class Ensemble {
 public:
  explicit Ensemble(vector<Statistics> members);  // at least 3

  /// The distance of a run's speeds from those of all members.
  double speed_distance(const Statistics& run) const { return distance(run.speeds, speeds_); }
  /// The deviation of a run from the members' mean, in standard deviations of one more member.
  /// It is the greatest of those of collision rate, mean speed, force on fixed things and speed distance.
  Deviation deviation(const Statistics& run) const;
  size_t size() const { return members_.size(); }
  const Statistics& mean() const { return mean_; }

 private:
  vector<Statistics> members_;
  Statistics mean_;           // without speeds
  vector<double> speeds_;     // of all members
  vector<double> distances_;  // of each member from the others
};

}  // namespace carom
