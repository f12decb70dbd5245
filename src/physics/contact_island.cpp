#include "physics/contact_island.h"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

int exponent_of(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent;
}

DoubleDouble times(double a, DoubleDouble b) {
  const DoubleDouble p = two_product(a, b.hi);
  return fast_two_sum(p.hi, p.lo + a * b.lo);
}

}  // namespace

void ContactIsland::scale() {
  double most = 0, lightest = 0, heaviest = std::numeric_limits<double>::infinity();
  for (const Vec3& u : free) most = std::max(most, u.cwiseAbs().maxCoeff());
  for (const Row& r : rows) most = std::max(most, std::abs(r.target));
  for (const double w : inverse_mass) {
    lightest = std::max(lightest, w);
    heaviest = std::min(heaviest, w);
  }
  mass_ratio = lightest / heaviest;
  motion_exponent = exponent_of(most);
  mass_exponent = exponent_of(lightest);
  speed = 0;
  root.resize(inverse_mass.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    inverse_mass[i] = std::ldexp(inverse_mass[i], -mass_exponent);
    root[i] = std::sqrt(inverse_mass[i]);
    for (int k = 0; k < 3; ++k) free[i][k] = std::ldexp(free[i][k], -motion_exponent);
    speed = std::max(speed, free[i].norm());
  }
  unilateral = true;
  for (Row& r : rows) {
    r.target = std::ldexp(r.target, -motion_exponent);
    r.slack = std::ldexp(r.slack, -motion_exponent);
    r.force = std::ldexp(r.force, mass_exponent - motion_exponent);
    r.scale = 1 / std::sqrt(r.normal.squaredNorm() * (inverse_mass[r.a] + (r.moves_b() ? inverse_mass[r.b] : 0)));
    r.left = r.scale * root[r.a] * r.normal;
    r.right = r.moves_b() ? Vec3(r.scale * root[r.b] * r.normal) : Vec3(Vec3::Zero());
    speed = std::max(speed, std::abs(r.target));
    unilateral = unilateral && !r.bilateral;
  }
}

double excess(const ContactIsland&, const ContactIsland::Row& r, const std::vector<DoubleDouble>& motion) {
  const DoubleDouble* const u = &motion[3 * r.a];
  const DoubleDouble* const v = r.moves_b() ? &motion[3 * r.b] : nullptr;
  DoubleDouble sum{-r.target, 0};
  for (int k = 0; k < 3; ++k) sum = sum + times(r.normal[k], v == nullptr ? -u[k] : v[k] - u[k]);
  return sum.value();
}

void imbalance(const ContactIsland& island, const ContactAnswer& answer, std::vector<double>& result) {
  std::vector<DoubleDouble> push(island.unknowns(), DoubleDouble{0, 0});
  for (std::size_t c = 0; c < island.rows.size(); ++c) {
    const DoubleDouble x = answer.force[c];
    if (x.hi == 0) continue;
    const ContactIsland::Row& r = island.rows[c];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const DoubleDouble p = times(r.normal[static_cast<int>(k)], x);
      push[3 * r.a + k] = push[3 * r.a + k] - p;
      if (r.moves_b()) push[3 * r.b + k] = push[3 * r.b + k] + p;
    }
  }
  result.resize(island.unknowns());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const DoubleDouble free{island.free[i / 3][static_cast<int>(i % 3)], 0};
    result[i] = (free - answer.motion[i] + times(island.inverse_mass[i / 3], push[i])).value();
  }
}

Judgement judge(const ContactIsland& island, const ContactAnswer& answer) {
  Judgement judgement;
  const auto differ = [&](double change) { judgement.change = std::max(judgement.change, change); };
  for (std::size_t c = 0; c < island.rows.size(); ++c) {
    const ContactIsland::Row& r = island.rows[c];
    const double w = excess(island, r, answer.motion);
    const double off = answer.force[c].hi != 0 || r.bilateral ? std::abs(w) : std::max(-w, 0.0);
    const double change = off == 0 ? 0 : r.scale * off / island.noise_scale(r);
    if (!(change <= accepted_change) && !(off <= r.slack)) judgement.within_slack = false;
    if (std::isnan(change)) judgement.change = std::numeric_limits<double>::infinity();
    differ(change);
  }
  std::vector<double> lacking;
  imbalance(island, answer, lacking);
  for (std::size_t i = 0; i < lacking.size(); ++i) {
    if (lacking[i] == 0) continue;
    const DoubleDouble* const u = &answer.motion[i - i % 3];
    const double speed = std::max({island.speed, std::abs(u[0].hi), std::abs(u[1].hi), std::abs(u[2].hi)});
    const double change = std::abs(lacking[i]) / speed;
    if (!(change <= accepted_change)) judgement.within_slack = false;
    differ(change);
  }
  return judgement;
}

}  // namespace carom
