// One scene, run several times: records, states and sums are checked against physics and the simulator's guarantees,
// by independent computations in long double.
#include "stress/check.h"

#include "physics/world_now.h"
#include "std.h"
#include "stress/digits.h"
#include "stress/gaps.h"
#include "stress/paths.h"
#include "stress/watch.h"

namespace carom::stress {

namespace {

string names_of(Entity a, Entity b) {
  return to_string(a) + " and " + to_string(b);
}

/// The scene's own coefficient of a pair, from the rules of the scene format.
double coefficient(const World& world, Entity a, Entity b) {
  for (auto p = world.pairs.rbegin(); p != world.pairs.rend(); ++p)
    if ((p->a_first == a && p->b_first == b) || (p->a_first == b && p->b_first == a)) return p->value.value_or(0);

  const double e1 = world.restitution[a], m1 = world.mass[a];
  // A fixed thing without a coefficient of its own has the body's.
  double e2 = e1, m2 = 0;
  if (world.is_body(b)) {
    e2 = world.restitution[b];
    m2 = world.mass[b];
  } else {
    e2 = (world.is_plane(b)  ? world.plane(b).restitution
          : world.is_wall(b) ? world.wall(b).restitution
                             : world.obstacle(b).restitution)
             .value_or(e1);
  }

  switch (world.combine) {
    case Combine::average:
      return (e1 + e2) / 2;
    case Combine::minimum:
      return std::min(e1, e2);
    case Combine::maximum:
      return std::max(e1, e2);
    case Combine::product:
      return e1 * e2;

    case Combine::geometric_mean:
      return sqrt(e1 * e2);
    case Combine::mass_weighted:
      return world.is_body(b) ? (m1 * e1 + m2 * e2) / (m1 + m2) : e2;
    case Combine::book:
      return e1 * e2 / 2;
  }
  return 0;
}

class Check {
 public:
  Check(const RandomScene& scene, double patience, Verdict& verdict)
      : scene_(scene), known_(scene), world_(known_.world), patience_(patience), verdict_(verdict) {}

  void run() {
    first_ = watch(scene_, {}, patience_);
    if (first_.too_slow)
      return fail("takes more than " + text(patience_) + " s of CPU time, " + to_string(first_.records.size()) +
                  " records so far");

    verdict_.collisions = first_.tally.collisions();
    verdict_.crowds = first_.tally.stepped_contact > 0;
    if (!first_.error.empty()) return stop();

    set_off(known_.world, first_.tally.changes.fired);

    times_ = sample_times(known_, first_.records);
    seen_ = watch(scene_, times_, 10 * patience_);
    same("with more outputs", seen_);
    if (!seen_.error.empty() || seen_.seen.size() != times_.size()) return;
    if (!finite()) return;

    paths_ = make_unique<Paths>(known_, times_, seen_, first_.records, in_contact());
    for (string& overlap : paths_->overlaps()) fail(std::move(overlap));

    energy();
    rows();
    momentum();
    for (const Collision& c : first_.records) record(c);

    if (scene_.seed % 8 == 0) same("run again", watch(scene_, {}, patience_));
    scaling();
    axes();
  }

 private:
  void fail(string what) {
    if (verdict_.violations.size() < 12) verdict_.violations.push_back(std::move(what));
  }

  /// A run that may end with an error is checked up to some of its collisions.
  void stop() {
    const bool lively = any_of(world_.restitution, [](double e) { return e > 1; });
    if (!scene_.may_stop && first_.error.find("max_collisions") != string::npos) {
      // Many collisions are no fault if they come to an end. Light balls in a row between heavy ones, with e = 0.9,
      // have 24,845 in 0.03 s of CPU time. Endless ones exceed the time limit.
      RandomScene unlimited = scene_;
      unlimited.options.max_collisions = 0;
      return Check(unlimited, patience_, verdict_).run();
    }
    if (!scene_.may_stop || (!lively && first_.error.find("clock") != string::npos))
      return fail("error: " + first_.error);

    verdict_.stopped = true;
    double end = 0;
    size_t count = 0;
    for (const Collision& c : first_.records) {
      if (++count > 300 || c.approach_speed > 1e6 * first_.records[0].approach_speed) break;
      end = c.time;
    }
    if (!(end > 0)) return;

    RandomScene shorter = scene_;
    shorter.may_stop = false;
    shorter.options.max_collisions = 0;
    shorter.options.duration = end;
    Check(shorter, patience_, verdict_).run();
  }

  void same(const char* how, const Watched& other) {
    const string what = difference(first_, other, 0, 0, 0);
    if (!what.empty()) fail(string(how) + " differs: " + what);
  }

  bool finite() {
    for (const State& s : seen_.seen)
      for (size_t i = 0; i < s.position.size(); ++i)
        if (!s.position[i].allFinite() || !s.velocity[i].allFinite()) {
          fail("body " + to_string(i) + " is nowhere at t = " + text(s.time));
          return false;
        }
    return true;
  }

  double mass(const State& s, Entity i) const { return s.mass.empty() ? world_.mass[i] : s.mass[i]; }

  long double energy_of(const State& s, double& size) const {
    long double sum = 0;
    double all = 0;
    for (Entity i = 0; i < world_.body_count(); ++i) {
      const long double m = mass(s, i);
      const long double kinetic = 0.5L * m * s.velocity[i].cast<long double>().squaredNorm();
      const long double potential = -m * world_.gravity.cast<long double>().dot(s.position[i].cast<long double>());
      sum += kinetic + potential;

      for (const Force& f : world_.forces) {
        if (f.from > 0 || isfinite(f.until) || !(f.on.empty() || ranges::count(f.on, i))) continue;
        sum -= (per_mass(f) ? world_.mass[i] : 1) * value(f).cast<long double>().dot(s.position[i].cast<long double>());
      }

      double pull = world_.gravity.cwiseAbs().dot(s.position[i].cwiseAbs());
      for (const Force& f : world_.forces)
        pull += value(f).cwiseAbs().dot(s.position[i].cwiseAbs()) / (per_mass(f) ? 1 : world_.mass[i]);
      all += static_cast<double>(kinetic) + static_cast<double>(m) * pull;
    }

    size = std::max(size, all);
    return sum;
  }

  /// The overlap of bodies in lasting contact, as a share of the smaller one's radius: followed exactly, or in a crowd.
  double in_contact() const {
    if (first_.tally.stepped_contact > 0) return 1e-8;
    return first_.tally.collapses > 0 ? 1e-10 : 0;
  }

  void energy() {
    double size = 0;
    const long double start = energy_of(first_.start, size);
    for (const State& s : seen_.seen) energy_of(s, size);
    const long double end = energy_of(first_.end, size);
    const Tally& t = first_.tally;
    const double events = static_cast<double>(first_.records.size());
    // In islands paths are integrated, not closed forms.
    const double relative = 2e-14 * (1 + sqrt(events)) + (t.collapses > 0 ? 1e-10 : 0);
    const double tolerance = relative * (size + std::abs(t.energy_lost) + std::abs(t.work));
    const double residual = static_cast<double>(end - start) + t.energy_lost + t.method_error - t.work;
    // What errors of crowds make (measured: 1.3e-3 in 7,000 scenes), else almost nothing.
    const double least = t.stepped_contact > 0 ? -3e-3 : -1e-6, most = 1e-6;
    size += std::abs(t.work);
    if (!(t.method_error >= least * size && t.method_error <= most * size))
      fail("contact took " + text(t.method_error) + " J beside impacts, of " + text(size) + " J");
    if (!(std::abs(residual) <= tolerance))
      fail("energy books: residual " + text(residual) + " J of " + text(size) + " J, lost " + text(t.energy_lost) +
           ", work " + text(t.work));
  }

  /// What the records have lost, and what contact has absorbed without a record, is all that is lost.
  void rows() {
    const Tally& t = first_.tally;
    long double lost = t.taken_up.energy, turned = std::abs(t.taken_up.energy);
    for (const Collision& c : first_.records) {
      lost += c.energy_lost;
      turned += std::abs(c.energy_lost);
    }
    const double off = static_cast<double>(lost - t.energy_lost);
    if (!(std::abs(off) <= 1e-9 * static_cast<double>(turned)))
      fail("rows lose " + text(off) + " J more than the run, of " + text(static_cast<double>(turned)) + " J");
  }

  void momentum() {
    if (world_.fixed_count() > 0 || !world_.forces.empty()) return;
    Long3 start = Long3::Zero(), end = Long3::Zero();
    long double size = 0, all = 0;

    for (Entity i = 0; i < world_.body_count(); ++i) {
      start += world_.mass[i] * first_.start.velocity[i].cast<long double>();
      end += mass(first_.end, i) * first_.end.velocity[i].cast<long double>();
      size += world_.mass[i] * first_.start.velocity[i].norm() + mass(first_.end, i) * first_.end.velocity[i].norm();
      all += world_.mass[i];
    }

    const Long3 given = all * scene_.options.duration * world_.gravity.cast<long double>();
    size += given.norm();
    for (const Collision& c : first_.records) size += 0.01L * c.impulse;

    const long double off = (end - start - given).norm();
    if (!(off <= 1e-14L * size)) fail("momentum: off by " + text(static_cast<double>(off / size)) + " of its size");
  }

  /// The greatest coefficient of the impacts of that instant that share bodies with others, or 0. Where these differ,
  /// or some of them end in contact, without a record, each separates at less than that times its approach.
  double shared_coefficient(const Collision& c) const {
    double greatest = first_.tally.shared.instants > 0 ? c.restitution : 0;
    for (const Collision& other : first_.records) {
      const auto is = [&](Entity e) { return world_.is_body(e) && (other.a == e || other.b == e); };
      if (other.time == c.time && &other != &c && (is(c.a) || is(c.b)))
        greatest = std::max({greatest, other.restitution, c.restitution});
    }
    return greatest;
  }

  void record(const Collision& c) {
    if (c.kind == CollisionKind::rest) return;
    const string what = "record of " + names_of(c.a, c.b) + " at t = " + text(c.time) + ": ";
    if (c.approach_speed < 0) fail(what + "they separate at " + text(-c.approach_speed) + " m/s");
    if (std::abs(c.normal.norm() - 1) > 1e-14) fail(what + "its normal has length 1 + " + text(c.normal.norm() - 1));
    if (scene_.options.merge && c.kind == CollisionKind::merge) return;

    if (!scene_.options.merge) {
      const double e = coefficient(world_, c.a, c.b);
      if (std::abs(c.restitution - e) > 4e-16 * e)
        fail(what + "restitution " + text(c.restitution) + ", not " + text(e));
      const double shared = shared_coefficient(c);
      const double most = shared * c.approach_speed + 0x1p-48 * first_.tally.fastest.speed;
      const bool among = shared > 0 && c.separation_speed >= 0 && c.separation_speed <= most;
      if (c.separation_speed != 0 && !among &&
          std::abs(c.separation_speed - e * c.approach_speed) > 1e-15 * c.approach_speed)
        fail(what + "separates at " + text(c.separation_speed) + " after " + text(c.approach_speed));
    }

    if (c.restitution <= 1 && c.energy_lost < 0)
      fail(what + "makes energy: " + text(-c.energy_lost) + " J at " + text(c.approach_speed) + " m/s");

    if (scene_.options.merge) return;
    // Where they are at that instant, if there is a state of it.
    const auto at = std::lower_bound(times_.begin(), times_.end(), c.time);
    if (at == times_.end() || *at != c.time) return;
    const State& s = seen_.seen[static_cast<size_t>(at - times_.begin())];
    const bool body = world_.is_body(c.b);
    const Vec3 xb = body ? s.position[c.b] : fixed_position(world_, c.b, {c.time, 0});

    const double distance =
        static_cast<double>(gap(world_, c.a, s.position[c.a].cast<long double>(), c.b, xb.cast<long double>()));
    const double tick = std::nextafter(c.time, 1e300) - c.time;
    const Vec3 vb = body ? s.velocity[c.b] : fixed_velocity(world_, c.b, {c.time, 0});
    const double speed = s.velocity[c.a].norm() + vb.norm() + c.approach_speed;

    // Collisions that end together, by a collapse or as struck bodies pass them on, are in one place within a billionth
    // of a radius.
    double place = c.separation_speed == 0 ? 1e-9 * world_.radius[c.a] : 0;
    // Impacts of a crowd are early by up to a step, in which no body goes farther than a tenth of the least radius.
    if (first_.tally.stepped_contact > 0) place = (distance > 0 ? 0.21 : 1e-8) * world_.radius[c.a];
    if (!(std::abs(distance) <= paths_->allowed(c.a, c.b) + 2 * tick * speed + place))
      fail(what + "they are " + text(distance) + " m apart");
  }

  void scaling() {
    const auto draw = [&](int k) { return static_cast<int>((scene_.seed * 2654435761u >> (8 * k)) % 41) - 20; };
    const int length = draw(0), time = draw(1), mass_unit = draw(2);
    const Watched other = watch(scaled(scene_, length, time, mass_unit), {}, patience_);
    const string what = difference(first_, other, length, time, mass_unit);
    if (!what.empty())
      fail("scaled by powers of two " + to_string(length) + ", " + to_string(time) + ", " + to_string(mass_unit) +
           " differs: " + what);
  }

  /// With rotated axes only rounding differs: the first collision is the same, if it is not grazing and not one of
  /// several.
  void axes() {
    if (first_.records.empty()) return;
    const Collision& c = first_.records[0];
    const double next = first_.records.size() > 1 ? first_.records[1].time : scene_.options.duration;
    const Vec3 vb = world_.is_body(c.b) ? seen_.start.velocity[c.b] : fixed_velocity(world_, c.b, {c.time, 0});
    const double speed = seen_.start.velocity[c.a].norm() + vb.norm();
    if (!(next > c.time * (1 + 1e-6)) || c.time == 0 || c.approach_speed < 1e-2 * speed) return;

    RandomScene other = turned(scene_);
    other.options.duration = std::min(other.options.duration, next);
    const Watched run = watch(other, {}, patience_);
    const double slack = 10 * paths_->rounding(c.a, c.b) / c.approach_speed + 1e-12 * c.time;

    if (run.records.empty())
      fail("with its axes turned nothing meets, else " + names_of(c.a, c.b) + " at t = " + text(c.time));
    else if (run.records[0].a != c.a || run.records[0].b != c.b || std::abs(run.records[0].time - c.time) > slack)
      fail("with its axes turned " + names_of(run.records[0].a, run.records[0].b) +
           " meet at t = " + text(run.records[0].time) + ", else " + names_of(c.a, c.b) + " at t = " + text(c.time));
  }

  const RandomScene& scene_;
  RandomScene known_;  // with the times that events have set
  const World& world_;
  const double patience_;  // s of CPU time, for a run
  Verdict& verdict_;
  Watched first_, seen_;
  vector<double> times_;
  unique_ptr<Paths> paths_;
};

}  // namespace

Verdict check(const RandomScene& scene, double patience) {
  Verdict verdict;
  Check(scene, patience, verdict).run();
  return verdict;
}

}  // namespace carom::stress
