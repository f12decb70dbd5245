// Scaling of a contact island, residuals in double-double, and the certificate of a solution.
// Residuals are evaluated on the given data, not on scaled rows. The certificate thus holds for the problem that was
// given.
#include "solver/contact_island.h"

#include <numeric>

#include "numerics/disjoint_sets.h"
#include "std.h"

namespace carom {

namespace {

int exponent_of(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent;
}

/// sum += a b, about as well as in double-double (Ogita, Rump & Oishi's Dot2) and with half of the operations.
void add_product(DoubleDouble& sum, double a, const DoubleDouble& b) {
  const DoubleDouble p = two_product(a, b.hi), s = two_sum(sum.hi, p.hi);
  sum.hi = s.hi;
  sum.lo += s.lo + (p.lo + a * b.lo);
}

}  // namespace

void ContactIsland::scale() {
  double most = 0;
  double lightest = 0;
  double heaviest = infinity;
  for (const Vec3& u : free) most = max(most, u.cwiseAbs().maxCoeff());
  for (const Row& r : rows) most = max(most, std::abs(r.target));

  for (const double w : inverse_mass) {
    lightest = max(lightest, w);
    heaviest = min(heaviest, w);
  }

  // The units are powers of two, so that scaling does not round.
  mass_ratio = lightest / heaviest;
  motion_exponent = exponent_of(most);
  mass_exponent = exponent_of(lightest);
  const PowerOfTwo motion(-motion_exponent);
  const PowerOfTwo mass(-mass_exponent);
  const PowerOfTwo force(mass_exponent - motion_exponent);

  // The bodies, in these units.
  speed = 0;
  root.resize(inverse_mass.size());
  for (size_t i = 0; i < free.size(); ++i) {
    inverse_mass[i] = mass * inverse_mass[i];
    root[i] = sqrt(inverse_mass[i]);
    free[i] = motion * free[i];
    speed = max(speed, free[i].norm());
  }

  // The rows, each scaled to unit length.
  unilateral = true;
  for (Row& r : rows) {
    r.target = motion * r.target;
    r.slack = motion * r.slack;
    r.force = force * r.force;
    r.scale = 1 / sqrt(r.normal.squaredNorm() * (inverse_mass[r.a] + (r.moves_b() ? inverse_mass[r.b] : 0)));
    r.left = r.scale * root[r.a] * r.normal;
    r.right = r.moves_b() ? Vec3(r.scale * root[r.b] * r.normal) : Vec3(Vec3::Zero());
    speed = max(speed, std::abs(r.target));
    unilateral = unilateral && !r.bilateral;
  }
}

void ContactIsland::close_mass_gaps() {
  // Beyond it a light body has no effect on a heavy one.
  constexpr int widest = 60;

  heavier.clear();
  const auto [least, most] = std::minmax_element(inverse_mass.begin(), inverse_mass.end());
  if (exponent_of(*most) - exponent_of(*least) <= widest) return;

  vector<size_t> order(inverse_mass.size());
  std::iota(order.begin(), order.end(), size_t{0});
  ranges::stable_sort(order, [&](size_t i, size_t j) { return inverse_mass[i] < inverse_mass[j]; });

  // Bodies beyond a gap are made heavier, until the gap has the greatest width allowed.
  heavier.assign(inverse_mass.size(), 0);
  int shift = 0;
  int last = exponent_of(inverse_mass[order.front()]);
  for (const size_t k : order) {
    const int exponent = exponent_of(inverse_mass[k]);
    shift += max(exponent - last - widest, 0);
    last = exponent;
    heavier[k] = shift;
    inverse_mass[k] = std::ldexp(inverse_mass[k], -shift);
  }
}

vector<int> ContactIsland::force_exponents(const vector<DoubleDouble>& force) const {
  if (heavier.empty()) return {};

  // The heaviest of the bodies that forces connect decides.
  DisjointSets sets(free.size());
  for (size_t c = 0; c < rows.size(); ++c)
    if (force[c].hi != 0 && rows[c].moves_b()) sets.join(rows[c].a, rows[c].b);
  vector<int> least(free.size(), numeric_limits<int>::max());  // by root
  for (uint32_t k = 0; k < free.size(); ++k) least[sets.root(k)] = min(least[sets.root(k)], heavier[k]);
  vector<int> exponents;
  for (const Row& r : rows) exponents.push_back(-least[sets.root(r.a)]);
  return exponents;
}

size_t ContactIsland::reach() const {
  // The rows of each body, one body after the other.
  vector<uint32_t> first(free.size() + 1, 0);
  vector<uint32_t> of;
  for (const Row& r : rows) {
    ++first[r.a];
    if (r.moves_b()) ++first[r.b];
  }

  std::partial_sum(first.begin(), first.end(), first.begin());
  of.resize(first.back());
  for (uint32_t c = 0; c < rows.size(); ++c) {
    of[--first[rows[c].a]] = c;
    if (rows[c].moves_b()) of[--first[rows[c].b]] = c;
  }

  // The last row that a breadth-first search from `start` comes to.
  vector<uint32_t> order;
  vector<uint32_t> distance;
  const auto search_from = [&](uint32_t start) {
    distance.assign(rows.size(), ContactConstraint::fixed);
    order.assign(1, start);
    distance[start] = 0;

    for (size_t k = 0; k < order.size(); ++k) {
      const Row& r = rows[order[k]];
      for (const uint32_t body : {r.a, r.moves_b() ? r.b : r.a})
        for (uint32_t at = first[body]; at < first[body + 1]; ++at)
          if (distance[of[at]] == ContactConstraint::fixed) {
            distance[of[at]] = distance[order[k]] + 1;
            order.push_back(of[at]);
          }
    }
    return order.back();
  };

  // A second search, from the farthest row, finds about the greatest distance of all.
  return distance[search_from(search_from(0))];
}

double excess(const ContactIsland::Row& r, const vector<DoubleDouble>& motion) {
  const DoubleDouble* const u = &motion[3 * r.a];
  const DoubleDouble* const v = r.moves_b() ? &motion[3 * r.b] : nullptr;
  DoubleDouble sum{-r.target, 0};
  for (int k = 0; k < 3; ++k) {
    if (r.normal[k] == 0) continue;
    add_product(sum, -r.normal[k], u[k]);
    if (v != nullptr) add_product(sum, r.normal[k], v[k]);
  }
  return sum.value();
}

void find_imbalance(const ContactIsland& island, ContactSolution& solution) {
  vector<DoubleDouble>& push = solution.push;
  push.assign(island.unknowns(), DoubleDouble{0, 0});

  // The sum of forces on each body, by axis.
  for (size_t c = 0; c < island.rows.size(); ++c) {
    const DoubleDouble& x = solution.force[c];
    if (x.hi == 0) continue;
    const ContactIsland::Row& r = island.rows[c];

    for (uint32_t k = 0; k < 3; ++k) {
      const double n = r.normal[int(k)];
      if (n == 0) continue;
      add_product(push[3 * r.a + k], -n, x);
      if (r.moves_b()) add_product(push[3 * r.b + k], n, x);
    }
  }

  // What the motion lacks: free motion and the effect of the forces, less the motion itself.
  solution.lacking.resize(island.unknowns());
  for (size_t i = 0; i < push.size(); ++i) {
    DoubleDouble sum{island.free[i / 3][int(i % 3)], 0};
    add_product(sum, -1, solution.motion[i]);
    add_product(sum, island.inverse_mass[i / 3], push[i]);
    solution.lacking[i] = sum.value();
  }
}

Judgement judge(const ContactIsland& island, ContactSolution& solution) {
  Judgement judgement;
  const auto differ = [&](double change) { judgement.change = max(judgement.change, change); };

  // By how much rows are violated, or off where they press.
  for (size_t c = 0; c < island.rows.size(); ++c) {
    const ContactIsland::Row& r = island.rows[c];
    const double w = excess(r, solution.motion);
    const double off = solution.force[c].hi != 0 || r.bilateral ? std::abs(w) : max(-w, 0.0);
    const double change = off == 0 ? 0 : r.scale * off / island.noise_scale(r);
    if (!(change <= accepted_change) && !(off <= r.slack)) judgement.within_slack = false;
    if (std::isnan(change)) judgement.change = infinity;
    differ(change);
  }

  // The imbalance of forces, as a share of the speed.
  find_imbalance(island, solution);
  const vector<double>& lacking = solution.lacking;
  for (size_t i = 0; i < lacking.size(); ++i) {
    if (lacking[i] == 0) continue;
    const DoubleDouble* const u = &solution.motion[i - i % 3];
    const double speed = max({island.speed, std::abs(u[0].hi), std::abs(u[1].hi), std::abs(u[2].hi)});
    const double change = std::abs(lacking[i]) / speed;
    if (!(change <= accepted_change)) judgement.within_slack = false;
    differ(change);
  }

  return judgement;
}

}  // namespace carom
