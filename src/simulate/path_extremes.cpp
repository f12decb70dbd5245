// Extremes of one flight. A coordinate turns where its velocity is zero, a speed where velocity and acceleration are
// perpendicular. Parabolas have one such point, in closed form. Elsewhere the flight is a polynomial, and all roots of
// its derivative are found (bernstein.h).
#include "simulate/path_extremes.h"

#include <algorithm>
#include <array>

#include "numerics/bernstein.h"
#include "physics/world.h"

namespace carom {
namespace {

/// A polynomial in s, from the constant term on.
using Coefficients = std::vector<double>;

Coefficients slope_of(const Coefficients& of) {
  Coefficients slope;
  for (std::size_t k = 1; k < of.size(); ++k) slope.push_back(static_cast<double>(k) * of[k]);
  return slope;
}

void add_product(const Coefficients& p, const Coefficients& q, Coefficients& sum) {
  sum.resize(std::max(sum.size(), p.size() + q.size() - 1));
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < q.size(); ++j) sum[i + j] += p[i] * q[j];
}

/// A part of a flight, with t in s from its start on.
struct Part {
  const Flight& flight;
  /// What the velocity has beyond that of the flight: m/s, m/s^2, m/s^3, in powers of t.
  std::array<Vec3, 3> more;

  Vec3 velocity(double t) const { return flight.velocity(t) + more[0] + t * (more[1] + t * more[2]); }

  /// The velocity from t on as polynomials in s = (time - t) / length, by axis (m/s).
  std::array<Coefficients, 3> velocities(double t, double length) const {
    const PolynomialPath::Terms terms = flight.displacement_from(t, length);
    const std::array<Vec3, 3> beyond = {more[0] + t * (more[1] + t * more[2]), length * (more[1] + 2 * t * more[2]),
                                        length * length * more[2]};
    std::array<Coefficients, 3> v;
    for (int axis = 0; axis < 3; ++axis) {
      auto& of = v[static_cast<std::size_t>(axis)];
      for (std::size_t k = 0; k < terms.size(); ++k)
        of.push_back(static_cast<double>(k + 1) * terms[k][axis] / length + (k < 3 ? beyond[k][axis] : 0));
    }
    return v;
  }
};

/// The polynomial in s that is zero where the quantity turns.
Coefficients turning(Quantity quantity, const std::array<Coefficients, 3>& v) {
  const auto axis = static_cast<std::size_t>(quantity);
  if (is_place(quantity)) return v[axis];
  if (quantity <= Quantity::vz) return slope_of(v[axis - static_cast<std::size_t>(Quantity::vx)]);
  Coefficients power;
  for (const Coefficients& of : v) add_product(of, slope_of(of), power);
  return power;
}

/// Calls take(t) where the quantity of a parabola turns between `from` and `to` (s).
template <typename Take>
void turns_of_parabola(const Flight& f, Quantity quantity, double from, double to, const Take& take) {
  if (quantity >= Quantity::vx && quantity <= Quantity::vz) return;
  const int axis = is_place(quantity) ? static_cast<int>(quantity) : 0;
  const double slope = is_place(quantity) ? f.v[axis] : f.v.dot(f.a);
  const double bend = is_place(quantity) ? f.a[axis] : f.a.squaredNorm();
  const double t = -slope / bend;
  if (t > from && t < to) take(t);
}

template <typename Take>
void turns_of(const Part& part, Quantity quantity, double from, double to, const Take& take) {
  const bool plain = part.more[0].isZero(0) && part.more[1].isZero(0) && part.more[2].isZero(0);
  if (part.flight.is_straight() && (plain || is_place(quantity)))
    return turns_of_parabola(part.flight, quantity, from, to, take);
  // A position follows the flight's own velocity.
  const Part path{part.flight,
                  is_place(quantity) ? std::array<Vec3, 3>{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()} : part.more};
  for (double t = from; t < to;) {
    const double length = std::min(to - t, part.flight.span_of_fade(t));
    if (!(t + length > t)) return;
    for (const double s : roots_in_unit(turning(quantity, path.velocities(t, length)))) take(t + s * length);
    t += length;
    if (t < to) take(t);
  }
}

}  // namespace

PathExtremes::PathExtremes(const ExactBodies& bodies)
    : bodies_(bodies), found_(bodies.options.watch.size()), seen_(found_.empty() ? 0 : bodies.body.size()) {}

void PathExtremes::note(Entity i) {
  take(i, bodies_.now, found_);
  seen_[i] = bodies_.now;
}

std::vector<Extremes> PathExtremes::up_to(double time) const {
  std::vector<Extremes> found = found_;
  for (Entity i = 0; i < seen_.size(); ++i) take(i, {time, 0}, found);
  return found;
}

/// Takes the values of body i from the last instant taken to `until`, on its present flight.
void PathExtremes::take(Entity i, const Instant& until, std::vector<Extremes>& found) const {
  if (until < seen_[i]) return;
  const Flight f = bodies_.flights[i];
  const Instant since = std::max(seen_[i], f.start);
  if (until < since || (bodies_.merged.any() && bodies_.merged.whole_of()[i] != i)) return;
  Part part{f, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}};
  if (bodies_.is_stepped(i) && !bodies_.islands.kick[i].isZero(0)) {
    part.more[0] = -(bodies_.islands.kicked_until[i] - f.start) * bodies_.islands.kick[i];
    part.more[1] = bodies_.islands.kick[i];
  } else if (f.curve != nullptr) {
    part.more[0] = -f.curve->ahead;
  }
  const double from = since - f.start, to = until - f.start, mass = bodies_.world.mass[i];
  for (std::size_t k = 0; k < found.size(); ++k) {
    const WatchedQuantity& watched = bodies_.options.watch[k];
    if (!watched.has(i)) continue;
    const auto offer = [&](double t) {
      found[k].take(quantity_of(watched.quantity, f.position(t), part.velocity(t), mass), (f.start + t).hi);
    };
    offer(from);
    turns_of(part, watched.quantity, from, to, offer);
    offer(to);
  }
}

}  // namespace carom
