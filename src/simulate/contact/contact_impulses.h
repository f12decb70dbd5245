#pragma once
// The impulses of contact that options.impulses ask for: of impacts, and of forces in lasting contact as they accrue.
// Each is a sum of magnitudes, or of a contact's impulses in the steps of a crowd. Nothing is stored where none is
// asked for.

#include "numerics/compensated.h"
#include "numerics/lazy_array.h"
#include "physics/contact_force.h"
#include "physics/watched_impulse.h"
#include "physics/world.h"
#include "simulate/path/instant.h"
#include "std.h"

namespace carom {

class EventLog;

/// A path along which things that move, or forces between bodies, do work, and contacts press.
class WorkingPath {
 public:
  virtual ~WorkingPath() = default;
  /// Books their work in the first `seconds`.
  virtual void book(double seconds, EventLog& log) const = 0;
  /// The impulse of one contact along the path: `force` has its two things, and N s in place of N.
  using Take = function<void(const ContactForce& impulse)>;
  /// Calls take(impulse) for each contact, with the impulse between two times of the path (s).
  virtual void impulses(double from, double to, const Take& take) const = 0;
};

class ContactImpulses {
 public:
  /// Both must outlive this object.
  ContactImpulses(const World& world, span<const WatchedImpulse> watched)
      : world_(world), watched_(watched), sums_(watched.size()), held_(world.body_count()) {}

  bool any() const { return !sums_.empty(); }
  /// Adds the impulse (N s) of body i and a thing at an instant. Below 0: it takes back a part of what was added.
  void strike(const Instant& at, Entity i, Entity thing, double impulse);
  /// The same, spread evenly over a time.
  void spread(const Instant& from, const Instant& until, Entity i, Entity thing, double impulse);
  /// From this instant on these forces act, which are body i's. They are added up to then, as the last ones were.
  void hold(Entity i, const Instant& now, span<const ContactForce> forces);
  /// Adds the impulses along a path from its start to an instant.
  void add_path(const Instant& start, const Instant& until, const WorkingPath& path) {
    add_path(start, until, path, sums_);
  }

  /// The sums (N s) with the forces that act now up to `time` (s), and those along `paths` that have not ended.
  using OpenPath = pair<Instant, const WorkingPath*>;
  vector<double> up_to(double time, span<const OpenPath> paths) const;

  void keep(auto& archive) {
    archive.sized(sums_);
    archive(held_);
  }

 private:
  /// A force that counts for one of the sums.
  struct Rate {
    uint32_t sum = 0;
    double force = 0;  // N
  };
  struct Held {
    Instant since;
    vector<Rate> rates;

    void keep(auto& archive) {
      uint64_t count = rates.size();
      archive(since, count);
      rates.resize(count);
      for (Rate& rate : rates) archive(rate.sum, rate.force);
    }
  };

  bool counts(size_t k, Entity i, Entity thing) const;
  double time_in(size_t k, const Instant& from, const Instant& until) const;
  void add_path(const Instant& start, const Instant& until, const WorkingPath& path, vector<Sum>& sums) const;

  const World& world_;
  const span<const WatchedImpulse> watched_;
  vector<Sum> sums_;      // N s, by watched_
  LazyArray<Held> held_;  // by body
};

}  // namespace carom
