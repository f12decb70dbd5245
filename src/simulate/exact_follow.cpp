// A small crowd is followed closely: bodies that press on one another keep to each other's surfaces, with forces from
// the complementarity conditions (0 <= force, 0 <= the gap's second derivative, one of them zero; the surfaces'
// curvature in it), and their paths are integrated by the classical Runge-Kutta method of fourth order. Between its
// steps a path is the parabola through both ends, which leaves the true one by less than `strayed` of a radius:
// steps are as short as that asks for. Where all contacts are flat the parabola is the path, and a step lasts until a
// contact comes to its rim. Everybody that moves takes part in impacts as everywhere else, only the pairs that are
// followed do not.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/few_contacts.h"
#include "physics/restitution.h"
#include "simulate/exact_simulator.h"

namespace carom {

namespace {

constexpr std::size_t most_pairs = 16;  // that are followed; a larger crowd moves in strides
constexpr double closed = 1e-9;         // of a radius: a gap that counts as contact
constexpr double strayed = 1e-11;       // of the smaller body's radius
constexpr double longest_step = 0.02;   // of the time in which a body falls by its own size

/// By Newton's method: the same bits everywhere, which std::cbrt does not promise.
double cube_root(double x) {
  int exponent;
  double m = std::frexp(x, &exponent);  // m in [1/2, 1)
  while (exponent % 3 != 0) {
    m *= 2;
    --exponent;
  }
  double y = 1.25;
  for (int k = 0; k < 8; ++k) y -= (y - m / (y * y)) / 3;
  return std::ldexp(y, exponent / 3);
}

/// m, with what radius at least the Minkowski sum of two volumes is bent where it is round: a cylinder's rim is sharp,
/// a sphere makes it as round as itself.
double bend_radius(const World& world, Entity i, Entity e) {
  const auto round = [&](Shape shape) {
    double sum = 0;
    for (Entity k : {i, e}) {
      if (world.is_plane(k) || world.is_wall(k)) continue;
      const Volume volume = world.volume_of(k);
      if (volume.shape == shape) sum += volume.half.x();
    }
    return sum;
  };
  if (const double r = round(Shape::sphere); r > 0) return r;
  if (const double r = round(Shape::cylinder); r > 0) return r;
  return world.radius[i];
}

}  // namespace

/// Whether body i and e are followed as a pair in contact, so that they cannot meet.
bool ExactSimulator::followed(Entity i, Entity e) const {
  const std::vector<Entity>& partners = followed_[i];
  return std::find(partners.begin(), partners.end(), e) != partners.end();
}

bool ExactSimulator::follow_crowd() {
  const std::size_t n = crowd_.size();
  if (n > 2 * most_pairs) return false;
  std::vector<Vec3> x(n), v(n), before(n);
  std::vector<double> inverse_mass(n);
  double pull = 0, smallest = never;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    local_.write(i) = static_cast<std::uint32_t>(k);
    const double t = now_ - flight_[i].start;
    x[k] = flight_[i].position(t);
    before[k] = flight_[i].velocity(t);
    v[k] = following_ && body_[i].version == arrival_version_[i] && now_ == arrival_time_ ? arrival_[i] : before[k];
    if (!following_ && now_ < pulled_[i]) v[k] -= (pulled_[i] - now_) * hastened_[i];
    inverse_mass[k] = 1 / world_.mass[i];
    pull = std::max(pull, load_on(i));
    smallest = std::min(smallest, world_.radius[i]);
  }
  const auto forget = [&] {
    for (Entity i : crowd_) local_.write(i) = PressedPair::none;
  };

  // The pairs in contact, but for those that are about to strike.
  struct Name {
    Entity a, b;
    std::uint8_t feature;
  };
  std::vector<PressedPair> pairs;
  std::vector<Name> names;
  const auto at = [&](const std::vector<Vec3>& where, Entity e) -> Vec3 {
    return world_.is_body(e) ? where[local_[e]] : world_.fixed_position(e);
  };
  const auto moving = [&](const std::vector<Vec3>& speed, Entity e) -> Vec3 {
    return world_.is_body(e) ? speed[local_[e]] : Vec3(Vec3::Zero());
  };
  bool overlap = false;
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    for (Entity e : known_to(i)) {
      const bool body = world_.is_body(e);
      if (body && (e < i || body_[e].place != Place::crowd)) continue;
      // Whom it has struck just now it touches there, and nowhere else.
      const bool struck = flight_[i].start == now_ && body_[i].origin == e;
      const Touch there = touch(world_, i, x[k], e, at(x, e), struck ? body_[i].origin_feature : no_feature);
      const double rounding = 0x1p-51 * (x[k].cwiseAbs().sum() + at(x, e).cwiseAbs().sum());
      if (there.gap > std::max(closed * world_.radius[i], rounding)) continue;
      const double approach = there.normal.dot(v[k] - moving(v, e));
      if (strikes(i, e, approach, pull)) continue;
      pairs.push_back({static_cast<std::uint32_t>(k), body ? local_[e] : PressedPair::none, there.normal, 0, 0, 0});
      names.push_back({i, e, there.feature});
      pairs.back().target = -there.gap;
      overlap = overlap || there.gap < -0x1p-50 * world_.radius[i];
    }
  }
  if (pairs.size() > most_pairs) {
    forget();
    return false;
  }
  if (overlap) {
    std::vector<Vec3> way(n, Vec3::Zero());
    for (PressedPair& p : pairs) p.slack = 0x1p-54 * smallest;
    press_few_apart(inverse_mass, way, pairs);
    for (std::size_t k = 0; k < n; ++k) x[k] += way[k];
  }
  double fastest = 0;
  for (const Vec3& u : v) fastest = std::max(fastest, u.norm());
  for (PressedPair& p : pairs) {
    p.target = p.force = 0;
    p.slack = 0x1p-52 * fastest;
  }
  press_few_apart(inverse_mass, v, pairs);

  // Struck and held up by those behind it: an impact in turn with the strike, as by e = 0.
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = crowd_[k];
    if (needed_[i] < now_ || (v[k] - before[k]).norm() <= 0x1p-40 * before[k].norm()) continue;
    ++collapse_.write(i).impacts;
    collapse_.write(i).lost += 1;
  }

  // Pairs that part by more than paths stray are no contacts: if they come back, they meet.
  const double parting = std::sqrt(2 * pull * strayed * smallest) + 0x1p-48 * fastest;
  std::size_t kept = 0;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const Vec3 w = moving(v, names[c].b) - v[pairs[c].a];
    if (pairs[c].normal.dot(w) > parting) continue;
    pairs[kept] = pairs[c];
    names[kept++] = names[c];
  }
  pairs.resize(kept);
  names.resize(kept);

  const auto accelerate = [&](const std::vector<Vec3>& where, const std::vector<Vec3>& speed) {
    std::vector<Vec3> a(n);
    for (std::size_t k = 0; k < n; ++k) a[k] = pull_[crowd_[k]];
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const auto& [i, e, feature] = names[c];
      pairs[c].slack = 1e-15 * pull;
      if (carom::is_flat(world_, i, e, feature)) continue;
      const Vec3 xe = at(where, e);
      const Touch there = touch(world_, i, where[pairs[c].a], e, xe);
      pairs[c].normal = there.normal;
      pairs[c].target = -bending(world_, i, where[pairs[c].a], e, xe, there, moving(speed, e) - speed[pairs[c].a]);
    }
    press_few_apart(inverse_mass, a, pairs);
    return a;
  };
  for (PressedPair& p : pairs) p.force = p.target = 0;
  const std::vector<Vec3> a0 = accelerate(x, v);
  std::vector<PressedPair> first = pairs;
  // What presses on does not part: the little speed that is left of parting goes too, and nobody comes to approach.
  std::vector<PressedPair> both;
  bool parts = false;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const double rate = first[c].normal.dot(moving(v, names[c].b) - v[first[c].a]);
    parts = parts || (first[c].force > 0 && rate > 0x1p-48 * fastest);
    both.push_back({first[c].a, first[c].b, first[c].normal, 0, 0x1p-52 * fastest, 0});
    if (!(first[c].force > 0)) continue;
    both.push_back(both.back());
    both.back().normal = -first[c].normal;
  }
  if (parts) press_few_apart(inverse_mass, v, both);

  // At rest are those in contact with one another of whom nobody moves or is pushed.
  std::vector<std::size_t> part(n);
  std::iota(part.begin(), part.end(), std::size_t{0});
  for (const PressedPair& p : pairs)
    if (p.b != PressedPair::none && part[p.a] != part[p.b])
      std::replace(part.begin(), part.end(), std::size_t{part[p.a]}, std::size_t{part[p.b]});
  std::vector<std::uint8_t> stirs(n, 1), rests(n);
  for (const PressedPair& p : pairs) stirs[part[p.a]] = 0;
  fastest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    fastest = std::max(fastest, v[k].norm());
    if (!(v[k].norm() <= hardly_moving * std::sqrt(pull * smallest) && a0[k].norm() <= 1e-11 * pull))
      stirs[part[k]] = 1;
  }
  for (std::size_t k = 0; k < n; ++k) rests[k] = !stirs[part[k]];
  const bool all_rest = std::find(rests.begin(), rests.end(), 0) == rests.end();

  // How far the parabolas are good.
  const double moment =  // in which hardly anything can happen
      pull > 0 ? longest_step * std::sqrt(2 * smallest / pull) : 1e-3 * smallest / std::max(fastest, 0x1p-900);
  double h = 2 * (Instant{options_.duration, 0} - now_) + moment;  // for ever
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto& [i, e, feature] = names[c];
    if (rests[pairs[c].a]) continue;
    const Vec3 w = moving(v, e) - v[pairs[c].a], a = moving(a0, e) - a0[pairs[c].a];
    const double smaller = world_.is_body(e) ? std::min(world_.radius[i], world_.radius[e]) : world_.radius[i];
    const bool flat = carom::is_flat(world_, i, e, feature);
    // Along a rim, not over it, but for rounding.
    RelativeMotion m{at(x, e) - x[pairs[c].a], w, a, w.norm(), true};
    const double speeds = v[pairs[c].a].norm() + moving(v, e).norm();
    for (int k = 0; k < 3; ++k) {
      if (std::abs(w[k]) <= 0x1p-48 * speeds) m.w[k] = 0;
      if (std::abs(a[k]) <= 0x1p-48 * pull) m.a[k] = 0;
    }
    // Beyond the feature's rim the surface bends otherwise: a step goes no farther over it than makes no difference.
    const double bend = flat ? smaller : bend_radius(world_, i, e), room = strayed * smaller * bend;
    const double over = flat ? 1e-7 * moment : std::sqrt(2 * room) / std::max(w.norm(), 0x1p-900);
    h = std::min(h, std::max(leave_feature(world_, i, e, feature, m, h).time, over));
    if (flat) continue;
    // The gap's third derivative is about 3 w . a / bend, its fourth 3 a . a / bend. A parabola through both ends
    // leaves t^3 by 4/27 of h^3 at most and t^4 by 1/4 of h^4, so that h^3 might be 13.5 room / (w . a) and h^4 32 room
    // / (a . a); steps are as short as the Runge-Kutta method asks for.
    const double bent = m.a.norm() + m.w.squaredNorm() / bend;
    if (bent == 0) continue;
    h = std::min(h, moment);
    h = std::min(h, std::sqrt(std::sqrt(8 * room) / bent));
    if (w.norm() > 0) h = std::min(h, cube_root(2 * room / (w.norm() * bent)));
  }

  // A body on which nothing presses any more, or flat surfaces alone, leaves the crowd, but not before it has had time
  // to fall back.
  const double grace = pull > 0 ? 2 * slow_speed(pull, smallest) / pull : 1e-6 * smallest / std::max(fastest, 0x1p-900);
  std::vector<std::uint8_t> held(n, 0), bound(n, 0);
  std::vector<Contacts> flats(n);
  std::vector<Vec3> down(n, Vec3::Zero());  // m, the way that closes what is left of the gaps to flat surfaces
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const PressedPair& p = pairs[c];
    if (!(p.force > 0)) continue;
    const auto& [i, e, feature] = names[c];
    held[p.a] = 1;
    if (p.b != PressedPair::none) {
      held[p.b] = bound[p.a] = bound[p.b] = 1;
    } else if (carom::is_flat(world_, i, e, feature) && flats[p.a].count < max_contacts) {
      const double gap = touch(world_, i, x[p.a] + down[p.a], e, at(x, e)).gap;
      if (gap > strayed * world_.radius[i]) bound[p.a] = 1;
      down[p.a] += gap * p.normal;
      flats[p.a].at[flats[p.a].count++] = {e, feature, -p.normal, false, now_, 0};
    } else {
      bound[p.a] = 1;
    }
  }
  for (std::size_t k = 0; k < n; ++k)
    if (!bound[k] && !(held[k] && rests[k]))
      h = std::min(h, std::max(grace - (now_ - needed_[crowd_[k]]), 0.25 * grace));

  std::vector<Vec3> path = a0, end = v;
  for (std::size_t k = 0; k < n; ++k) end[k] += h * a0[k];
  if (!all_rest && !pairs.empty()) {
    std::vector<Vec3> where(n), speed(n);
    for (std::size_t k = 0; k < n; ++k) {
      where[k] = x[k] + 0.5 * h * v[k];
      speed[k] = v[k] + 0.5 * h * a0[k];
    }
    const std::vector<Vec3> a1 = accelerate(where, speed);
    for (std::size_t k = 0; k < n; ++k) {
      where[k] = x[k] + 0.5 * h * (v[k] + 0.5 * h * a0[k]);
      speed[k] = v[k] + 0.5 * h * a1[k];
    }
    const std::vector<Vec3> a2 = accelerate(where, speed);
    for (std::size_t k = 0; k < n; ++k) {
      where[k] = x[k] + h * (v[k] + 0.5 * h * a1[k]);
      speed[k] = v[k] + h * a2[k];
    }
    const std::vector<Vec3> a3 = accelerate(where, speed);
    for (std::size_t k = 0; k < n; ++k) {
      path[k] = (a0[k] + a1[k] + a2[k]) / 3;
      end[k] = v[k] + h / 6 * (a0[k] + 2 * a1[k] + 2 * a2[k] + a3[k]);
    }
  }
  for (Entity i : crowd_) {
    followed_.write(i).clear();
    pressed_.write(i).clear();
  }
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto& [i, e, feature] = names[c];
    followed_.write(i).push_back(e);
    if (world_.is_body(e)) {
      followed_.write(e).push_back(i);
    }
    if (first[c].force > 0) pressed_.write(i).push_back({e, first[c].force});
  }
  forget();

  following_ = false;  // until all flights are new
  std::vector<Entity> members;
  members.swap(crowd_);
  for (std::size_t k = 0; k < n; ++k) {
    const Entity i = members[k];
    log_.lose(0.5 * world_.mass[i] * (before[k] - v[k]).dot(before[k] + v[k]));
    if (bound[k]) needed_.write(i) = now_;
    if (!bound[k] && !(held[k] && rests[k]) && now_ - needed_[i] >= grace) {
      body_[i].place = Place::outside;
      carry(i, false);
      for (std::size_t c = 0; c < flats[k].count; ++c) settle(i, flats[k].at[c]);
      restart(i, x[k] + down[k], keep_contacts(i, v[k]), {});
    } else if (rests[k]) {
      body_[i].place = Place::asleep;
      carry(i, true);
      restart(i, x[k], Vec3::Zero(), {});
    } else {
      crowd_.push_back(i);
      carry(i, held[k]);
      pulled_.write(i) = now_;
      // Whom it has struck just now it has still just struck, if nothing has changed since.
      const bool same = flight_[i].start == now_ && x[k] == flight_[i].x && v[k] == before[k];
      restart(i, x[k], v[k], same ? body_[i].from() : Origin{});
      flight_.accelerate(i, path[k]);
      arrival_.write(i) = end[k];
      arrival_version_.write(i) = body_[i].version;
    }
  }
  following_ = true;
  crowd_end_ = crowd_.empty() ? Instant{never, 0} : now_ + h;
  arrival_time_ = crowd_end_;
  for (Entity i : members) predict(i);
  return true;
}

/// The forces among those that are followed, now: between two steps they change, and may turn to zero.
void ExactSimulator::report_followed() {
  const Instant at{time_, 0};
  std::vector<Vec3> x, v, a;
  std::vector<double> inverse_mass;
  double pull = 0;
  for (Entity i : crowd_) {
    const double t = at - flight_[i].start;
    local_.write(i) = static_cast<std::uint32_t>(x.size());
    x.push_back(flight_[i].position(t));
    v.push_back(flight_[i].velocity(t));
    a.push_back(pull_[i]);
    inverse_mass.push_back(1 / world_.mass[i]);
    pull = std::max(pull, pull_[i].norm());
  }
  std::vector<PressedPair> pairs;
  std::vector<std::pair<Entity, Entity>> names;
  for (Entity i : crowd_) {
    for (Entity e : followed_[i]) {
      const bool body = world_.is_body(e);
      if (body && (e < i || body_[e].place != Place::crowd)) continue;
      const std::uint32_t k = local_[i], other = body ? local_[e] : PressedPair::none;
      const Vec3 xe = body ? x[other] : world_.fixed_position(e), ve = body ? v[other] : Vec3(Vec3::Zero());
      const Touch there = touch(world_, i, x[k], e, xe);
      const double bend = bending(world_, i, x[k], e, xe, there, ve - v[k]);
      pairs.push_back({k, other, there.normal, -bend, 1e-15 * pull, 0});
      names.emplace_back(i, e);
    }
  }
  press_few_apart(inverse_mass, a, pairs);
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (pairs[c].force > 0) contact_forces_.push_back({names[c].first, names[c].second, pairs[c].force});
  for (Entity i : crowd_) local_.write(i) = PressedPair::none;
}

}  // namespace carom
