// Minkowski sums of volumes along the axes: a point against a rectangle, enlarged by a disc, extended in height and
// enlarged by a ball. One set of formulas serves rounded boxes, cylinders and their sums, because each lacks only some
// of these parts. Gaps near zero are compensated, and the round rim has a double-double form.
#include "geometry/round_prism.h"

#include "geometry/exact_path.h"
#include "numerics/compensated.h"
#include "std.h"

namespace carom {

namespace {

/// sqrt(u^2 + v^2) - radius.
double length_beyond(double u, double v, double radius) {
  const double length = sqrt(u * u + v * v);
  return radius > 0 ? squared_gap(Vec3(u, v, 0), radius) / (length + radius) : length;
}

int side_of(double x) {
  return x < 0 ? -1 : 1;
}

}  // namespace

PrismFeature RoundPrism::unique(PrismFeature f) const {
  if (!f.bent()) return f;
  return {half.x() == 0 ? 1 : f.x, f.y, half.z() == 0 ? 1 : f.z};
}

/// p from the corner of the rectangle about which the surface bends.
Vec3 RoundPrism::from_corner(const Vec3& p, PrismFeature f) const {
  return {p.x() - f.x * half.x(), 0, p.z() - f.z * half.z()};
}

RoundPrism::Excess RoundPrism::excess(const Vec3& p, PrismFeature f) const {
  if (!f.bent()) {
    const int k = f.x != 0 ? 0 : 2, side = f.x + f.z;
    return {side * p[k] - half[k] - disc, side * Vec3::Unit(k), 0};
  }
  const Vec3 e = from_corner(p, f);
  const double rho = sqrt(e.x() * e.x() + e.z() * e.z());
  const Vec3 out = rho > 0 ? Vec3(e / rho) : Vec3(f.x, 0, round() ? 0 : f.z).normalized();
  return {length_beyond(e.x(), e.z(), disc), out, rho};
}

PrismFeature RoundPrism::nearest_side(const Vec3& p) const {
  if (round()) return {1, 0, 1};
  const double ex = std::abs(p.x()) - half.x(), ez = std::abs(p.z()) - half.z();
  if (ex > 0 && ez > 0) return unique({side_of(p.x()), 0, side_of(p.z())});
  return ez > ex ? PrismFeature{0, 0, side_of(p.z())} : PrismFeature{side_of(p.x()), 0, 0};
}

Separation RoundPrism::nearest(const Vec3& p) const {
  PrismFeature f = nearest_side(p);
  const double u = excess(p, f).u, v = std::abs(p.y()) - half.y();
  const int up = side_of(p.y());
  if (u > 0 && v > 0) {
    f.y = up;
  } else if (v > u || (v == u && f.x == 0)) {
    f = {0, up, 0};
  }
  return at(p, f.code());
}

Separation RoundPrism::at(const Vec3& p, uint8_t feature) const {
  const PrismFeature f = PrismFeature::of(feature);
  const double v = f.y * p.y() - half.y();
  if (!f.level()) return {v - ball, Vec3(0, f.y, 0), feature};
  const Excess e = excess(p, f);
  if (f.y == 0) {
    const Vec3 c = from_corner(p, f);
    return {f.bent() ? length_beyond(c.x(), c.z(), disc + ball) : e.u - ball, e.out, feature};
  }
  const double length = sqrt(e.u * e.u + v * v);
  const double nu = length > 0 ? e.u / length : sqrt(0.5), nv = length > 0 ? v / length : sqrt(0.5);
  return {length_beyond(e.u, v, ball), nu * e.out + Vec3(0, nv * f.y, 0), feature};
}

double RoundPrism::displaced_gap(const Vec3& p, uint8_t feature, double gap, const Vec3& by) const {
  const PrismFeature f = PrismFeature::of(feature);
  const double dv = f.y * by.y();
  if (!f.level()) return gap + dv;

  double du = f.x * by.x() + f.z * by.z();
  if (f.bent()) {
    // The change of length, |e + by| - |e|.
    const Vec3 e = from_corner(p, f), level(by.x(), 0, by.z());
    const double lengths = e.norm() + (e + level).norm();
    du = lengths > 0 ? level.dot(2 * e + level) / lengths : 0;
  }

  if (f.y == 0) return gap + du;
  const double u = excess(p, f).u, v = f.y * p.y() - half.y();
  const double lengths = sqrt(u * u + v * v) + sqrt((u + du) * (u + du) + (v + dv) * (v + dv));
  return lengths > 0 ? gap + (du * (2 * u + du) + dv * (2 * v + dv)) / lengths : gap;
}

bool RoundPrism::rim_gap(uint8_t feature, const RelativeMotion& m, double t, double& gap) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (!(f.y != 0 && f.bent() && disc > 0)) return false;
  const auto p = exact_position(m, t);
  const DoubleDouble x = p[0] - DoubleDouble{f.x * half.x(), 0}, z = p[2] - DoubleDouble{f.z * half.z(), 0};
  const DoubleDouble u = square_root(x * x + z * z) - DoubleDouble{disc, 0};
  const DoubleDouble v = DoubleDouble{f.y * p[1].hi, f.y * p[1].lo} - DoubleDouble{half.y(), 0};
  gap = (square_root(u * u + v * v) - DoubleDouble{ball, 0}).value();
  return true;
}

double RoundPrism::bending(const Vec3& p, uint8_t feature, const Vec3& w) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (!f.level()) return 0;
  const Excess e = excess(p, f);
  const double around = f.bent() ? e.out.x() * w.z() - e.out.z() * w.x() : 0;
  const double turn = e.rho > 0 ? around * around / e.rho : 0;
  if (f.y == 0) return turn;
  const double v = f.y * p.y() - half.y();
  const double length = sqrt(e.u * e.u + v * v);
  if (length == 0) return 0;
  const double across = (e.u * f.y * w.y() - v * e.out.dot(w)) / length;
  return across * across / length + e.u / length * turn;
}

bool RoundPrism::flat(uint8_t feature) const {
  const PrismFeature f = PrismFeature::of(feature);
  return (f.x != 0) + (f.y != 0) + (f.z != 0) == 1;
}

bool RoundPrism::sharp(uint8_t feature) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (ball > 0) return false;
  return (f.level() && f.y != 0) || (f.bent() && disc == 0);
}

uint8_t RoundPrism::foremost_face(const Vec3& p, uint8_t feature) const {
  const PrismFeature f = PrismFeature::of(feature);
  PrismFeature side{f.x, 0, f.z};
  const double ex = std::abs(p.x()) - half.x(), ez = std::abs(p.z()) - half.z();
  if (f.bent() && disc == 0) side = ez > ex ? PrismFeature{0, 0, f.z} : PrismFeature{f.x, 0, 0};
  if (f.y == 0) return side.code();
  const double u = excess(p, side).u, v = f.y * p.y() - half.y();
  return v > u || (v == u && side.x == 0) ? PrismFeature{0, f.y, 0}.code() : side.code();
}

Vec3 RoundPrism::within(const Vec3& p, uint8_t feature) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (flat(feature)) return p;
  Vec3 q = p;
  const int side[3] = {f.x, f.y, f.z};
  for (int k = 0; k < 3; ++k) {
    if (side[k] == 0 || half[k] == 0) continue;
    const double rim = half[k] + (k != 1 && !f.bent() ? disc : 0);
    q[k] = side[k] * max(side[k] * p[k], rim);
  }
  return q;
}

bool RoundPrism::as_spheres(uint8_t feature, const RelativeMotion& m, RelativeMotion& reduced, double& radius) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (flat(feature) || (f.y != 0 && f.bent() && disc > 0)) return false;

  reduced = m;
  radius = ball + (f.y == 0 ? disc : 0);
  const int side[3] = {f.x, f.y, f.z};

  for (int k = 0; k < 3; ++k) {
    if (side[k] == 0) {
      reduced.d[k] = reduced.w[k] = reduced.a[k] = 0;
    } else {
      reduced.d[k] -= side[k] * half[k];
    }
  }

  return radius > 0;
}

FeatureTime RoundPrism::leave(uint8_t feature, const RelativeMotion& m, double horizon) const {
  const PrismFeature f = PrismFeature::of(feature);
  if (!f.level() && disc > 0) return leave_round_cap(f, m, horizon);

  FeatureTime first{never, no_feature};
  const auto offer = [&](double t, PrismFeature beyond) {
    if (t < first.time) first = {t, unique(beyond).code()};
  };
  const auto falls = [&](double room, int k, int sign) {
    return plane_contact_time(room, sign * m.w[k], sign * m.a[k], 0, false, horizon);
  };

  if (round() && f.y != 0) {
    // The rounded rim ends at the cap and at the side.
    RelativeMotion level = m;
    level.d.y() = level.w.y() = level.a.y() = 0;
    level.just_separated = false;
    offer(sphere_contact_time(level, disc, horizon), {0, f.y, 0});
    offer(falls(f.y * m.d.y() - half.y(), 1, f.y), {1, 0, 1});
    return first;
  }

  const int side[3] = {f.x, f.y, f.z};
  for (int k = 0; k < 3; ++k) {
    if (k != 1 && round()) continue;
    if (side[k] == 0) {
      // Otherwise the surface beyond is a face.
      const bool edge = ball > 0 || (k != 1 && f.y == 0 && disc > 0);
      for (int sign : {1, -1}) {
        PrismFeature beyond = edge ? f : PrismFeature{0, 0, 0};
        (k == 0 ? beyond.x : k == 1 ? beyond.y : beyond.z) = sign;
        offer(falls(half[k] - sign * m.d[k], k, -sign), beyond);
      }
    } else if (!flat(feature) && half[k] > 0) {
      PrismFeature beyond = f;
      (k == 0 ? beyond.x : k == 1 ? beyond.y : beyond.z) = 0;
      const double t = falls(side[k] * m.d[k] - half[k], k, side[k]);
      if (t == never) continue;

      // The path is on one side or the other of a rectangle without width.
      const Vec3 p = m.d + t * (m.w + 0.5 * t * m.a);
      if (beyond.x != 0 && half.x() == 0) beyond.x = side_of(p.x());
      if (beyond.z != 0 && half.z() == 0) beyond.z = side_of(p.z());
      offer(t, beyond);
    }
  }

  return first;
}

/// The exit over the rim of a rectangle with round corners, or of a disc. Either the ball or the rectangle is missing.
FeatureTime RoundPrism::leave_round_cap(PrismFeature f, const RelativeMotion& m, double horizon) const {
  FeatureTime first{never, no_feature};
  const auto path = [&](double t) -> Vec3 { return m.d + t * (m.w + 0.5 * t * m.a); };
  const auto offer = [&](double t, PrismFeature beyond) {
    if (!(t < first.time) || t > horizon) return;
    if (ball > 0) beyond.y = f.y;
    first = {t, unique(beyond).code()};
  };

  // The straight sides.
  for (int k : {0, 2})
    for (int sign : {1, -1})
      if (!round())
        offer(plane_contact_time(half[k] + disc - sign * m.d[k], -sign * m.w[k], -sign * m.a[k], 0, false, horizon),
              k == 0 ? PrismFeature{sign, 0, 0} : PrismFeature{0, 0, sign});

  // The round corners.
  for (int corner = 0; corner < (round() ? 1 : 4); ++corner) {
    const PrismFeature c{corner % 2 == 0 ? 1 : -1, 0, corner / 2 == 0 ? 1 : -1};
    RelativeMotion level{from_corner(m.d, c), m.w, m.a, m.speeds, false};
    level.w.y() = level.a.y() = 0;
    if (round()) {
      offer(first_descent(room_in_disc(level, disc), horizon), c);
      continue;
    }

    const Roots exits = exit_times(level, disc, horizon);
    for (int k = 0; k < exits.count; ++k) {
      const double t = exits.at[size_t(k)];
      const Vec3 p = path(t);
      const double rounding = 0x1p-44 * (size() + p.cwiseAbs().sum() + m.d.cwiseAbs().sum());
      const bool on_corner = c.x * p.x() >= half.x() - rounding && c.z * p.z() >= half.z() - rounding;
      if (on_corner) offer(t, c);
    }
  }

  return first;
}

}  // namespace carom
