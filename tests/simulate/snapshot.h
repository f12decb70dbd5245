#pragma once
// Runs that are saved, and others that are restored from these bytes, beside one that is never stopped. All that a
// simulator shows must be the same, bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <ostream>
#include <type_traits>

#include "simulate/simulator.h"
#include "std.h"

namespace carom {

/// A hash of values by their bits.
class BitHash {
 public:
  template <typename... Values>
  void add(const Values&... values) {
    (one(values), ...);
  }
  uint64_t value() const { return hash_; }

 private:
  void word(uint64_t word) { hash_ = (hash_ ^ word) * 0x100000001b3; }
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void one(T value) {
    if constexpr (std::is_same_v<T, double>)
      word(std::bit_cast<uint64_t>(value));
    else
      word(static_cast<uint64_t>(value));
  }
  void one(const Vec3& v) {
    for (const double x : v) one(x);
  }
  void one(const DoubleDouble& x) { add(x.hi, x.lo); }
  template <typename T, typename = decltype(std::declval<T>().begin())>
  requires(!std::is_same_v<T, Vec3>) void one(const T& list) {
    word(list.size());
    for (const auto& value : list) one(value);
  }

  // Every member: a new one does not compile.
  void one(const Volume& volume) {
    const auto& [shape, half] = volume;
    add(shape, half);
  }
  void one(const State& state) {
    const auto& [time, position, velocity, mass, radius, volume, part_of, fired] = state;
    add(time, position, velocity, mass, radius, volume, part_of, fired);
  }
  void one(const Collision& collision) {
    const auto& [time, kind, a, b, position, normal, approach, separation, e, impulse, lost] = collision;
    add(time, kind, a, b, position, normal, approach, separation, e, impulse, lost);
  }
  void one(const PathPiece& piece) {
    const auto& [body, from, start, x, v, a, fade, law, rounding, kicked, until, kick, curve, part_of, removed, joint,
                 mass, radius, half] = piece;
    add(body, from, start, x, v, a, fade, law, rounding, kicked, until, kick, curve != nullptr);
    add(part_of, removed, joint, mass, radius, half);
    if (!curve) return;
    const auto& [length, is_parabola, displacement, ahead] = *curve;
    add(length, is_parabola, displacement, ahead);
  }
  void one(const RegionCrossing& crossing) {
    const auto& [time, region, body, enters] = crossing;
    add(time, region, body, enters);
  }
  void one(const Extremes& extremes) {
    const auto& [least, greatest, integral, seconds] = extremes;
    add(integral.value(), seconds.value());
    for (const Extreme& extreme : {least, greatest}) {
      const auto& [value, time, then] = extreme;
      add(value, time, then);
    }
  }
  void one(const ContactForce& contact) {
    const auto& [a, b, force] = contact;
    add(a, b, force);
  }

  void one(const Tally& tally) {
    const auto& [body_body, body_fixed, merges, tautened, collapses, first, last, lost, method_error, work, force_work,
                 doubts, overlap, fastest, resting, stepped, taken_up, shared, changes, end] = tally;
    add(body_body, body_fixed, merges, tautened, collapses, first, last, lost, method_error, work, force_work);
    add(doubts, overlap, fastest, resting, stepped, taken_up, shared, changes.removed, changes.appeared, changes.fired);
    add(end.has_value());
    if (!end) return;
    const auto& [time, reason, region] = *end;
    add(time, reason, region);
  }
  void one(const Doubts& doubts) {
    const auto& [contacts, made, steps, unsolved, stiffest, unbalanced] = doubts;
    const auto& [phase, length, time, body, x, v] = stiffest;
    const auto& [acceleration, way, other] = unbalanced;
    add(contacts, made, steps, unsolved, phase, length, time, body, x, v, acceleration, way, other);
  }
  void one(const Fastest& fastest) {
    const auto& [speed, body] = fastest;
    add(speed, body);
  }
  void one(const TakenUp& taken_up) {
    const auto& [impacts, fastest, energy] = taken_up;
    add(impacts, fastest, energy);
  }
  void one(const SharedImpacts& shared) {
    const auto& [instants, ties, without_room, absorbed, first, body, a, b] = shared;
    add(instants, ties, without_room, absorbed, first, body, a, b);
  }
  void one(const Passage& removed) {
    const auto& [bodies, energy, momentum] = removed;
    add(bodies, energy, momentum);
  }

  uint64_t hash_ = 0xcbf29ce484222325;
};

/// All that a simulator shows after an advance.
struct Shown {
  string error;     // empty: none
  double time = 0;  // s
  uint64_t state = 0, collisions = 0, paths = 0, crossings = 0, tally = 0, extremes = 0, impulses = 0, contacts = 0;

  friend bool operator==(const Shown&, const Shown&) = default;
};

inline std::ostream& operator<<(std::ostream& out, const Shown& shown) {
  return out << "t = " << shown.time << " " << shown.error << std::hex << " state " << shown.state << " collisions "
             << shown.collisions << " paths " << shown.paths << " crossings " << shown.crossings << " tally "
             << shown.tally << " extremes " << shown.extremes << " impulses " << shown.impulses << " contacts "
             << shown.contacts;
}

inline uint64_t hash_of_bits(const auto& values) {
  BitHash hash;
  hash.add(values);
  return hash.value();
}

inline Shown shown_by(Simulator& simulator) {
  Shown shown;
  shown.time = simulator.time();
  shown.state = hash_of_bits(simulator.state());
  shown.collisions = hash_of_bits(simulator.collisions());
  shown.paths = hash_of_bits(simulator.paths());
  shown.crossings = hash_of_bits(simulator.crossings());
  shown.tally = hash_of_bits(simulator.tally());
  shown.extremes = hash_of_bits(simulator.extremes());
  shown.impulses = hash_of_bits(simulator.impulses());
  shown.contacts = hash_of_bits(simulator.contacts());
  return shown;
}

/// One call of advance_to. An error is a part of what is shown, and the last.
inline Shown advance(Simulator& simulator, double time) {
  try {
    simulator.advance_to(time);
    return shown_by(simulator);
  } catch (const SimulationError& error) {
    Shown shown;
    shown.error = error.what();
    return shown;
  }
}

using MakeSimulator = function<unique_ptr<Simulator>()>;

inline unique_ptr<Simulator> restored(const MakeSimulator& make, const string& bytes) {
  unique_ptr<Simulator> simulator = make();
  simulator->restore(bytes);
  return simulator;
}

/// The run through these times (s), each reached by one call or by several. `between` may replace the simulator between
/// two calls, and before the first.
inline vector<Shown> run_through(const MakeSimulator& make, const vector<double>& times,
                                 const function<void(unique_ptr<Simulator>&)>& between) {
  unique_ptr<Simulator> simulator = make();
  vector<Shown> all = {shown_by(*simulator)};
  between(simulator);
  for (const double time : times)
    while (simulator->time() < time) {
      all.push_back(advance(*simulator, time));
      if (!all.back().error.empty()) return all;
      between(simulator);
    }
  return all;
}

/// Four runs are the same: one that is never saved, one that is saved between all advances, one that is restored from
/// the last one's bytes each time, and one that is restored once, after so many advances.
inline void expect_same_when_restored(const MakeSimulator& make, const vector<double>& times, size_t once) {
  const vector<Shown> plain = run_through(make, times, [](const auto&) {});

  vector<string> states;
  const vector<Shown> saved = run_through(make, times, [&](auto& simulator) {
    states.push_back(simulator->save());
    EXPECT_EQ(shown_by(*restored(make, states.back())), shown_by(*simulator));
  });
  EXPECT_EQ(saved, plain) << "saving has changed the run";

  size_t k = 0;
  const vector<Shown> always = run_through(make, times, [&](auto& simulator) {
    const string bytes = simulator->save();
    EXPECT_TRUE(k < states.size() && bytes == states[k]) << "other bytes after advance " << k;
    ++k;
    simulator = restored(make, bytes);
  });
  EXPECT_EQ(always, plain) << "restored again and again";

  once %= states.size();
  size_t at = 0;
  const vector<Shown> restored_once = run_through(make, times, [&](auto& simulator) {
    if (at++ == once) simulator = restored(make, states[once]);
  });
  EXPECT_EQ(restored_once, plain) << "restored after advance " << once;
}

}  // namespace carom
