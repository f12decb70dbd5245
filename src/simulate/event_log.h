#pragma once
// The record of a simulator: collisions, energy lost in contact, work of forces, extremes.

#include "numerics/compensated.h"
#include "physics/collision.h"
#include "physics/coupled_forces.h"
#include "physics/tally.h"
#include "physics/trigger.h"
#include "solver/contact_problem.h"
#include "std.h"

namespace carom {

/// An impact that a contact of an island absorbs.
struct AbsorbedImpact {
  double approach = 0;  // m/s, as it meets
  double lost = 0;      // J
  bool recorded = false;
};

class EventLog {
 public:
  /// max_collisions: one more is an error; 0: no limit. record_collisions: if false, collisions are only counted,
  /// without a buffer. `forces`: number of forces with sums of their own. coupled: there are forces between bodies.
  /// `triggers` must outlive this object.
  EventLog(uint64_t max_collisions, bool record_collisions, size_t forces = 0, bool coupled = false,
           span<const Trigger> triggers = {});

  /// Empties the buffer for the next advance.
  void begin_advance() { collisions_.clear(); }
  /// Counts a collision and buffers it. Throws SimulationError beyond max_collisions.
  void record(const Collision& collision);
  /// Whether so many more collisions fit into the buffer. It grows if they do not, so an advance should end before.
  bool has_room(size_t more) const { return collisions_.size() + more < capacity; }
  span<const Collision> collisions() const { return collisions_; }  // in order

  /// Notes the triggers that a crossing is the event of.
  void note(const RegionCrossing& crossing) { note_event(crossing); }
  /// Whether triggers have been noted that are not yet taken: the next of them, which happens at `time` (s).
  bool has_noted() const { return !noted_.empty(); }
  uint32_t take_noted(double time);

  /// Books energy (J) lost in an impact; negative: made.
  void lose(double energy) {
    energy_lost_.add(energy);
    tally_.energy_lost = energy_lost_.value();
  }
  /// Books energy (J) lost in lasting contact; negative: made.
  /// Contact without friction does no work. Beyond the losses of impacts, this energy is an error of the method.
  void deviate(double energy) {
    method_error_.add(energy);
    tally_.method_error = method_error_.value();
  }
  /// Books work (J) that belongs to no single force.
  void add_work(double work) {
    work_.add(work);
    tally_.work = work_.value();
  }
  /// Books work (J) of moving things in lasting contact. It is part of what is booked as deviation.
  void add_carried_work(double work) {
    add_work(work);
    deviate(work);
  }
  /// Books work (J) of a force of the World, by its number there.
  void add_work(size_t force, double work) {
    add_work(work);
    force_work_[force].add(work);
    tally_.force_work[force] = force_work_[force].value();
  }
  /// Books work (J) of the forces between bodies.
  void add_work(const CoupledForces::Shares& energy) {
    const size_t forces = force_work_.size() - 2;
    add_work(forces, energy.springs);
    add_work(forces + 1, energy.gravitation);
  }
  void note_speed(Entity i, double speed) {  // m/s
    if (tally_.fastest.speed < speed) tally_.fastest = {speed, i};
  }
  void note_step(const StiffStep& step) {
    if (tally_.doubts.stiffest.phase < step.phase) tally_.doubts.stiffest = step;
  }
  void note_unbalanced(const Unbalanced& body) {
    if (tally_.doubts.unbalanced.way < body.way) tally_.doubts.unbalanced = body;
  }
  void note_overlap(double overlap) {  // m
    tally_.max_overlap = tally_.max_overlap < overlap ? overlap : tally_.max_overlap;
  }
  /// Counts bodies that come to rest on a thing, and bodies that leave it.
  void add_resting(uint64_t bodies) { tally_.resting += bodies; }
  void remove_resting(uint64_t bodies) { tally_.resting -= bodies; }
  void add_stepped_contact(double time) { tally_.stepped_contact += time; }  // s, of one body
  /// Counts an impact with this approach (m/s) that contact absorbs, and its energy (J), which is booked as lost
  /// elsewhere.
  void take_up(double approach, double energy);
  /// The same for all pairs that press in a solution for the velocities `after` from those before (m/s). `inverse_mass`
  /// (1/kg) is by body. Approaches within a pair's slack, or within path errors, do not count. `impacts`: by pair, or
  /// empty. Their energy is booked as lost, and that of moving things as work. Both are removed from the deviation,
  /// because the caller books the whole change of velocities as deviation.
  void take_up(span<const double> inverse_mass, span<const Vec3> before, span<const Vec3> after,
               span<const ContactConstraint> pairs, span<const AbsorbedImpact> impacts = {});
  /// Books energy (J) lost beside the impacts that are recorded or counted. The record of a rest takes its part back. A
  /// crowd gives back what contacts have lent: less than 0.
  void absorb(double energy) {
    add_absorbed(energy);
    lose(energy);
  }
  /// Books energy (J) that errors of a crowd's step have made.
  void make(double energy) {
    made_.add(energy);
    tally_.doubts.contact_made = made_.value();
    deviate(-energy);
  }
  /// Counts a step of a crowd. solved: its forces are as accurate as they should be.
  void count_crowd_step(bool solved) {
    ++tally_.doubts.crowd_steps;
    if (!solved) ++tally_.doubts.unsolved_steps;
  }
  /// Counts impacts of one instant that rigid bodies leave open: one instant, with the first of them.
  void note(const SharedImpacts& now);
  void count_collapse() { ++tally_.collapses; }
  /// Books a body that leaves the world, with its energy (J) and momentum (kg m/s).
  void remove(double energy, const Vec3& momentum) { pass(tally_.changes.removed, removed_, energy, momentum); }
  /// The same for one that comes into the world.
  void appear(double energy, const Vec3& momentum) { pass(tally_.changes.appeared, appeared_, energy, momentum); }
  void end(const RunEnd& end) { tally_.end = end; }
  /// Counts a solution without a certificate.
  void note(const Certificate& certificate) {
    if (certificate.verdict == Certificate::Verdict::doubtful) ++tally_.doubts.contacts;
  }
  const Tally& tally() const { return tally_; }

  void keep(auto& archive) {
    archive(collisions_, tally_, energy_lost_, absorbed_, made_, method_error_, work_, removed_, appeared_);
    archive.sized(force_work_);
  }

  static constexpr size_t capacity = 4096;  // collisions

 private:
  /// Adds to the energy of impacts without a record (J).
  void add_absorbed(double energy) {
    absorbed_.add(energy);
    tally_.taken_up.energy = absorbed_.value();
  }

  void note_event(const auto& event) {
    for (uint32_t k = 0; k < triggers_.size(); ++k)
      if (tally_.changes.fired[k] == not_yet && !contains(noted_, k) && is_event(triggers_[k], event))
        noted_.push_back(k);
  }

  static void pass(Passage& passage, Sum& sum, double energy, const Vec3& momentum);

  const uint64_t max_collisions_;
  const bool record_collisions_;
  const span<const Trigger> triggers_;
  vector<uint32_t> noted_;
  vector<Collision> collisions_;
  Tally tally_;
  Sum energy_lost_, absorbed_, made_, method_error_, work_, removed_, appeared_;  // J
  vector<Sum> force_work_;                                                        // J
};

}  // namespace carom
