#pragma once
// Impacts of bodies that touch others when they are struck, and impacts along strings: all that happens at one instant,
// in rounds (impact_set.h).
//
// The set begins with the impacts that are due. It grows by what touches a body that approaches something or has been
// struck, and by what strings and rods connect with it. Every round applies to the bodies before the next one: flights
// begin, sleepers wake, bodies come to rest. Members of crowds are not taken in. Their impacts are those
// of two (exact_impacts.h).

#include "physics/restitution.h"
#include "simulate/contact/flat_contacts.h"
#include "simulate/contact/numbering.h"
#include "simulate/impact/impact_parts.h"
#include "simulate/impact/impact_set.h"
#include "simulate/path/exact_event.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

class ImpactRules;
struct State;

class InstantImpacts {
 public:
  InstantImpacts(ExactBodies& bodies, const ImpactParts& parts, ImpactRules& rules)
      : bodies_(bodies),
        parts_(parts),
        rules_(rules),
        some_act_at_once_(bodies.ties.any() || may_be_plastic(bodies.world)) {}

  /// Returns the time by which rounding of places may separate impacts of one instant (s).
  double close_times(const State& initial) const;
  /// Whether impacts of some pairs, although they are alone at first, belong together with all that touches: those with
  /// e = 0, and those beside strings and rods.
  bool some_act_at_once() const { return some_act_at_once_; }
  /// An impact that is due at the present instant.
  struct Due {
    Entity body;
    Entity thing;  // a body, a fixed thing or a string
    uint8_t feature;
  };
  /// Resolves it, and with it all that it causes at this instant and that happens to what touches, also through others.
  /// Returns false, and changes nothing, where it is an impact of two: nothing else approaches what touches them, and
  /// no string holds them.
  bool strike(const Due& due);

 private:
  /// Two things that touch: a row of the set.
  struct Touching {
    Entity a;
    Entity thing;
    uint8_t feature;
    Touch there;
    bool counted = false;  // towards a collapse, at this instant
    // Decided for the next round.
    bool ends = false;    // in lasting contact
    bool rests = false;   // on a flat surface
    bool pressed = true;  // something drives the two together
    FlatContact contact{};
    double e = 0;       // the pair's
    double press = 0;   // m/s^2
    double length = 0;  // m
    size_t record = none;
  };
  /// What is to be recorded of a row: all its impulses with e = 0, or those of one round.
  struct Record {
    uint32_t row;
    bool ends;  // in contact, so that it leaves nothing
    double e;
    double approach;    // m/s
    double separation;  // m/s
    double impulse;     // N s
    double lost;        // J
  };
  static constexpr size_t none = ~size_t{0};
  using Rows = vector<uint32_t>;

  /// The set of one instant.
  struct Moment {
    Moment(Numbering::Numbers& numbers, bool one_by_one) : members(numbers), set(one_by_one) {}

    Numbering members;
    ImpactSet set;
    vector<Touching> touching;  // by row
    vector<uint8_t> gathered;   // by member: its rows are in the set
    vector<uint8_t> struck;     // by member
    vector<uint8_t> resting;    // by member: flat surfaces that carry it from the present round on
    vector<Record> records;
    double absorbed = 0;  // J, for want of room
  };

  uint32_t member_number(Moment& now, Entity i) const;
  void gather(Moment& now, Entity i) const;
  void gather_strings(Moment& now, Entity i) const;
  void add_row(Moment& now, Entity a, Entity thing, const Touch& there, ImpactSet::Kind kind) const;
  static bool is_known(const Moment& now, Entity a, Entity thing);
  void add_due(Moment& now, const Due& due) const;
  double near_gap(Entity i, Entity thing) const;
  void gather_all(Moment& now) const;
  bool may_strike(const Moment& now, uint32_t c) const;
  bool meets_by_volume(const Touching& row, const Vec3& velocity) const;
  bool presses(const Touching& row) const;
  bool leaves_asleep(const Touching& row) const;
  Rows find_approaching(Moment& now) const;
  void end_steps(Moment& now, const Rows& approaching);
  void check_room(const Moment& now) const;
  void decide(Moment& now, uint32_t c);
  void decide_string(Touching& row);
  void decide_pair(Touching& row);
  void decide_fixed(Moment& now, Touching& row);
  void apply(Moment& now, span<const ImpactSet::Impact> impacts, bool last);
  void begin_flights(Moment& now, span<const ImpactSet::Impact> impacts);
  void unite_ended(Moment& now, span<const ImpactSet::Impact> impacts);
  void hold_string(Moment& now);
  void note(Moment& now, const ImpactSet::Impact& impact, bool last) const;
  void share_gains(Moment& now);
  void note_open(const Moment& now);
  void book(Moment& now);

  ExactBodies& bodies_;
  const ImpactParts parts_;
  ImpactRules& rules_;
  const bool some_act_at_once_;
};

}  // namespace carom
