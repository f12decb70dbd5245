// Rounds of impacts at one instant. A row alone is the law of two bodies, in closed form. Rows together are a
// projection by the contact solver, and an expansion that is summed in twice as many digits. Their velocities are
// rounded once, so that a mirror image has the same bits but for rare roundings.
#include "simulate/impact/impact_set.h"

#include <iterator>
#include <tuple>

#include "numerics/compensated.h"
#include "physics/impact.h"
#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Twice the kinetic energy of a change of velocity (J).
double twice_energy(double mass, const Vec3& dv) {
  return mass * dv.squaredNorm();
}

}  // namespace

uint32_t ImpactSet::add_body(double mass, const Vec3& v) {
  bodies_.push_back({mass, v, v.norm(), v.norm(), {}});
  next_.push_back(v);
  return bodies() - 1;
}

uint32_t ImpactSet::add_row(const Row& row) {
  const uint32_t c = rows();
  rows_.push_back({row});
  rows_.back().holds = row.kind != Kind::touching;
  linked_ = linked_ || rows_.back().holds;
  bodies_[row.a].rows.push_back(c);
  if (row.b != fixed) bodies_[row.b].rows.push_back(c);
  return c;
}

void ImpactSet::set_velocity(uint32_t body, const Vec3& v) {
  Body& of = bodies_[body];
  of.v = next_[body] = v;
  of.top = max(of.top, v.norm());
  of.near = max(of.near, of.top);
}

double ImpactSet::approach(uint32_t c) const {
  const Row& r = rows_[c];
  if (r.b == fixed) return r.normal.dot(bodies_[r.a].v) - r.surface;
  return -r.normal.dot(bodies_[r.b].v - bodies_[r.a].v);
}

/// The speed at which a row opens after this round (m/s).
double ImpactSet::separation(uint32_t c) const {
  const Row& r = rows_[c];
  if (r.b == fixed) return r.surface - r.normal.dot(next_[r.a]);
  return r.normal.dot(next_[r.b] - next_[r.a]);
}

/// The sum of the speeds to which the velocities of a row's two things are rounded (m/s).
double ImpactSet::speeds_near(uint32_t c) const {
  const Row& r = rows_[c];
  return bodies_[r.a].near + (r.b == fixed ? std::abs(r.surface) : bodies_[r.b].near);
}

/// A projection is right to rounding of the greatest speed in it. A slow body beside a fast one has no better digits.
void ImpactSet::share_rounding(const Projection& solved) {
  double greatest = 0;
  for (const uint32_t body : solved.bodies) greatest = max(greatest, bodies_[body].near);
  for (const uint32_t body : solved.bodies) bodies_[body].near = greatest;
}

bool ImpactSet::approaches(uint32_t c) const {
  return !rows_[c].holds && approach(c) > tol::velocity_rounding * speeds_near(c);
}

/// The order of rows: by what neither names nor a mirror change, and then by place, which names do not change.
bool ImpactSet::before(uint32_t c, uint32_t d) const {
  const Row& p = rows_[c];
  const Row& q = rows_[d];
  const double u = approach(c);
  const double w = approach(d);
  if (u != w) return u > w;
  for (int k = 0; k < 3; ++k)
    if (std::abs(p.normal[k]) != std::abs(q.normal[k])) return std::abs(p.normal[k]) < std::abs(q.normal[k]);

  for (int k = 0; k < 3; ++k)
    if (p.place[k] != q.place[k]) return p.place[k] < q.place[k];
  for (int k = 0; k < 3; ++k)
    if (p.b == fixed && q.b == fixed && p.normal[k] != q.normal[k]) return p.normal[k] < q.normal[k];

  // Two bodies may have a row and links between them.
  if (p.kind != q.kind) return p.kind < q.kind;
  if (p.restitution != q.restitution) return p.restitution < q.restitution;
  return c < d;
}

void ImpactSet::sort(Rows& rows) const {
  ranges::sort(rows, [this](uint32_t c, uint32_t d) { return before(c, d); });
}

/// The links that hold and are connected with these rows, directly or through other links.
ImpactSet::Rows ImpactSet::links_at(span<const uint32_t> rows) const {
  Rows links;
  if (!linked_) return links;

  Rows todo(rows.begin(), rows.end());
  for (size_t k = 0; k < todo.size(); ++k)
    for (const uint32_t body : {rows_[todo[k]].a, rows_[todo[k]].b}) {
      if (body == fixed) continue;
      for (const uint32_t d : bodies_[body].rows) {
        if (!rows_[d].holds || contains(links, d)) continue;
        links.push_back(d);
        todo.push_back(d);
      }
    }
  return links;
}

size_t ImpactSet::Projection::place_of(uint32_t body) const {
  return size_t(ranges::find(bodies, body) - bodies.begin());
}

vector<Vec3> ImpactSet::velocities() const {
  vector<Vec3> v;
  v.reserve(bodies_.size());
  for (const Body& of : bodies_) v.push_back(of.v);
  return v;
}

/// The velocities nearest to v, by kinetic energy, with no row approaching, strings not longer and rods unchanged.
/// `relative`: v are changes of velocities, to which the motion of fixed things does not matter. target: m/s, at which
/// rows are to open.
ImpactSet::Projection ImpactSet::project(Rows rows, span<const uint32_t> links, const vector<Vec3>& v, bool relative,
                                         double target) const {
  Projection p;
  rows.insert(rows.end(), links.begin(), links.end());
  Rows order = rows;
  sort(order);

  // Bodies are numbered as rows come to them, and each row points the same way under any names.
  vector<uint32_t> number(bodies_.size(), fixed);
  const auto place = [&](uint32_t body) {
    if (number[body] == fixed) {
      number[body] = uint32_t(p.bodies.size());
      p.bodies.push_back(body);
    }
    return number[body];
  };

  // The rows as constraints on velocities.
  vector<ContactConstraint> constraints;
  for (const uint32_t c : order) {
    const RowState& r = rows_[c];
    ContactConstraint constraint{0, fixed, r.normal};
    const bool turned = r.b != fixed && tie(r.normal.x(), r.normal.y(), r.normal.z()) < std::tuple(0.0, 0.0, 0.0);
    if (turned) constraint.normal = -r.normal;
    constraint.a = place(turned ? r.b : r.a);
    if (r.b != fixed) constraint.b = place(turned ? r.a : r.b);
    constraint.surface = relative ? 0 : r.surface;
    constraint.target = r.holds ? 0 : target;
    constraint.bilateral = r.kind == Kind::rod;
    constraint.slack = constraint.bilateral ? tol::step_error * speeds_near(c) : 0;
    constraints.push_back(constraint);
  }

  // The nearest velocities that they allow.
  vector<double> inverse_mass;
  for (const uint32_t body : p.bodies) {
    inverse_mass.push_back(1 / bodies_[body].mass);
    p.v.push_back(v[body]);
  }
  p.certificate = solve({inverse_mass, p.v, constraints, true});

  // In the order of the rows that were given.
  vector<double> impulse(rows_.size(), 0.0);
  for (size_t k = 0; k < order.size(); ++k) impulse[order[k]] = constraints[k].force;
  for (const uint32_t c : rows) p.impulse.push_back(impulse[c]);
  return p;
}

/// The change of velocities by a unit impulse of row c against its approach, with its links as rods.
ImpactSet::Projection ImpactSet::response(uint32_t c, span<const uint32_t> links) const {
  const Row& r = rows_[c];
  Projection p;
  const auto place = [&](uint32_t body) {
    const auto it = ranges::find(p.bodies, body);
    if (it != p.bodies.end()) return uint32_t(it - p.bodies.begin());
    p.bodies.push_back(body);
    return uint32_t(p.bodies.size() - 1);
  };

  // The row's own bodies come first.
  vector<ContactConstraint> constraints;
  place(r.a);
  if (r.b != fixed) place(r.b);
  for (const uint32_t link : links) {
    ContactConstraint constraint{place(rows_[link].a), fixed, rows_[link].normal};
    if (rows_[link].b != fixed) constraint.b = place(rows_[link].b);
    constraint.bilateral = true;
    constraint.slack = tol::step_error / bodies_[r.a].mass;
    constraints.push_back(constraint);
  }

  // The impulse, and what the links make of it.
  vector<double> inverse_mass;
  for (const uint32_t body : p.bodies) inverse_mass.push_back(1 / bodies_[body].mass);
  p.v.assign(p.bodies.size(), Vec3::Zero());
  p.v[0] = -inverse_mass[0] * r.normal;
  if (r.b != fixed) p.v[1] = inverse_mass[1] * r.normal;
  solve({inverse_mass, p.v, constraints});
  return p;
}

/// The cosine of the angle between the pushes of two rows: below zero, an impulse of one makes the other approach.
/// `response`: to c, where links connect bodies.
double ImpactSet::cosine(uint32_t c, uint32_t d, const Projection* response) const {
  const Row& p = rows_[c];
  const Row& q = rows_[d];

  // A shared body is pushed against the normal of which it is the first.
  if (response == nullptr) {
    double cosine = 1;
    for (const uint32_t body : {p.a, p.b}) {
      if (body == fixed || (body != q.a && body != q.b)) continue;
      const double along = p.normal.dot(q.normal);
      cosine = min(cosine, (p.a == body) == (q.a == body) ? along : -along);
    }
    return cosine;
  }

  const auto change = [&](uint32_t body) {
    const auto it = ranges::find(response->bodies, body);
    return it == response->bodies.end() ? Vec3(Vec3::Zero()) : response->v[size_t(it - response->bodies.begin())];
  };
  const auto opens = [&](const Row& r) {
    return r.normal.dot((r.b == fixed ? Vec3(Vec3::Zero()) : change(r.b)) - change(r.a));
  };
  const auto inverse = [&](const Row& r) { return 1 / bodies_[r.a].mass + (r.b == fixed ? 0 : 1 / bodies_[r.b].mass); };
  return opens(q) / sqrt(inverse(p) * inverse(q));
}

/// Whether row c waits for a faster one that pushes a body of it from the other side.
bool ImpactSet::waits(uint32_t c, const vector<uint8_t>& approaching) {
  const Rows links = links_at(span(&c, 1));
  Rows near{c};
  near.insert(near.end(), links.begin(), links.end());
  Projection through;
  if (!links.empty()) through = response(c, links);

  // All rows that push these bodies along the same line.
  const double u = approach(c);
  const double e = rows_[c].restitution;
  for (const uint32_t at : near)
    for (const uint32_t body : {rows_[at].a, rows_[at].b}) {
      if (body == fixed) continue;
      for (const uint32_t d : bodies_[body].rows) {
        if (d == c || !approaching[d]) continue;
        const double along = cosine(c, d, links.empty() ? nullptr : &through);
        if (!(std::abs(along) > tol::right_angle)) continue;
        const bool open = e > 0 || rows_[d].restitution > 0;
        if (open && !open_outcome_) open_outcome_ = {body, c, d};
        if (open && one_by_one_ && before(d, c)) return true;
        if (one_by_one_ || along > 0) continue;

        // The faster one goes first, of equal ones that with the smaller e.
        const double other = approach(d);
        if (other > u * (1 + tol::equal_speeds)) return true;
        if (other < u * (1 - tol::equal_speeds)) continue;
        if (rows_[d].restitution < e) return true;
        if (rows_[d].restitution == e && e > 0) tied_ = true;
      }
    }
  return false;
}

/// The rows that act in this round.
ImpactSet::Rows ImpactSet::select(span<const uint32_t> approaching) {
  vector<uint8_t> flag(rows_.size(), 0);
  for (const uint32_t c : approaching) flag[c] = 1;
  Rows acting;
  for (const uint32_t c : approaching)
    if (!waits(c, flag)) acting.push_back(c);
  sort(acting);
  return acting;
}

/// The sets of these rows that share bodies, directly or through links, or also through open rows.
vector<ImpactSet::Together> ImpactSet::connect(span<const uint32_t> acting, bool through_open) const {
  constexpr uint8_t acts = 1;
  constexpr uint8_t taken = 2;
  vector<uint8_t> flag(rows_.size(), 0);
  for (const uint32_t c : acting) flag[c] = acts;

  vector<Together> sets;
  for (const uint32_t first : acting) {
    if (flag[first] & taken) continue;
    Together& set = sets.emplace_back();
    Rows todo{first};
    flag[first] |= taken;

    // Breadth first over bodies. Each row is of one of three kinds.
    for (size_t k = 0; k < todo.size(); ++k) {
      const uint32_t c = todo[k];
      Rows& kind = rows_[c].holds ? set.links : flag[c] & acts ? set.rows : set.open;
      kind.push_back(c);

      for (const uint32_t body : {rows_[c].a, rows_[c].b}) {
        if (body == fixed) continue;
        for (const uint32_t d : bodies_[body].rows) {
          if (flag[d] & taken || !(flag[d] & acts || rows_[d].holds || (through_open && rows_[d].open > 0))) continue;
          flag[d] |= taken;
          todo.push_back(d);
        }
      }
    }
    for (Rows* const list : {&set.rows, &set.open, &set.links}) sort(*list);
  }
  return sets;
}

const vector<ImpactSet::Impact>& ImpactSet::strike(span<const uint32_t> approaching) {
  impacts_.clear();
  changed_.clear();
  const Rows acting = select(approaching);
  const auto inelastic = [&](uint32_t c) { return rows_[c].restitution == 0; };

  for (const Together& set : connect(acting, true)) {
    if (all_of(set.rows, inelastic)) {
      strike_together(set);
      continue;
    }
    // Rows that stayed closed stay so no longer: an impact with e > 0 goes through them.
    for (const Rows* const list : {&set.rows, &set.open, &set.links})
      for (const uint32_t c : *list) rows_[c].open = 0;
    if (set.open.empty()) {
      strike_together(set);
      continue;
    }
    for (const Together& part : connect(set.rows, false)) strike_together(part);
  }

  for (const uint32_t body : changed_) set_velocity(body, next_[body]);
  count();
  close_parted();
  ++rounds_;
  return impacts_;
}

void ImpactSet::strike_together(const Together& set) {
  if (set.rows.size() == 1 && set.open.empty() && set.links.empty()) return strike_one(set.rows.front());
  const bool inelastic = all_of(set.rows, [&](uint32_t c) { return rows_[c].restitution == 0; });
  inelastic ? strike_inelastic(set) : strike_elastic(set);
}

/// The law of two bodies.
void ImpactSet::strike_one(uint32_t c) {
  RowState& r = rows_[c];
  const double u = approach(c);
  const double separation = r.restitution * u;
  const double ma = bodies_[r.a].mass;
  double impulse;

  if (r.b == fixed) {
    impulse = ma * (u + separation);
    change(r.a, bodies_[r.a].v - (u + separation) * r.normal);
  } else {
    const double mb = bodies_[r.b].mass;
    impulse = impact_impulse(ma, mb, u, separation);
    change(r.a, bodies_[r.a].v - (impulse / ma) * r.normal);
    change(r.b, bodies_[r.b].v + (impulse / mb) * r.normal);
  }

  if (r.restitution == 0) r.open = impulse;
  note(c, impulse, u, separation);
}

/// The projection of the velocities without the earlier impulses of these rows and links, which stay open to revision.
void ImpactSet::strike_inelastic(const Together& set) {
  Rows rows = set.rows;
  rows.insert(rows.end(), set.open.begin(), set.open.end());
  sort(rows);
  Rows all = rows;
  all.insert(all.end(), set.links.begin(), set.links.end());

  // The velocities without the earlier impulses.
  vector<Vec3> start = velocities();
  for (const uint32_t c : all) {
    const RowState& r = rows_[c];
    if (r.open == 0) continue;
    start[r.a] += (r.open / bodies_[r.a].mass) * r.normal;
    if (r.b != fixed) start[r.b] -= (r.open / bodies_[r.b].mass) * r.normal;
  }

  const Projection p = project(rows, set.links, start);
  certificate_.merge(p.certificate);
  share_rounding(p);
  for (size_t k = 0; k < p.bodies.size(); ++k) change(p.bodies[k], p.v[k]);

  // The impulses that this adds to them.
  const size_t first = impacts_.size();
  for (size_t k = 0; k < all.size(); ++k) {
    RowState& r = rows_[all[k]];
    const double more = p.impulse[k] - r.open;
    r.open = p.impulse[k];
    r.holds ? void(r.pull += more) : note(all[k], more, approach(all[k]), separation(all[k]));
  }
  if (!set.links.empty()) share_losses(p.bodies, first);
}

/// By body of the compression: the sum of its impulses of expansion over its mass (m/s).
vector<ImpactSet::Sum3> ImpactSet::expansion(const Rows& rows, const Projection& compressed) const {
  vector<Sum3> gained(compressed.bodies.size());
  for (Sum3& of : gained) of.fill({0, 0});

  for (size_t k = 0; k < rows.size(); ++k) {
    const Row& r = rows_[rows[k]];
    const DoubleDouble impulse = two_product(r.restitution, compressed.impulse[k]);
    const auto push = [&](uint32_t body, double sign) {
      const DoubleDouble speed = impulse / DoubleDouble{sign * bodies_[body].mass, 0};
      Sum3& sum = gained[compressed.place_of(body)];
      for (size_t axis = 0; axis < 3; ++axis) sum[axis] = sum[axis] + speed * DoubleDouble{r.normal[int(axis)], 0};
    };
    push(r.a, -1);
    if (r.b != fixed) push(r.b, 1);
  }
  return gained;
}

/// Strings that compression slackens hold no longer.
void ImpactSet::slacken(const Rows& links, const Projection& compressed) {
  const auto of = [&](uint32_t body) {
    return body == fixed ? Vec3(Vec3::Zero()) : compressed.v[compressed.place_of(body)];
  };
  for (const uint32_t link : links) {
    RowState& r = rows_[link];
    const double parts = r.normal.dot(of(r.b) - of(r.a)) + r.surface;
    const double speeds = speeds_near(link) + of(r.a).norm() + of(r.b).norm();
    if (r.kind == Kind::taut && parts > tol::slackening * speeds) r.holds = false;
  }
}

/// The share of an expansion that gives back no more energy than compression has taken.
double ImpactSet::allowed_share(const Projection& compressed, const vector<Vec3>& dv) const {
  double took = 0;
  double back = 0;
  for (size_t k = 0; k < dv.size(); ++k) {
    const Body& of = bodies_[compressed.bodies[k]];
    took += twice_energy(of.mass, of.v - compressed.v[k]);
    back += twice_energy(of.mass, dv[k]);
  }
  return back > took ? sqrt(took / back) : 1;
}

/// One e for all: the velocities after an expansion that repeats e times what compression has changed. The shares of
/// rows and links do not matter. Each velocity is rounded once.
vector<Vec3> ImpactSet::expand_alike(const Projection& compressed, double e) const {
  vector<Vec3> after = compressed.v;
  for (size_t k = 0; k < after.size(); ++k)
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = compressed.v[k][axis];
      const DoubleDouble changed = two_sum(middle, -bodies_[compressed.bodies[k]].v[axis]);
      after[k][axis] = (DoubleDouble{middle, 0} + DoubleDouble{e, 0} * changed).value();
    }
  return after;
}

/// The velocities after an expansion of each row by its own e, and the share of it that energy allows.
vector<Vec3> ImpactSet::expand_each(const Together& set, const Projection& compressed, double& share) {
  const vector<Sum3> gained = expansion(set.rows, compressed);
  vector<Vec3> dv;
  vector<pair<uint32_t, double>> answers;  // N s, of links
  for (const Sum3& of : gained) dv.emplace_back(of[0].value(), of[1].value(), of[2].value());

  // Links that are still tight answer to it.
  if (!set.links.empty()) {
    Rows tight;
    ranges::copy_if(set.links, std::back_inserter(tight), [&](uint32_t c) { return rows_[c].holds; });
    vector<Vec3> all(bodies_.size(), Vec3::Zero());
    for (size_t k = 0; k < dv.size(); ++k) all[compressed.bodies[k]] = dv[k];

    const Projection answer = project({}, tight, all, true);
    certificate_.merge(answer.certificate);
    for (size_t k = 0; k < answer.bodies.size(); ++k) dv[compressed.place_of(answer.bodies[k])] = answer.v[k];
    for (size_t k = 0; k < tight.size(); ++k) answers.emplace_back(tight[k], answer.impulse[k]);
  }

  // With e above 1 energy may be made.
  const bool limited = all_of(set.rows, [&](uint32_t c) { return rows_[c].restitution <= 1; });
  share = limited ? allowed_share(compressed, dv) : 1;
  for (const auto& [link, impulse] : answers) rows_[link].pull += share * impulse;

  // The velocities are rounded once where links and limits have not changed the sums.
  vector<Vec3> after = compressed.v;
  for (size_t k = 0; k < dv.size(); ++k) {
    after[k] += share * dv[k];
    if (!set.links.empty() || share < 1) continue;
    for (int axis = 0; axis < 3; ++axis)
      after[k][axis] = (DoubleDouble{compressed.v[k][axis], 0} + gained[k][size_t(axis)]).value();
  }
  return after;
}

/// Compression, then expansion by e times the impulses of compression.
void ImpactSet::strike_elastic(const Together& set) {
  const Projection compressed = project(set.rows, set.links, velocities());
  certificate_.merge(compressed.certificate);
  share_rounding(compressed);
  slacken(set.links, compressed);

  const double first_e = rows_[set.rows.front()].restitution;
  const bool one = all_of(set.rows, [&](uint32_t c) { return rows_[c].restitution == first_e; });
  double share = 1;
  for (size_t k = 0; k < set.links.size(); ++k)
    rows_[set.links[k]].pull += (one ? 1 + first_e : 1) * compressed.impulse[set.rows.size() + k];
  const vector<Vec3> after = one ? expand_alike(compressed, first_e) : expand_each(set, compressed, share);
  for (size_t k = 0; k < after.size(); ++k) change(compressed.bodies[k], after[k]);

  // With one e for all, each row separates by it.
  const size_t first = impacts_.size();
  for (size_t k = 0; k < set.rows.size(); ++k) {
    const uint32_t c = set.rows[k];
    const double e = rows_[c].restitution;
    note(c, (1 + share * e) * compressed.impulse[k], approach(c), one ? e * approach(c) : separation(c));
  }

  if (!set.links.empty()) share_losses(compressed.bodies, first);
}

/// Shares the energy that these bodies lose in this round among its impacts from number `first` on, by the work of each
/// against its approach. What links take or give is that of impacts: a string that compression has pulled, and that
/// slackens in the expansion, gives energy back.
void ImpactSet::share_losses(const Rows& bodies, size_t first) {
  Sum lost;        // J
  double all = 0;  // J
  for (const uint32_t body : bodies) {
    const Body& of = bodies_[body];
    lost.add(0.5 * of.mass * (of.v - next_[body]).dot(of.v + next_[body]));
  }
  const auto work = [](const Impact& impact) { return max(impact.impulse * impact.approach, 0.0); };
  for (size_t k = first; k < impacts_.size(); ++k) {
    lost.add(-impacts_[k].impulse * rows_[impacts_[k].row].surface);
    all += work(impacts_[k]);
  }

  if (!(all > 0)) return;
  for (size_t k = first; k < impacts_.size(); ++k) impacts_[k].lost = lost.value() * (work(impacts_[k]) / all);
}

void ImpactSet::change(uint32_t body, const Vec3& v) {
  Vec3 kept = v;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(kept[axis]) <= tol::nothing_left * bodies_[body].top) kept[axis] = 0;
  if (kept == bodies_[body].v) return;
  next_[body] = kept;
  changed_.push_back(body);
}

void ImpactSet::note(uint32_t c, double impulse, double approach, double separation) {
  if (impulse == 0) return;
  impacts_.push_back({c, approach, separation, impulse, 0.5 * impulse * (approach - separation)});
}

/// Counts the strikes of this round.
void ImpactSet::count() {
  for (const Impact& impact : impacts_) {
    if (!(impact.impulse > 0)) continue;
    RowState& r = rows_[impact.row];
    r.struck = true;
    const double lost = max(1 - r.restitution, 0.0);
    endless_.sum += lost;
    for (const uint32_t body : {r.a, r.b}) {
      if (body == fixed) continue;
      bodies_[body].lost += lost;
      endless_.most_struck = max(endless_.most_struck, ++bodies_[body].struck);
    }
  }
}

/// Rows that part are open no longer, in the sense of revision, and strings that part do not hold.
void ImpactSet::close_parted() {
  for (uint32_t c = 0; c < rows(); ++c) {
    RowState& r = rows_[c];
    if (r.kind == Kind::rod || (r.open == 0 && !r.holds)) continue;
    const double parts = -approach(c);
    if (r.kind == Kind::taut && parts > tol::slackening * speeds_near(c)) r.holds = false;
    if (parts > tol::parted * speeds_near(c)) r.open = 0;
  }
}

/// The rows that can be struck, and the links that hold.
pair<ImpactSet::Rows, ImpactSet::Rows> ImpactSet::touching_and_links() const {
  pair<Rows, Rows> rows;
  for (uint32_t c = 0; c < rows_.size(); ++c) (rows_[c].holds ? rows.second : rows.first).push_back(c);
  return rows;
}

bool ImpactSet::has_room() const {
  const auto [touching, links] = touching_and_links();
  return has_room(touching, links);
}

/// The same of some rows.
bool ImpactSet::has_room(const Rows& rows, const Rows& links) const {
  return project(rows, links, vector<Vec3>(bodies_.size(), Vec3::Zero()), true, 1).certificate.solved();
}

/// The limit of endless rounds: the projection of the present velocities on all rows.
ImpactSet::Limit ImpactSet::find_limit() {
  Limit limit;
  tie(limit.touching, limit.links) = touching_and_links();
  limit.reached = project(limit.touching, limit.links, velocities());
  certificate_.merge(limit.reached.certificate);

  const Projection& p = limit.reached;
  limit.v = velocities();
  for (size_t k = 0; k < p.bodies.size(); ++k) limit.v[p.bodies[k]] = p.v[k];
  limit.away = distance(velocities(), limit.v);

  Sum greatest;
  for (const Body& of : bodies_) greatest.add(of.mass * of.top * of.top);
  limit.greatest = greatest.value();
  return limit;
}

/// Twice the kinetic energy of a change of all velocities (J). It is summed with compensation, so that no number of a
/// body matters.
double ImpactSet::distance(const vector<Vec3>& from, const vector<Vec3>& to) const {
  Sum sum;
  for (size_t i = 0; i < bodies_.size(); ++i) sum.add(twice_energy(bodies_[i].mass, to[i] - from[i]));
  return sum.value();
}

const vector<ImpactSet::Impact>& ImpactSet::end_endless(span<const uint32_t> approaching) {
  impacts_.clear();
  changed_.clear();
  endless_.next_check *= 2;
  const Limit limit = find_limit();

  // Whether it is that of the last look.
  const auto pressing = double(ranges::count_if(limit.reached.impulse, [](double j) { return j > 0; }));
  const bool known = endless_.limit.size() == limit.v.size();
  const bool same = known && distance(endless_.limit, limit.v) <= tol::same_limit * tol::same_limit * limit.greatest;
  const bool elastic = any_of(approaching, [&](uint32_t c) { return rows_[c].restitution == 1; });
  const bool worn = any_of(approaching, [&](uint32_t c) {
    const Row& r = rows_[c];
    return bodies_[r.a].lost > tol::worn_out || (r.b != fixed && bodies_[r.b].lost > tol::worn_out);
  });
  bool over = limit.away <= tol::limit_reached * tol::limit_reached * limit.greatest || worn ||
              (same && endless_.sum - endless_.sum_at_limit >= tol::rounds_of_limit * pressing);

  // Only rows that strike again and again need room. All of them have struck since the last look.
  if (!over && elastic) {
    Rows again;
    ranges::copy_if(limit.touching, std::back_inserter(again), [&](uint32_t c) { return rows_[c].struck; });
    over = endless_.without_room = !has_room(again, limit.links);
  }
  for (RowState& r : rows_) r.struck = false;

  if (!same) {
    endless_.limit = limit.v;
    endless_.sum_at_limit = endless_.sum;
  }
  if (over) end_by(limit);
  return impacts_;
}

/// Ends the rounds with the velocities of their limit.
void ImpactSet::end_by(const Limit& limit) {
  endless_.ended = true;
  ++rounds_;
  const Projection& p = limit.reached;
  for (size_t k = 0; k < p.bodies.size(); ++k) change(p.bodies[k], p.v[k]);
  for (size_t k = 0; k < limit.touching.size(); ++k) {
    const uint32_t c = limit.touching[k];
    note(c, p.impulse[k], approach(c), separation(c));
  }
  for (size_t k = 0; k < limit.links.size(); ++k) rows_[limit.links[k]].pull += p.impulse[limit.touching.size() + k];
  share_losses(p.bodies, 0);
  for (const uint32_t body : changed_) set_velocity(body, next_[body]);
}

const vector<ImpactSet::Impact>& ImpactSet::finish() {
  impacts_.clear();
  changed_.clear();
  if (endless_.ended || endless_.most_struck <= tol::many_strikes) return impacts_;
  const Limit limit = find_limit();
  if (limit.away > 0 && limit.away <= tol::left_by_rounds * tol::left_by_rounds * limit.greatest) end_by(limit);
  return impacts_;
}

}  // namespace carom
