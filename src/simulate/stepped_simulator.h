#pragma once
// The stepped simulator's own parts. Its source files share this class: stepped.cpp (steps, records, state),
// stepped_motion.cpp (paths through a step), stepped_meet.cpp (who meets whom in it), stepped_impact.cpp (impacts),
// stepped_bind.cpp (bodies that press on one another), stepped_crowd.cpp (many of them), stepped_rest.cpp (how these
// come to rest).
//
// A step integrates every body from one instant to the next as if nothing were in its way, which gives a path. The
// first meeting of two paths is found (path_meeting.h); both bodies take their step again, shorter, up to there,
// collide, and take another for what is left of it; and so on until no paths meet. So no impact is moved to a step's
// end, and the order of the method outlasts it. Bodies that nothing touches know nothing of the others' impacts.
//
// Bodies in lasting contact make a cluster: they take their steps together, with contact forces that keep to each other
// those that press on each other (hold), found anew wherever the method asks for accelerations, and at the step's end
// they are set on each other's surfaces again. A contact ends inside the step where its force turns to zero. Bounces
// shorter than a step are none: there contact begins. A cluster that nothing moves sleeps and costs nothing.
#include <queue>
#include <vector>

#include "physics/compensated.h"
#include "physics/complementarity.h"
#include "physics/path.h"
#include "physics/touch.h"
#include "simulate/neighbours.h"
#include "simulate/stepped.h"
#include "simulate/stepped_crowd.h"

namespace carom {

class SteppedSimulator final : public Simulator {
 public:
  SteppedSimulator(const World& world, const State& initial, const SteppedOptions& options);

  void advance_to(double time) override;
  double time() const override { return time_; }
  const State& state() override;
  std::span<const Collision> collisions() const override { return collisions_; }
  const Tally& tally() const override { return tally_; }
  std::span<const ContactForce> contacts() override;

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  enum class Kind : std::uint8_t { release, impact };  // in the order in which events of one instant happen

  /// What is to happen within the step, if a's and b's paths are still the same then.
  struct Event {
    double time;  // s, since the step's start
    Kind kind;
    Entity a, b;  // of a release too: the two that part
    std::uint8_t feature;
    std::uint32_t version_a, version_b;
    bool operator>(const Event& e) const {
      if (time != e.time) return time > e.time;
      if (kind != e.kind) return kind > e.kind;
      return a != e.a ? a > e.a : b > e.b;
    }
  };

  /// What a path began with: whom the body has just struck or left.
  struct Origin {
    Entity partner = no_entity;
    std::uint8_t feature = no_feature;
  };

  /// Two things in lasting contact.
  struct Bond {
    Entity a, b;
    std::uint8_t feature;  // as in Touch
    bool presses;          // it is held; else the two only must not come nearer
    double force;          // N, when the path began
  };

  /// Bodies that are bound to one another or to fixed things.
  struct Cluster {
    std::vector<Entity> members;  // ascending; empty: not in use
    std::vector<Bond> bonds;
    bool asleep = false;
    bool woken = false;  // struck, and too large to wake before the step's end
  };

  static constexpr std::size_t most_members = 24;  // of a cluster; more are a crowd

  /// One end of a pressing pair of the crowd: a's list has b.
  struct Pressed {
    Entity partner;
    double force;  // N
  };

  /// A cluster's members in numbers of their own, where its equations are solved.
  struct Motion {
    std::vector<Vec3> x, v, end_x, end_v;
    std::vector<Path> path;
  };

  /// Where a body's path begins, and how far its surface may be from there on it, at most (m).
  struct Spot {
    Vec3 x;
    double reach;
  };

  /// A path of this step that an impact has cut short.
  struct Piece {
    Entity body;
    double from, to;  // s, since the step's start
    Path path;        // at `from`
    Vec3 end_v;       // m/s, at `to`
    bool in_company;
  };

  // stepped.cpp
  void do_step();
  void end_step();
  double next_time(double from);
  void record(const Collision& collision);
  void lose(double energy);

  // stepped_motion.cpp
  Vec3 free_acceleration(Entity i, const Vec3& x, const Vec3& v) const;
  void take(Entity i, double length, Vec3& x, Vec3& v, Path& path) const;
  void begin_path(Entity i);
  void accelerate(const Cluster& cluster, const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Vec3>& a,
                  std::vector<PressedPair>& pairs) const;
  std::vector<double> inverse_masses(const Cluster& cluster) const;
  void set_on_surfaces(const Cluster& cluster, Motion& motion) const;
  void move(const Cluster& cluster, double length, Motion& motion) const;
  Motion gather(const Cluster& cluster) const;
  void begin_paths(Cluster& cluster);
  void hold_more(Cluster& cluster, double length, Motion& motion) const;
  void bring(Entity i, double time);
  double cut(Entity i, double time, const Vec3& x, const Vec3& v);
  double book_work(Entity i, const Vec3& x, const Vec3& v, double length);

  // stepped_meet.cpp
  void stay_known(Entity i);
  void predict(Entity i, bool all);
  void predict_pair(Entity i, Entity e);
  void predict_releases(std::uint32_t cluster);
  bool bound(Entity a, Entity b) const;
  Path path_of(Entity e, double time) const;
  Vec3 position_of(Entity e) const { return world_.is_body(e) ? x_[e] : world_.fixed_position(e); }
  Vec3 velocity_of(Entity e) const { return world_.is_body(e) ? v_[e] : Vec3(Vec3::Zero()); }

  // stepped_impact.cpp
  void process(const Event& event);
  double refined(const Event& event) const;
  void collide(const Event& event);
  void stop_at_crowd(Entity still, Entity comes, double time);
  Vec3 acceleration_of(Entity e) const;
  bool slow(double e, double approach, double press) const;
  bool taken_up(Entity a, Entity b, double e, double approach, double press, double noise);

  // stepped_bind.cpp
  void dissolve(std::uint32_t cluster, double time, std::vector<Entity>& members);
  bool leans(Entity a, const Vec3& xa, const Vec3& va, Entity b, const Vec3& xb, const Vec3& vb, Touch& there) const;
  void grow(std::vector<Entity>& group, double time);
  void bind(std::vector<Entity>& group, double time, const Event* met, bool parts);
  std::vector<Bond> settle(const std::vector<Entity>& group, const Event* met, bool parts);
  void gather_clusters(const std::vector<Entity>& group, const std::vector<Bond>& bonds);
  void go_on(const std::vector<Entity>& group);
  std::uint32_t new_cluster();

  // stepped_crowd.cpp
  void join(Entity i);
  void park(Entity i, Entity e);
  void look_around(Entity i, double haste);
  std::vector<Entity> find_crowd();
  void find_contacts(Crowd& crowd) const;
  static bool solve(Crowd& crowd, std::vector<Vec3>& u, int sweeps, int iterations);
  void find_velocities(Crowd& crowd);
  void find_ways(Crowd& crowd);
  double way_slack(const Crowd& crowd) const;
  double known_force(Entity a, Entity b) const;
  void step_crowd();
  void record_strikes(const Crowd& crowd);
  enum class Balance : std::uint8_t { found, sinking, none };
  Balance find_balance(Crowd& part);
  void stand(const Crowd& part);
  void put_to_rest(const Crowd& crowd);
  void fall_asleep(const Crowd& part);
  /// Whether a contact of the crowd lasts, between bodies that do not sleep.
  bool carries(const CrowdContact& c) const { return !c.strikes && c.impulse > 0 && cluster_of_[c.a] == none; }
  bool in_company(Entity i) const { return cluster_of_[i] != none || in_crowd_[i]; }
  bool crowded(Entity e) const { return world_.is_body(e) && in_crowd_[e]; }

  static constexpr const char* too_fast =
      "use a smaller simulate.step, an attractor with `softening`, or restitution of at most 1";

  const World& world_;
  const SteppedOptions options_;
  const Bounds bounds_;
  std::vector<double> switches_;  // s, ascending: when forces set in or cease
  std::uint64_t steps_ = 0;       // of options_.step that have begun
  double from_ = 0, to_ = 0;      // s: the present step,
  double length_ = 0;             // s, and its length
  double time_ = 0;               // s, asked for

  std::vector<Vec3> x_, v_;          // m, m/s: where a body's path begins,
  std::vector<double> start_;        // s, since the step's start: when,
  std::vector<Path> path_;           // how it goes on to the step's end,
  std::vector<Vec3> end_x_, end_v_;  // and that
  std::vector<Origin> origin_;
  std::vector<std::uint32_t> version_;  // counts a body's paths
  std::vector<std::uint32_t> cluster_of_;
  std::vector<std::uint32_t> impacts_;   // of a body in this step, with e < 1,
  std::vector<std::uint32_t> meetings_;  // and of whatever kind
  std::vector<Spot> spot_;
  std::vector<double> alone_until_;      // m, on the same scale as gone_: before that a body meets nobody
  double gone_ = 0;                      // m, at least as far as any body has gone until the step began,
  double goes_ = 0;                      // and goes in it
  std::vector<std::uint8_t> crowd_;      // steps for which a body is of the crowd yet
  std::vector<std::uint8_t> in_crowd_;   // in this step
  std::vector<Entity> host_;             // with whom a body goes along until the step ends; itself: it stands
  std::vector<std::uint32_t> calm_;      // steps for which a body of the crowd has hardly moved
  std::vector<std::uint32_t> patience_;  // how often it was looked in vain whether a part, by its first body, rests
  double slack_ = 1e-3;                  // of a radius: by how much bodies of the crowd may overlap
  double unrest_ = 1;                    // the crowd's speed, on average, by that of falling by a radius
  Crowd now_;                            // of the present step
  std::vector<std::vector<Pressed>> pressed_;  // by the lower body of the crowd: who pressed in its last step
  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> unused_;  // clusters
  std::vector<Entity> awake_;          // whose paths go anywhere; ascending where a step begins
  std::vector<std::uint8_t> is_awake_;
  std::vector<Piece> pieces_;             // of the present step
  bool some_sleep_ = false;               // some cluster does
  bool loaded_ = false;                   // there is gravity, or a force
  double shortest_hop_ = options_.step;   // s, of a bounce; a shorter one is none
  std::uint32_t restless_ = 16;           // lossy impacts of a body in a step under load: it is of the crowd
  std::uint32_t many_impacts_ = 256;      // of a body in a step: with e < 1 a collapse
  bool constant_ = true, works_ = false;  // all forces are constant; some force does work (force.h)
  Neighbours neighbours_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  std::vector<Vec3> pulled_;  // m/s^2, of a group that settles: what contact leaves of its accelerations
  mutable std::vector<std::uint32_t> local_;  // scratch: a member's place in its cluster's motion

  State state_;
  bool state_fresh_ = false;
  std::vector<Collision> collisions_;
  Tally tally_;
  Sum energy_lost_, work_;  // J
  std::vector<ContactForce> contact_forces_;
};

}  // namespace carom
