#pragma once
// The exact simulator's own parts. Its source files share this class: exact.cpp (the loop), exact_predict.cpp (what
// comes next for a body), exact_resolve.cpp (impacts), exact_rest.cpp (rest on flat surfaces), exact_crowd.cpp (bodies
// in contact with one another), exact_follow.cpp and exact_stride.cpp (how few and how many of them move),
// exact_merge.cpp, exact_ahead.cpp (what memory is asked for ahead of its time), exact_paths.cpp (paths as recorded).
//
// Each body keeps its Flight and is not moved when somebody else collides. Each body keeps one Event, the first of its
// own; the first of all of these is the next thing to happen. A predicted collision is a function of the two flights
// alone, so it has the same bits from whichever side, and whenever, it is computed: neither outputs nor the search for
// neighbours can change it.
#include <array>
#include <memory>
#include <vector>

#include "physics/complementarity.h"
#include "physics/touch.h"
#include "simulate/by_need.h"
#include "simulate/event_log.h"
#include "simulate/exact.h"
#include "simulate/flight.h"
#include "simulate/large_pages.h"
#include "simulate/neighbours.h"
#include "simulate/straight_times.h"
#include "simulate/tournament.h"

namespace carom {

class ExactSimulator final : public Simulator {
 public:
  ExactSimulator(const World& world, const State& initial, const ExactOptions& options);

  void advance_to(double time) override;
  double time() const override { return time_; }
  const State& state() override;
  std::span<const Collision> collisions() const override { return log_.collisions(); }
  std::span<const PathPiece> paths() const override { return paths_; }
  const Tally& tally() const override { return log_.tally(); }
  Effort effort() const override;
  std::span<const ContactForce> contacts() override;

 private:
  // In the order in which events of one instant happen.
  enum class Kind : std::uint8_t {
    force,       // a force on the body sets in or ceases
    rest,        // bounces end: a line in the record
    release,     // a body slides off a wall's face
    step,        // of the crowd: no impact, but new forces
    body_fixed,  //
    body_body,   //
    none
  };

  struct Event {
    Instant time{never, 0};
    Entity partner = no_entity;
    std::uint16_t partner_version = 0;
    Kind kind = Kind::none;
    std::uint8_t feature = no_feature;
  };

  /// What a flight began with: whom the body has just struck.
  struct Origin {
    Entity partner = no_entity;
    std::uint8_t feature = no_feature;
  };

  /// What a body of the crowd has to do with it.
  enum class Place : std::uint8_t { outside, crowd, asleep };

  /// What events need to know of a body, apart from its flight.
  struct Body {
    Event event;
    std::uint16_t version = 1;  // counts its flights, and never is 0
    Place place = Place::outside;
    std::uint8_t origin_feature = no_feature;
    Entity origin = no_entity;
    Origin from() const { return {origin, origin_feature}; }
    void set_origin(const Origin& it) {
      origin = it.partner;
      origin_feature = it.feature;
    }
  };
  static_assert(sizeof(Body) == 32);

  /// Flat surfaces that carry a body.
  struct Contact {
    Entity surface;
    std::uint8_t feature;   // of the pair (touch.h; of a ball and a wall: contact_time.h)
    Vec3 normal;            // unit, from the surface to the body
    bool settling;          // its `rest` is still to come, at
    Instant rest_time;      //
    double residual_speed;  // m/s, what the last bounce left
  };
  static constexpr std::size_t max_contacts = 4;
  struct Contacts {
    std::array<Contact, max_contacts> at;
    std::size_t count = 0;
  };

  /// A body's slow impacts with others that came one upon the other.
  struct Burst {
    double start = 0;  // s
    int impacts = 0;
    bool bodies = false;  // with bodies among them, not with flat fixed surfaces alone
  };

  /// A body's impacts on the spot.
  struct Collapse {
    Instant start;
    int impacts = 0;             // with e < 1, and not twice running with the same thing
    double lost = 0;             // the sum of 1 - e, at least 0
    Instant taken_up{never, 0};  // the last that contact has taken up for that
  };

  static constexpr const char* too_fast =
      "restitution above 1 makes energy at every collision; lower it, or shorten simulate.duration";
  static constexpr double immovable = never;     // kg
  static constexpr double hardly_moving = 1e-5;  // of the speed of falling by a radius: in a crowd as good as none
  static constexpr double restless_gap = 2e-2;   // of a radius: what bodies that were just struck are kept apart
  /// m/s: a speed as good as none, for products of it with itself underflow.
  double negligible_speed() const { return 0x1p-200 * log_.tally().max_speed; }
  /// Whether a speed (m/s) against a pressing acceleration (m/s^2) lifts a body by less than its position x (m) is
  /// rounded to.
  static bool too_low(const Vec3& x, double speed, double press) {
    return speed * speed < press * 0x1p-48 * x.cwiseAbs().sum();
  }

  /// m/s^2: what forces do to a body, and the part of it that does work.
  struct Pull {
    Vec3 all, working;
  };

  /// One end of a pressing pair of the crowd: a's list has b.
  struct Pressed {
    Entity partner;
    double force;  // N
  };

  /// Whether what is next for a body is not its event, but that it leaves its region.
  bool leaves_first(Entity i) const { return queue_.time(i) < body_[i].event.time.hi; }
  /// After the duration nothing is due.
  void enqueue(Entity i) {
    const double next = std::min(body_[i].event.time.hi, leave_time(i));
    queue_.update(i, next <= options_.duration ? next : never);
  }
  void new_version(Entity i);
  bool before(Entity i, Entity j) const;
  struct Before {
    const ExactSimulator* simulator;
    bool operator()(std::uint32_t i, std::uint32_t j) const { return simulator->before(i, j); }
  };

  // exact.cpp
  void process(Entity i);
  void restart(Entity i, const Vec3& x, const Vec3& v, Origin origin);
  void book_flight(Entity i, const Vec3& x);
  Pull pull_on(Entity i) const;
  void switch_forces(Entity i);
  void start(const State& initial);
  Vec3 velocity_now(Entity i, const Instant& at) const;
  void look_ahead();
  void check_limits(Kind kind);  // none: a region was left

  // exact_predict.cpp
  void predict(Entity i);
  void predict_all();
  void predict_among(Entity i, std::span<const Entity> bodies);
  Instant pair_time(Entity i, Entity j, std::uint8_t& feature) const;
  Instant fixed_time(Entity i, Entity surface, std::uint8_t& feature) const;
  void offer(Entity i, Event& best, Event candidate) const;
  void meet_each(Entity i, std::span<const Entity> others, Event& best);
  void meet_bodies(Entity i, std::span<const Entity> others, Event& best);
  void rebuild_region(Entity i);
  double leave_time(Entity i) const;
  double next_force(Entity i) const;

  std::vector<Entity> known_to(Entity i) const;

  // exact_resolve.cpp
  void collide_pair(Entity a, Entity b, std::uint8_t feature);
  void collide_fixed(Entity i, Entity surface, std::uint8_t feature);
  Touch touch_at(Entity a, const Vec3& xa, Entity b, const Vec3& xb, std::uint8_t feature) const;
  bool taken_up(Entity a, Entity b, double e, double approach, double press, double length, bool alone);
  bool in_burst(Entity i, double window, int many);
  bool too_slow_to_wake(Entity striker, Entity struck, double speed) const;
  void stop_at(Entity striker, Entity struck, std::uint8_t feature, const Touch& there, double approach);
  bool collapses(Entity i, Entity other, double e, double approach, double length);
  double slow_speed(double press, double length) const;
  double load_on(Entity i) const;

  // exact_rest.cpp
  void settle(Entity i, const Contact& contact);
  void release(Entity i, Entity surface, std::uint8_t edge);
  void finish_rest(Entity i);
  Vec3 keep_contacts(Entity i, Vec3 v);
  Vec3 contact_acceleration(Entity i);
  Vec3 free_acceleration(Entity i, Entity without) const;
  void touch_down(Entity i);
  void lean_together(Entity i);
  bool in_contact(Entity i, Entity surface) const;
  void report_rest(Entity i);

  // exact_merge.cpp
  void merge(Entity a, Entity b, const Touch& touch);
  double potential_of(Entity i, const Vec3& x) const;  // J

  // exact_crowd.cpp
  void join(Entity i);
  void stir(Entity i, double approach);
  double approach_now(double approach, const Vec3& n, Entity i, Entity e) const;
  void hasten(Entity i, const Vec3& dv);
  bool strikes(Entity i, Entity e, double approach, double pull) const;
  void wake(Entity i);
  void jostle(Entity i);
  void step_crowd();
  void carry(Entity i, bool carried);
  bool crowded(Entity e) const { return world_.is_body(e) && body_[e].place != Place::outside; }

  // exact_stride.cpp
  struct Stride;
  void stride();
  void find_pairs(Stride& step);
  void move_apart(Stride& step);
  void find_parts(Stride& step);
  void put_to_rest(Stride& step);
  void take_stride(const Stride& step);

  // exact_follow.cpp
  bool follow_crowd();
  bool followed(Entity i, Entity e) const;
  void report_followed();

  // exact_paths.cpp
  /// Before body i gets another path at this instant, or anything that its path is made of changes.
  void path_changes(Entity i) {
    if (options_.record_paths) [[unlikely]]
      note_path(i);
  }
  void note_path(Entity i);
  void record_paths();

  const World* given_;                  // before any merging
  std::unique_ptr<World> joint_world_;  // where bodies merge: with the joint bodies' masses and volumes
  const World& world_;
  const ExactOptions options_;
  const Bounds bounds_;
  const bool same_radius_;  // of all bodies, for good
  Instant now_;
  double time_ = 0;  // s, how far advance_to has come

  ByNeed<Vec3> pull_;    // m/s^2, by body: gravity and the forces of now,
  ByNeed<Vec3> driven_;  // and the part of it that does work (force.h)
  Flights flight_;
  LargeVector<Body> body_;
  Neighbours neighbours_;
  OneByOne<Contacts> contacts_;  // with flat fixed surfaces
  ByNeed<Burst> burst_;
  ByNeed<Collapse> collapse_;
  Tournament<Before> queue_;
  std::vector<Tournament<Before>::Due> due_;                 // what was due next when it was last asked for, in order
  std::size_t next_due_ = 0, due_events_ = ~std::size_t{0};  // none was asked for yet
  double due_from_ = 0, due_reach_ = 0;                      // s
  std::vector<Entity> alike_;                                // scratch
  std::vector<Meet> meets_;                                  // scratch

  ByNeed<std::vector<Pressed>> pressed_;   // by the lower body: bodies and fixed things that the crowd's last step
                                           // found pressing on it
  std::vector<Entity> crowd_;              // ascending after each step
  ByNeed<std::uint32_t> local_;            // scratch of a step: a member's place in it
  ByNeed<Instant> pulled_;                 // by body of the crowd: forces are in its velocity up to this instant
  ByNeed<std::uint32_t> jostled_;          // by body of the crowd: impacts taken up since the last step
  ByNeed<std::uint8_t> idle_;              // by body of the crowd: steps since something pressed on it
  ByNeed<Vec3> hastened_;                  // m/s^2, by body of the crowd: what forces do to it in a stride, on
                                           // average; it is in its velocity from the start
  ByNeed<double> kept_apart_;              // m, by body of the crowd: the gap that strides leave about it
  std::size_t jostled_pairs_ = 0;          // since the last step
  double crowd_step_ = 0;                  // s, length of the last step
  std::uint32_t stuck_ = 0;                // strides on end that jostling ended at once
  ByNeed<std::uint8_t> carried_;           // by body: of the crowd or asleep, and something presses on it
  ByNeed<Instant> needed_;                 // by body of the crowd: when it was last struck or pressed on, but by
                                           // flat surfaces alone
  bool following_ = false;                 // the last step was of follow_crowd
  ByNeed<std::vector<Entity>> followed_;   // by body: whom it is in contact with until the step ends
  Instant arrival_time_;                   // when the step ends if nothing happens before
  ByNeed<Vec3> arrival_;                   // m/s, by body: its velocity when the step ends,
  ByNeed<std::uint16_t> arrival_version_;  // if it is still on this flight
  Instant crowd_end_{never, 0};            // when the next step is due

  State state_;
  bool state_fresh_ = false, ended_ = false;
  EventLog log_;
  std::vector<PathPiece> paths_;
  std::vector<Entity> changed_;  // whose paths are to be recorded as they are when all that happens
  Instant changed_at_;           // at this instant has happened
  bool full_ = false;            // paths_ is
  Effort effort_;
  std::vector<Entity> part_of_;             // empty: nothing has merged
  std::vector<std::vector<Entity>> parts_;  // by joint body: itself and what has become part of it
  std::vector<double> joint_share_;         // by body: its own mass over its joint body's
  std::vector<ContactForce> contact_forces_;

  /// How the clock goes on from event to event.
  struct Watch {
    std::uint64_t events = 0;
    double since = 0;  // s, the clock when it was last found to go on,
    double seen = -1;  // and when it was last looked at
  };
  Watch patient_, impatient_;
  double struck_ = 0;     // restitution of the last impact
  double liveliest_ = 0;  // the greatest of late
};

}  // namespace carom
