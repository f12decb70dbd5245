// Lists of near pairs, from the regions of bodies (neighbours.h). A list holds until some body has gone as far as the
// list reaches. What is measured in each step is the gap along a normal whose half space contains the other body.
#include "simulate/crowd/crowd_list.h"

#include "physics/restitution.h"
#include "physics/world.h"
#include "simulate/contact/contact_list.h"
#include "simulate/crowd/crowd_slabs.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {
namespace tol = exact_tolerance;

/// Nearer surfaces are listed (m).
double CrowdList::surface_skin(const Crowd& crowd) const {
  return (bodies_.moving.any() ? 2 : 1) * crowd.list.reach;
}

void CrowdList::begin(Crowd& crowd, double need) const {
  CrowdReach& list = crowd.list;
  list.reach =
      clamp(tol::steps_of_list * need, tol::least_reach * crowd.smallest, tol::greatest_reach * crowd.smallest);
  list.reach = max(min(list.reach, list.most), tol::reach_of_need * need);
  list.most = never;
  list.room = max(surface_skin(crowd), tol::room_of_region * crowd.smallest);
  list.gone = 0;
  list.need = 0;
  list.listed = false;
}

vector<Entity> CrowdList::hold_regions(const Crowd& crowd, span<const Entity> members) {
  for (const Entity i : members) {
    const Vec3 x = bodies_.position(i);
    bodies_.hold_to_bounds(i, bodies_.now.hi, x, bodies_.velocity_without_kick(i, bodies_.now));
    bodies_.neighbours.stay(i, x, crowd.list.room);
  }

  // Each is looked at once.
  seen_.resize(bodies_.world.body_count());
  vector<Entity> looked(members.begin(), members.end());
  for (const Entity i : members) seen_[i] = 1;

  vector<Entity> near;
  for (const Entity i : members)
    for (const Entity e : bodies_.neighbours.bodies(i)) {
      if (seen_[e] != 0) continue;
      seen_[e] = 1;
      looked.push_back(e);
      const Mode mode = bodies_.mode(e);
      if (mode != Mode::asleep && !(is_member(mode) && bodies_.islands.same(e, i))) near.push_back(e);
    }
  for (const Entity e : looked) seen_[e] = 0;
  return near;
}

CrowdList::Outlook CrowdList::outlook(const Crowd& crowd, Entity e) const {
  Outlook all = Outlook::apart;
  const Entity first = crowd.members.front();
  for (const Entity m : bodies_.neighbours.bodies(e))
    if (is_member(bodies_.mode(m)) && bodies_.islands.same(m, first)) all = max(all, outlook_on(crowd, m, e));
  return all;
}

/// The same for one member. A member goes no farther than the list reaches. Another body keeps to its path, or to the
/// reach of its own crowd's list.
CrowdList::Outlook CrowdList::outlook_on(const Crowd& crowd, Entity member, Entity e) const {
  const Vec3 between = bodies_.position(e) - bodies_.position(member);
  const double sizes = bodies_.world.radius[member] + bodies_.world.radius[e];
  if (bodies_.mode(e) == Mode::stepped) {
    double reach = crowd.list.reach;
    for (const shared_ptr<Crowd>& its : bodies_.islands.of(e).crowds) reach += its->list.reach;
    if (!(between.norm() < sizes + reach)) return Outlook::apart;
    const double gap = touch(bodies_.world, member, bodies_.position(member), e, bodies_.position(e)).gap;
    return gap < reach ? Outlook::joins : Outlook::apart;
  }

  // The nearest point of its path, as a straight line, and how far the path bends from it.
  const Flight f = bodies_.flights[e];
  const double since = bodies_.now - f.start;
  const auto meets = [&](double time, double reach) {
    const Vec3 way = time * f.velocity(since);
    const double bend = 0.5 * time * time * max(f.greatest_acceleration(), f.acceleration(since).norm());
    const double along = way.squaredNorm() > 0 ? clamp(-between.dot(way) / way.squaredNorm(), 0.0, 1.0) : 0;
    return (between + along * way).norm() < sizes + bend + reach;
  };

  // Near enough, all that may come nearer are neighbours. Farther away that would depend on other bodies.
  const double left = crowd.list.reach - crowd.list.gone;
  if (!meets(crowd.list.sure - bodies_.now, left)) return Outlook::apart;
  if (between.norm() < sizes + crowd.list.room - crowd.list.gone) return Outlook::joins;
  return meets(crowd.step.length, left) ? Outlook::may_strike : Outlook::may_come;
}

/// Adds the pairs of member k with later bodies, and with sleeping and fixed things.
void CrowdList::list_member(const Crowd& crowd, uint32_t k, double skin, Pairs& pairs) const {
  const World& world = bodies_.world;
  const Entity i = crowd.members[k];
  const Vec3 x = crowd.position(k);
  const bool ball = world.volume.empty() || world.volume[i].shape == Shape::sphere;
  const size_t first = pairs.size();
  ContactList fixed;  // to find those that others hide

  const double soon = 2 * crowd.list.reach / tol::steps_of_list;  // m

  // A pair of this member, without forces yet.
  const auto add = [&](uint32_t b, Entity e, bool balls, double gap) {
    CrowdRows::Pair pair;
    pair.a = k;
    pair.b = b;
    pair.name = {i, e};
    pair.balls = balls;

    pair.inverse = 1 / world.mass[i] + (b != Numbering::none ? 1 / world.mass[e] : 0);
    pair.e = pair_restitution(world, i, e);
    const double slow = crowd.load > 0 || bodies_.options.rest_speed > 0
                            ? bodies_.slow_speed(crowd.load, bodies_.smaller_length(i, e))
                            : 0;
    pair.slow = pair.e < 1 ? slow : 0;
    pair.shell = CrowdRows::new_pair;
    pair.force = 0;
    pair.near = gap < soon;
    pairs.push_back(pair);
  };

  // Later members, and sleepers within reach.
  for (const Entity e : bodies_.neighbours.bodies(i)) {
    const uint32_t b = numbers_[e];
    const bool asleep = b == Numbering::none && bodies_.mode(e) == Mode::asleep;
    if (!asleep && (b == Numbering::none || e < i)) continue;
    const Vec3 xe = asleep ? bodies_.position(e) : crowd.position(b);
    const double within = asleep ? crowd.list.reach : skin;
    const double sizes = world.radius[i] + world.radius[e];
    const double squared = (xe - x).squaredNorm();
    if (squared >= (sizes + within) * (sizes + within)) continue;
    const bool balls = ball && (world.volume.empty() || world.volume[e].shape == Shape::sphere);
    const double gap = balls ? sqrt(squared) - sizes : touch(world, i, x, e, xe).gap;
    if (gap < within) add(b, e, balls, gap);
  }

  // Fixed things that no other one hides.
  for (const Entity e : bodies_.neighbours.surfaces(i)) {
    const Vec3 xe = bodies_.fixed_position(e);
    const Touch there = touch(world, i, x, e, xe);
    if (there.gap < surface_skin(crowd))
      fixed.add({k, ContactConstraint::fixed, there.normal}, {i, e, there.feature}, there.gap);
  }
  if (fixed.names.size() > 1) fixed.drop_hidden(bodies_, x, 0);
  for (const Contact& contact : fixed.names) add(Numbering::none, contact.e, false, 0);

  // The order of lists of neighbours has no effect.
  std::sort(pairs.begin() + ptrdiff_t(first), pairs.end(),
            [](const CrowdRows::Pair& p, const CrowdRows::Pair& q) { return p.name.e < q.name.e; });
}

/// Gives the new pairs, of so many members, the forces and shells that the same pairs have in the rows of `crowd`.
void CrowdList::take_over_forces(const Crowd& crowd, size_t members) {
  struct Kept {
    Entity e;
    double force;
    double shell;
  };

  // The rows of `crowd` are sorted by their first members.
  vector<uint32_t> start(members + 2, 0);
  const auto number = [&](size_t g, size_t lane) { return numbers_[crowd.rows.names[g][lane].a]; };
  crowd.rows.for_each([&](size_t g, size_t lane) {
    if (const uint32_t a = number(g, lane); a != Numbering::none) ++start[a + 2];
  });

  for (size_t a = 2; a < start.size(); ++a) start[a] += start[a - 1];
  vector<Kept> kept(start.back());
  crowd.rows.for_each([&](size_t g, size_t lane) {
    const uint32_t a = number(g, lane);
    if (a == Numbering::none) return;
    const RowState& state = crowd.rows.state[g];
    kept[start[a + 1]++] = {crowd.rows.names[g][lane].e, state.force[lane], state.shell[lane]};
  });

  // The same pair has the same second thing.
  for (CrowdRows::Pair& pair : pairs_)
    for (uint32_t k = start[pair.a]; k < start[pair.a + 1]; ++k)
      if (kept[k].e == pair.name.e) {
        pair.force = kept[k].force;
        pair.shell = kept[k].shell;
      }
}

void CrowdList::list(Crowd& crowd, span<const shared_ptr<Crowd>> before) {
  arrange_in_slabs(crowd, 2 * crowd.list.reach);
  const Numbering members(numbers_, crowd.members);

  vector<Pairs> of_slab(crowd.rows.first.size() - 1);
  threads_.each_slab(crowd.rows, [&](size_t slab) {
    for (uint32_t k = crowd.rows.first[slab]; k < crowd.rows.first[slab + 1]; ++k)
      list_member(crowd, k, 2 * crowd.list.reach, of_slab[slab]);
  });
  pairs_.clear();
  for (Pairs& pairs : of_slab) {
    pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
    pairs = {};  // a large crowd has many
  }

  for (const shared_ptr<Crowd>& other : before) take_over_forces(*other, crowd.members.size());
  for (CrowdRows::Pair& pair : pairs_) pair.near = pair.near || pair.force > 0;
  write(crowd, pairs_);
}

void CrowdList::list_part(Crowd& part) {
  arrange_in_slabs(part, 2 * part.list.reach);
  const Numbering members(numbers_, part.members);

  Pairs pairs;
  for (const CrowdRows::Pair& pair : pairs_) {
    const uint32_t a = numbers_[pair.name.a];
    if (a == Numbering::none) continue;
    pairs.push_back(pair);
    pairs.back().a = a;
    if (pair.b != Numbering::none) pairs.back().b = numbers_[pair.name.e];
  }
  write(part, pairs);
}

/// The number of a fixed or sleeping thing in the present part of the crowd's rows. It is given one, unless it has one.
uint32_t CrowdList::number_of(Crowd& crowd, Entity thing) {
  uint32_t& number = thing_number_[thing];
  if (number != Numbering::none) return number;
  number = crowd.movable() + uint32_t(crowd.things.size());
  crowd.things.push_back(thing);
  const bool body = bodies_.world.is_body(thing);
  crowd.x.push_back(four_of(bodies_.position_of(thing), body ? bodies_.world.radius[thing] : 0));
  crowd.v.push_back(four_of(body ? Vec3(Vec3::Zero()) : bodies_.fixed_velocity(thing), 0));
  return number;
}

/// Writes the rows of these pairs, part by part.
void CrowdList::write(Crowd& crowd, const Pairs& pairs) {
  if (thing_number_.empty()) thing_number_.assign(bodies_.world.entity_count(), Numbering::none);
  crowd.x.resize(crowd.members.size());
  crowd.v.resize(crowd.members.size());
  crowd.things.clear();

  vector<Pairs> of_part = pairs_of_parts(crowd.rows, pairs);
  for (Pairs& part : of_part) {
    const size_t first = crowd.things.size();
    for (CrowdRows::Pair& pair : part)
      if (pair.b == Numbering::none) pair.b = number_of(crowd, pair.name.e);
    for (size_t k = first; k < crowd.things.size(); ++k) thing_number_[crowd.things[k]] = Numbering::none;
  }

  const auto dummy = uint32_t(crowd.x.size());
  crowd.x.resize(crowd.x.size() + of_part.size());
  crowd.v.resize(crowd.v.size() + of_part.size());
  crowd.rows.clear();
  for (uint32_t p = 0; p < of_part.size(); ++p) crowd.rows.add_part(of_part[p], crowd.movable(), dummy + p);
  crowd.list.listed = true;
}

/// The gap of member k and thing e at present, along the normal that is best for a relative displacement (m). Volumes
/// that do not turn are apart along any axis along which their extents are, so that this is a choice.
Touch CrowdList::closest(const Crowd& crowd, size_t k, Entity e, const Vec3& xe, const Vec3& moved) const {
  const World& world = bodies_.world;
  const Entity i = crowd.members[k];
  const Vec3 x = crowd.position(k);
  Touch best = touch(world, i, x, e, xe);
  if (world.is_plane(e) || world.is_shell(e)) return best;

  // A normal counts if it leaves a wider gap after the displacement.
  double after = best.gap + best.normal.dot(moved);  // m
  const auto offer = [&](double gap, const Vec3& normal) {
    const double then = gap + normal.dot(moved);
    if (gap < 0 || !(then > after)) return;
    best.gap = gap;
    best.normal = normal;
    after = then;
  };

  // The face of a wall, or the axes along which two boxes are apart.
  const Volume volume = world.volume_of(i);
  if (world.is_wall(e)) {
    const Vec3& n = world.wall(e).normal;
    const double off = n.dot(x - xe);
    offer(std::abs(off) - volume.support(n), off > 0 ? Vec3(-n) : n);
    return best;
  }

  const Volume other = world.volume_of(e);
  for (int axis = 0; axis < 3; ++axis) {
    const double off = xe[axis] - x[axis];
    Vec3 normal = Vec3::Zero();
    normal[axis] = off > 0 ? 1 : -1;
    offer(std::abs(off) - (volume.half[axis] + other.half[axis]), normal);
  }
  return best;
}

void CrowdList::measure(Crowd& crowd, double seconds) {
  CrowdRows& rows = crowd.rows;
  threads_.each(rows, [&](size_t p) {
    const auto& [begin, balls, end] = rows.parts[p];
    kernels_.measure(rows.hot.data() + begin, rows.state.data() + begin, balls - begin, crowd.x.data());
    rows.for_each({balls, balls, end}, [&](size_t g, size_t lane) {
      RowGroup& row = rows.hot[g];
      const uint32_t a = row.a[lane];
      const uint32_t b = row.b[lane];
      const Vec3 moved = seconds * (crowd.drift(b) - crowd.drift(a));

      const Touch there = closest(crowd, a, rows.names[g][lane].e, crowd.position(b), moved);
      row.nx[lane] = there.normal.x();
      row.ny[lane] = there.normal.y();
      row.nz[lane] = there.normal.z();
      rows.state[g].gap[lane] = there.gap;
    });
  });
}

}  // namespace carom
