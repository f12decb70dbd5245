#pragma once
// The measures of a run, taken as it goes on.

#include "physics/collision.h"
#include "physics/extremes.h"
#include "physics/state.h"
#include "physics/world_region.h"
#include "run/measure_scope.h"
#include "std.h"

namespace carom {

/// What is known at the end of a run.
struct MeasuredRun {
  const State& state;  // the last one
  const Summary& summary;
  span<const Extremes> extremes;  // by Measuring::watched()
  span<const double> impulses;    // N s, by Measuring::impulses()
};

class Measuring {
 public:
  /// `scene` must outlive this object. A measure that names what the scene does not have is undefined.
  Measuring(const Scene& scene, vector<Measure> measures);

  /// Whether a measure counts collisions.
  bool needs_collisions() const { return !meetings_.empty(); }
  /// The quantities with extremes, which the simulator has to watch.
  const vector<WatchedQuantity>& watched() const { return watched_; }
  /// The contacts whose impulses the simulator has to sum.
  const vector<WatchedImpulse>& impulses() const { return impulses_; }
  /// Takes collisions and crossings of regions, each in order.
  void record(span<const Collision> collisions, span<const RegionCrossing> crossings);
  /// The values of the measures, in their order.
  vector<Measured> values(const MeasuredRun& run) const;

  void keep(auto& archive) { archive.sized(meetings_, visits_); }

 private:
  /// The collisions between two things, or of one thing with anything.
  struct Meeting {
    vector<string> things;
    TimeWindow window;
    vector<EntityRange> a, b;  // of the names in `things`
    double count = 0;
    double first;  // s, NaN: none

    void keep(auto& archive) { archive(count, first); }
  };

  /// The crossings of one region, or of all members of a repeated one.
  struct Visits {
    string name;
    vector<uint32_t> regions;  // ascending
    double entries = 0;
    double first;  // s, of the first entry; NaN: none
    Entity entrant = no_entity;
    map<pair<uint32_t, Entity>, bool> inside{};  // by region and body

    void keep(auto& archive) { archive(entries, first, entrant, inside); }
  };

  double inside(const Visits& visits, const State& end) const;
  string first_entrant(const Measure& measure) const;
  void prepare(const Measure& measure);
  double value(const Measure& measure, const MeasuredRun& run) const;
  double at_end(const Measure& measure, Entity body, const State& end) const;
  double evaluated(const Measure& measure, const MeasuredRun& run) const;
  double counted(const Measure& measure, const MeasuredRun& run) const;
  WatchedImpulse impulse_of(const Measure& measure) const;
  const Extremes& extremes(const Measure& measure, const MeasuredRun& run) const;

  const Scene& scene_;
  const vector<Measure> measures_;
  vector<bool> known_;  // by measure: the scene has all that it names
  vector<Meeting> meetings_;
  vector<Visits> visits_;
  vector<WatchedQuantity> watched_;
  vector<WatchedImpulse> impulses_;
};

}  // namespace carom
