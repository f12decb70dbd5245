#pragma once
// What a simulator writes down while it goes on: collisions, energy that contact takes, work of forces, extremes.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "numerics/compensated.h"
#include "physics/collision.h"
#include "physics/tally.h"
#include "solver/contact_problem.h"

namespace carom {

class EventLog {
 public:
  /// max_collisions: one more is an error; 0: no limit. record_collisions: false: they are counted only, without a
  /// buffer.
  /// `forces`: how many are booked each.
  EventLog(std::uint64_t max_collisions, bool record_collisions, std::size_t forces = 0);

  /// Empties the buffer for the next advance.
  void begin_advance() { collisions_.clear(); }
  /// Counts a collision and buffers it. Throws SimulationError beyond max_collisions.
  void record(const Collision& collision);
  /// Whether so many more collisions fit into the buffer. (It grows if they do not: an advance should end before.)
  bool has_room(std::size_t more) const { return collisions_.size() + more < capacity; }
  std::span<const Collision> collisions() const { return collisions_; }  // in order

  /// Books energy (J) that an impact took; negative: made.
  void lose(double energy) {
    energy_lost_.add(energy);
    tally_.energy_lost = energy_lost_.value();
  }
  /// Books energy (J) that lasting contact took; negative: made. What is not the loss of an impact is an error of the
  /// method: contact without friction does no work.
  void deviate(double energy) {
    method_error_.add(energy);
    tally_.method_error = method_error_.value();
  }
  /// Books work (J) of no single force.
  void add_work(double work) {
    work_.add(work);
    tally_.work = work_.value();
  }
  /// Books work (J) of a force of the World, by its number there.
  void add_work(std::size_t force, double work) {
    add_work(work);
    force_work_[force].add(work);
    tally_.force_work[force] = force_work_[force].value();
  }
  void note_speed(double speed) { tally_.max_speed = tally_.max_speed < speed ? speed : tally_.max_speed; }  // m/s
  void note_phase(double phase) { tally_.greatest_phase = std::max(tally_.greatest_phase, phase); }  // rad, of a step
  void note_overlap(double overlap) {                                                                // m
    tally_.max_overlap = tally_.max_overlap < overlap ? overlap : tally_.max_overlap;
  }
  /// Bodies that come to rest on something, and bodies that leave it.
  void add_resting(std::uint64_t bodies) { tally_.resting += bodies; }
  void remove_resting(std::uint64_t bodies) { tally_.resting -= bodies; }
  void add_stepped_contact(double time) { tally_.stepped_contact += time; }  // s, of one body
  /// Counts an impact with this approach (m/s) that contact takes up, and the energy (J) it takes: lost elsewhere.
  void take_up(double approach, double energy);
  /// The same of all that pressed when these velocities (m/s) were solved for from those before: `inverse_mass` (1/kg)
  /// by body. Approaches within a pair's slack, or that are errors of paths, are none; `recorded`: by pair, an impact
  /// that is recorded, or empty. What they take is booked as lost, and taken off the deviation: the caller books all
  /// that velocities change as that.
  void take_up(std::span<const double> inverse_mass, std::span<const Vec3> before, std::span<const Vec3> after,
               std::span<const ContactConstraint> pairs, std::span<const std::uint8_t> recorded = {});
  /// Books energy (J) that impacts take which are counted already, in lasting contact.
  void go_on_taking(double energy) {
    tally_.taken_up.energy += energy;
    lose(energy);
    deviate(-energy);
  }
  void count_collapse() { ++tally_.collapses; }
  /// Counts an answer that is not certified.
  void note(const Certificate& certificate) {
    if (certificate.verdict == Certificate::Verdict::doubtful) ++tally_.doubtful;
  }
  const Tally& tally() const { return tally_; }

  static constexpr std::size_t capacity = 4096;  // collisions

 private:
  const std::uint64_t max_collisions_;
  const bool record_collisions_;
  std::vector<Collision> collisions_;
  Tally tally_;
  Sum energy_lost_, method_error_, work_;  // J
  std::vector<Sum> force_work_;            // J
};

}  // namespace carom
