// Gaps and times of impact of balls and shells. The inner and the outer surface are met as spheres are met, from within
// or from outside: level, of a cylinder's side. A rim is a circle. A ball meets it where its centre comes as near to
// the circle as its radius: with D1 and D2 the least and the greatest distance from the circle,
//   (D1^2 - r^2) (D2^2 - r^2) = (p^2 + R^2 - r^2)^2 - 4 R^2 (px^2 + pz^2) = 0
// is a polynomial along the path. Its roots are isolated in Bernstein's basis, so that none is missed, and polished on
// the gap itself. Search by separating planes is not possible: a shell is not convex.
#include "geometry/shell.h"

#include "geometry/relative_motion.h"
#include "numerics/bernstein.h"
#include "numerics/compensated.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// Without the part along the axis.
Vec3 level(const Vec3& v) {
  return {v.x(), 0, v.z()};
}

PolynomialPath::Terms level(PolynomialPath::Terms terms) {
  for (Vec3& term : terms) term.y() = 0;
  return terms;
}

/// |v| - s.
double length_beyond(const Vec3& v, double s) {
  const double length = v.norm();
  return s > 0 ? squared_gap(v, s) / (length + s) : length;
}

Vec3 direction(const Vec3& v) {
  const double length = v.norm();
  return length > 0 ? Vec3(v / length) : Vec3::UnitX();
}

/// From the nearest point of a circle of radius R about the axis, in the plane through p and the axis: outward, up.
Vec3 from_circle(const Vec3& p, double radius, double height) {
  return {level(p).norm() - radius, p.y() - height, 0};
}

/// Rounding of a gap at p, as a share of lengths.
constexpr double gap_rounding = 0x1p-46;

/// A parabola from a point on.
class ParabolaPiece {
 public:
  ParabolaPiece(const RelativeMotion& m, double length) : m_(m), length_(length) {}

  double length() const { return length_; }
  Vec3 start() const { return -m_.d; }
  Vec3 at(double t) const { return -(m_.d + t * (m_.w + 0.5 * t * m_.a)); }
  Vec3 velocity(double t) const { return -(m_.w + t * m_.a); }
  double speeds() const { return m_.speeds; }

  /// The times at which the path crosses a height (m), in order.
  vector<double> times_at(double height) const {
    const Polynomial above{{-m_.d.y() - height, -m_.w.y(), -0.5 * m_.a.y()}, 2};
    return list_of(roots_between(above, 0, length_));
  }
  /// The times at which its distance from a point of the axis (m) may become less than s (m), or more.
  vector<double> times_within(double height, double s) const {
    RelativeMotion m = m_;
    m.d.y() += height;
    m.just_separated = false;
    return list_of(roots_between(squared_gap_polynomial(m, s), 0, length_));
  }

  /// The part of it between two times (s).
  ParabolaPiece part(double from, double to) const {
    if (from == 0) return {m_, to};
    return {{m_.d + from * (m_.w + 0.5 * from * m_.a), m_.w + from * m_.a, m_.a, m_.speeds, false}, to - from};
  }

  double meet(double s, Side side, bool along_axis, bool closed) const {
    RelativeMotion m = m_;
    m.just_separated = closed;
    if (along_axis) m.d.y() = m.w.y() = m.a.y() = 0;
    return side == Side::inside ? taut_time(m, s, length_) : sphere_contact_time(m, s, length_);
  }

  /// The displacement, by t / length.
  PolynomialPath::Terms terms() const {
    PolynomialPath::Terms terms;
    terms.fill(Vec3::Zero());
    terms[0] = -length_ * m_.w;
    terms[1] = (-0.5 * length_ * length_) * m_.a;
    return terms;
  }

 private:
  static vector<double> list_of(const Roots& roots) { return {roots.at.begin(), roots.at.begin() + roots.count}; }

  RelativeMotion m_;
  double length_;  // s
};

/// A polynomial path from a point on.
class PolynomialPiece {
 public:
  PolynomialPiece(const Vec3& p, const PolynomialPath::Terms& terms, double length, double speeds)
      : p_(p), terms_(terms), length_(length), speeds_(speeds) {
    for (const Vec3& term : terms) reach_ += term.norm();
    reach_ += gap_rounding * (reach_ + p.cwiseAbs().sum());
  }

  double length() const { return length_; }
  Vec3 start() const { return p_; }
  Vec3 at(double t) const { return p_ + PolynomialPath::value(terms_, t / length_); }
  Vec3 velocity(double t) const { return PolynomialPath::slope(terms_, t / length_) / length_; }
  double speeds() const { return speeds_; }

  vector<double> times_at(double height) const {
    if (std::abs(p_.y() - height) > reach_) return {};
    array<double, PolynomialPath::terms + 1> above;
    above[0] = p_.y() - height;
    for (size_t k = 0; k < PolynomialPath::terms; ++k) above[k + 1] = terms_[k].y();
    vector<double> times = roots_in_unit(above);
    for (double& t : times) t *= length_;
    return times;
  }
  // It is short, and a bound is enough.
  vector<double> times_within(double, double) const { return {}; }

  PolynomialPiece part(double from, double to) const {
    return {from == 0 ? p_ : at(from), PolynomialPath::shifted(terms_, from / length_, (to - from) / length_),
            to - from, speeds_};
  }

  double meet(double s, Side side, bool along_axis, bool closed) const {
    const double from = (along_axis ? level(p_) : p_).norm();
    if (!closed && (side == Side::inside ? from + reach_ < s : from - reach_ > s)) return never;
    return distance_time(along_axis ? level(p_) : p_, along_axis ? level(terms_) : terms_, length_, s, side, speeds_,
                         closed, length_);
  }

  const PolynomialPath::Terms& terms() const { return terms_; }

 private:
  Vec3 p_;                       // m
  PolynomialPath::Terms terms_;  // m
  double length_, speeds_;       // s, m/s
  double reach_ = 0;             // m: it stays within so far of its start
};

/// The polynomial of a rim, along a path from p (m, from the circle's centre) on.
vector<double> rim_polynomial(const Vec3& p, const PolynomialPath::Terms& terms, double radius, double r) {
  size_t degree = PolynomialPath::terms;
  while (degree > 0 && terms[degree - 1].isZero(0)) --degree;
  vector<Vec3> path(degree + 1, p);
  for (size_t k = 0; k < degree; ++k) path[k + 1] = terms[k];

  // |p|^2 + R^2 - r^2, and the squared distance from the axis.
  vector<double> whole(2 * degree + 1), out(2 * degree + 1);
  for (size_t j = 0; j <= degree; ++j)
    for (size_t k = 0; k <= degree; ++k) {
      whole[j + k] += path[j].dot(path[k]);
      out[j + k] += level(path[j]).dot(level(path[k]));
    }
  whole[0] += (radius - r) * (radius + r);

  vector<double> f(4 * degree + 1);
  for (size_t j = 0; j < whole.size(); ++j)
    for (size_t k = 0; k < whole.size(); ++k) f[j + k] += whole[j] * whole[k];
  for (size_t k = 0; k < out.size(); ++k) f[k] -= 4 * radius * radius * out[k];
  return f;
}

/// The first contact of a ball of radius r (m) with a circle at a height (m), on a piece of a path that is near it.
/// closed: the gap at the start is zero by definition.
template <typename Piece>
double circle_time_near(const Piece& piece, double radius, double height, double r, bool closed) {
  const auto gap_at = [&](double t) { return length_beyond(from_circle(piece.at(t), radius, height), r); };
  const auto rate_at = [&](double t) {
    const Vec3 p = piece.at(t), from = from_circle(p, radius, height);
    const Vec3 v = piece.velocity(t);
    return (from.x() * direction(level(p)).dot(v) + from.y() * v.y()) / max(from.norm(), 0x1p-1000);
  };

  const double noise = 0x1p-48 * piece.speeds() * (1 + (piece.start().cwiseAbs().sum() + radius) / r);  // m/s
  const double rounding = gap_rounding * (piece.start().cwiseAbs().sum() + radius);                     // m
  const double start = closed ? 0 : gap_at(0), rate = rate_at(0);
  if (start <= (closed ? 0 : rounding) && rate < -noise) return 0;

  const Vec3 p = piece.start() - Vec3(0, height, 0);
  vector<double> f = rim_polynomial(p, piece.terms(), radius, r);
  if (f.size() < 2) return never;
  const Vec3 from = from_circle(piece.start(), radius, height);
  const double far = level(p).norm() + radius;
  f[0] = start * (from.norm() + r) * (far * far + from.y() * from.y() - r * r);
  // A path that slides along the circle, or leaves it: without the root at the start.
  if (start <= rounding) {
    f[0] = 0;
    if (std::abs(rate) <= noise) f[1] = 0;
  }
  const auto first = ranges::find_if(f, [](double c) { return c != 0; });
  if (first == f.end()) return never;
  if (start <= rounding && *first < 0) return 0;

  for (const double s : roots_in_unit({first, f.end()})) {
    // The method is Newton's, on the gap.
    double t = s * piece.length();
    for (int k = 0; k < 4; ++k) {
      const double slope = rate_at(t), step = -gap_at(t) / slope;
      if (!(slope < 0) || !(std::abs(step) <= 0x1p-10 * piece.length()) || !(t + step >= 0)) break;
      t += step;
    }
    if (rate_at(t) < 0) return t;
  }
  return never;
}

template <typename Piece>
double circle_time(const Piece& piece, double radius, double height, double r, bool closed) {
  // Where the ball's centre is nearer than this to that of the circle, a contact is possible.
  const double near = (1 + 0x1p-20) * (radius + r);
  const Vec3 center(0, height, 0);
  double reach = near;
  for (const Vec3& term : piece.terms()) reach += term.norm();
  if ((piece.start() - center).norm() > reach) return never;

  vector<double> ends = piece.times_within(height, near);
  ends.push_back(piece.length());
  double from = 0;
  for (const double to : ends) {
    if ((piece.at(from + 0.5 * (to - from)) - center).norm() <= near || ends.size() == 1) {
      const double t = circle_time_near(piece.part(from, to), radius, height, r, closed && from == 0);
      if (t < never) return from + t;
    }
    from = to;
  }
  return never;
}

/// The first contact on a path.
template <typename Piece>
FeatureTime first_contact(const Shell& shell, double r, const Piece& path, uint8_t left, double horizon) {
  if (!(path.length() > 0)) return {never, no_feature};

  // Where the path passes the height of a rim, another part of the shell becomes the nearest.
  vector<double> ends;
  for (const double height : {shell.low, shell.high})
    if (isfinite(height)) ranges::copy(path.times_at(height), std::back_inserter(ends));
  ranges::sort(ends);
  ends.push_back(path.length());

  double from = 0;
  for (const double to : ends) {
    const Piece piece = path.part(from, to);
    const double middle = piece.at(0.5 * piece.length()).y();
    uint8_t feature = middle > shell.high ? shell_high_rim : middle < shell.low ? shell_low_rim : shell_inner;
    if (feature == shell_inner && from == 0 && left <= shell_outer) {
      feature = left;
    } else if (feature == shell_inner) {
      const Vec3 p = piece.start();
      feature = (shell.round ? p : level(p)).norm() < shell.radius ? shell_inner : shell_outer;
    }

    // A ball that has just left one part is closed to the next one, where it passes over to that.
    const double rounding = gap_rounding * (piece.start().cwiseAbs().sum() + shell.radius + r);
    const bool closed = from == 0 && left != no_feature &&
                        (feature == left || std::abs(shell.at(piece.start(), r, feature).gap) <= rounding);

    double t;
    if (feature >= shell_low_rim)
      t = circle_time(piece, shell.radius, shell.height(feature), r, closed);
    else if (feature == shell_inner)
      t = piece.meet(shell.radius - r, Side::inside, !shell.round, closed);
    else
      t = piece.meet(shell.radius + r, Side::outside, !shell.round, closed);

    if (t < never) return from + t <= horizon ? FeatureTime{from + t, feature} : FeatureTime{never, no_feature};
    from = to;
    if (from > horizon) break;
  }
  return {never, no_feature};
}

}  // namespace

Shell::Shell(const Obstacle& obstacle)
    : round(obstacle.hollow != Hollow::side),
      radius(obstacle.volume.half.x()),
      low(obstacle.hollow == Hollow::upper_half ? 0 : -infinity),
      high(obstacle.hollow == Hollow::lower_half ? 0 : infinity) {
  if (round) return;
  low = -obstacle.volume.half.y();
  high = obstacle.volume.half.y();
}

double Shell::distance(const Vec3& p) const {
  if (p.y() > high) return from_circle(p, radius, high).norm();
  if (p.y() < low) return from_circle(p, radius, low).norm();
  return std::abs((round ? p : level(p)).norm() - radius);
}

uint8_t Shell::nearest(const Vec3& p) const {
  if (p.y() > high) return shell_high_rim;
  if (p.y() < low) return shell_low_rim;
  return (round ? p : level(p)).squaredNorm() < radius * radius ? shell_inner : shell_outer;
}

Separation Shell::at(const Vec3& p, double r, uint8_t feature) const {
  if (feature >= shell_low_rim) {
    const Vec3 from = from_circle(p, radius, height(feature));
    const Vec3 to = -direction(from);
    return {length_beyond(from, r), to.x() * direction(level(p)) + to.y() * Vec3::UnitY(), feature};
  }
  const Vec3 out = round ? p : level(p);
  if (feature == shell_inner) return {-length_beyond(out, radius - r), direction(out), feature};
  return {length_beyond(out, radius + r), -direction(out), feature};
}

double Shell::bending(const Vec3& p, uint8_t feature, const Vec3& w) const {
  // The speeds around the axis, and across both that and the normal.
  const Vec3 out = level(p);
  const double rho = max(out.norm(), 0x1p-1000);
  if (feature >= shell_low_rim) {
    const Vec3 from = from_circle(p, radius, height(feature));
    const double distance = max(from.norm(), 0x1p-1000);
    const double outward = w.dot(out) / rho;
    const double around2 = level(w).cross(out).squaredNorm() / (rho * rho);
    const double across = (from.x() * w.y() - from.y() * outward) / distance;
    return across * across / distance + from.x() / distance * around2 / rho;
  }

  const Vec3 from = round ? p : out, v = round ? w : level(w);
  const double distance = max(from.norm(), 0x1p-1000);
  const double bend = v.cross(from).squaredNorm() / (distance * distance * distance);
  return feature == shell_inner ? -bend : bend;
}

double Shell::bend_radius(double r, uint8_t feature) const {
  return feature == shell_inner ? radius - r : feature == shell_outer ? radius + r : min(r, radius - r);
}

FeatureTime Shell::contact_time(double r, const RelativeMotion& motion, uint8_t left, double horizon) const {
  return first_contact(*this, r, ParabolaPiece(motion, min(horizon, numeric_limits<double>::max())), left, horizon);
}

FeatureTime Shell::contact_time(double r, const Vec3& d, const PolynomialPath::Terms& displacement, double length,
                                double speeds, uint8_t left, double horizon) const {
  PolynomialPath::Terms terms = displacement;
  for (Vec3& term : terms) term = -term;
  return first_contact(*this, r, PolynomialPiece(-d, terms, length, speeds), left, horizon);
}

FeatureTime Shell::leave(uint8_t feature, const RelativeMotion& m, double horizon) const {
  // The room below a height, or above it.
  const auto passes = [&](double height, double side) {
    return plane_contact_time(side * (height + m.d.y()), side * m.w.y(), side * m.a.y(), 0, false, horizon);
  };

  if (feature >= shell_low_rim) {
    const double t = passes(height(feature), feature == shell_high_rim ? -1 : 1);
    if (t == never) return {never, no_feature};
    const Vec3 p = -(m.d + t * (m.w + 0.5 * t * m.a));
    return {t, level(p).norm() < radius ? shell_inner : shell_outer};
  }

  FeatureTime first{never, no_feature};
  if (isfinite(high)) first = {passes(high, 1), shell_high_rim};
  if (isfinite(low))
    if (const double t = passes(low, -1); t < first.time) first = {t, shell_low_rim};
  return first.time == never ? FeatureTime{never, no_feature} : first;
}

double distance_time(const Vec3& d, const PolynomialPath::Terms& displacement, double length, double s, Side side,
                     double speeds, bool just_separated, double horizon) {
  // |d + displacement|^2 - s^2 or its negative, by t / length.
  const double sign = side == Side::outside ? 1 : -1;
  array<double, 2 * PolynomialPath::terms + 1> gap{};
  gap[0] = just_separated ? 0 : sign * squared_gap(d, s);
  for (size_t k = 0; k < PolynomialPath::terms; ++k) {
    gap[k + 1] += sign * 2 * d.dot(displacement[k]);
    for (size_t j = 0; j < PolynomialPath::terms; ++j) gap[k + j + 2] += sign * displacement[k].dot(displacement[j]);
  }

  const bool closed = gap[0] <= 0x1p-51 * s * s;
  if (closed && std::abs(gap[1]) <= 0x1p-48 * length * speeds * s) gap[1] = 0;
  if (closed) gap[0] = 0;

  const auto first = ranges::find_if(gap, [](double c) { return c != 0; });
  if (first == gap.end()) return never;
  if (*first < 0) return 0;

  // Without the root at t = 0.
  for (const double at : roots_in_unit({first, gap.end()})) {
    const Vec3 there = d + PolynomialPath::value(displacement, at);
    if (sign * there.dot(PolynomialPath::slope(displacement, at)) >= 0) continue;
    return length * at <= horizon ? length * at : never;
  }
  return never;
}

}  // namespace carom
