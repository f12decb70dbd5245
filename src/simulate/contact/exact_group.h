#pragma once
// Bodies of the exact simulator in lasting contact with each other or with things that are not flat. Their paths have
// no closed form. Each island moves in steps of its own: by constrained motion (constrained_motion.h), or as a
// crowd where contacts change too often (crowd_motion.h). This class holds the data of these bodies.

#include "simulate/contact/exact_bodies.h"
#include "simulate/contact/mode_changes.h"
#include "simulate/contact/numbering.h"
#include "std.h"

namespace carom {

class CollapseDetector;
class FlatContacts;
class PathLog;

/// One end of a contact with a force. The list of the lower body has the other end.
struct PressingContact {
  Entity partner;
  double force;        // N
  double surface = 0;  // m/s, of a partner that moves: its speed along the normal, away from the body

  void keep(auto& archive) { archive(partner, force, surface); }
};

/// A flat fixed thing that carries a body.
struct Floor {
  Vec3 normal;  // towards the body
  Entity surface;

  void keep(auto& archive) { archive(normal, surface); }
};

/// What an island keeps of a member from step to step.
struct IslandMember {
  // The last time at which it was struck, or pressed on by things other than flat surfaces.
  Instant needed;
  vector<Floor> floors;  // the flat fixed things that carry it
  double gap = 0;        // m: the widest gap at which things press on it while it sleeps

  void keep(auto& archive) { archive(needed, floors, gap); }
};

class ExactGroup {
 public:
  ExactGroup(ExactBodies& bodies, ModeChanges& modes, FlatContacts& flat, const CollapseDetector& collapses,
             PathLog& paths);

  LazyArray<vector<PressingContact>> pressing;  // by the lower body: what pressed on it in the last step
  Numbering::Numbers numbers;
  LazyArray<IslandMember> member;  // by body

  /// Puts body i into an island. If it sleeps, all that rest in contact with it wake too.
  void join(Entity i);
  /// Unites the islands of members a and b. The next step of the united island is due.
  void unite(Entity a, Entity b);
  /// The same, if one of them is fresh.
  void unite_fresh(Entity a, Entity b) {
    if (bodies_.mode(a) == Mode::fresh || bodies_.mode(b) == Mode::fresh) unite(a, b);
  }
  /// Wakes a sleeping body and all that rest in contact with it. They make up an island, which is a crowd if one has
  /// put them to rest: crowds leave gaps, and constrained motion would let bodies fall through these.
  void wake(Entity i);
  /// At the start, a body may touch others or a curved surface, without speed along the normal, and be pressed on.
  /// Such a body joins an island, and so does all that it touches.
  void join_initial(Entity first);
  /// The same for bodies that taut strings pull, and for those on rods. The tensions are those under the forces at the
  /// start: a taut string without tension holds nothing. Throws SimulationError where a string is too short.
  void join_by_strings();
  /// All bodies that forces between bodies connect with body i now, and i. Empty: it is alone.
  vector<Entity> coupled_with(Entity i) const;
  /// Puts bodies that forces connect into one island. Its next step is due.
  void couple(span<const Entity> all);
  /// Lets member i, whose impact has ended in contact, fall no more. The next step of its island is due.
  void await_step(Entity i);
  /// Notes an impact of body i, which a member needs for a while.
  void note_needed(Entity i) {
    if (is_member(bodies_.mode(i))) member.write(i).needed = bodies_.now;
  }
  /// Notes that an impact has let two members part, or that it has not. Until they meet again, their speed is no error
  /// of paths, however small it is.
  void note_parted(Entity a, Entity thing, bool parted);
  /// Whether the last impact of the two has let them part.
  bool has_parted(Entity a, Entity thing) const;
  /// Whether members i and e approach each other (m/s) for an impact of their own: not below `slow` (m/s), and one that
  /// bounces, or if they are `apart`. Contact must not take that speed.
  bool strikes(Entity i, Entity e, double approach, double slow, bool apart) const;

  /// The force between member i and a thing in the last step (N).
  double pressing_force(Entity i, Entity e) const;
  /// Takes body i out of its island, or out of what rests in contact with it: that wakes. Nothing is done to a free
  /// body. Returns one member of each island that has lost it. Their forces are to be found anew.
  vector<Entity> withdraw(Entity i);

  /// Whether body i cannot strike this fixed thing, because it lies behind one that constrained motion keeps the body
  /// on.
  bool hides(Entity i, Entity fixed) const;

  /// Whether something that presses on body i changes its velocity at the present instant.
  bool switches(Entity i) const;
  /// Stores the forces that press on body i from this instant on, and the power of the moving things among these.
  void note_forces(Entity i);
  /// Appends the forces of sleeping bodies.
  void report(Entity i, vector<ContactForce>& forces) const;

  void keep(auto& archive) { archive(pressing, member, parted_, many_parted_); }

 private:
  void enlist(Entity i);
  void forget_forces(Entity i);
  vector<Entity> asleep_beside(Entity i) const;
  void join_at_rest(Entity i);
  void check_length(Entity string, double gap) const;
  double initial_rounding(Entity string) const;
  double power(Entity i) const;
  void forget_apart();

  ExactBodies& bodies_;
  ModeChanges& modes_;
  FlatContacts& flat_;
  const CollapseDetector& collapses_;
  PathLog& paths_;
  vector<pair<Entity, Entity>> parted_;  // sorted
  size_t many_parted_ = 64;
};

}  // namespace carom
