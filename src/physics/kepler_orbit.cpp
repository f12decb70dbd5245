// Universal variables (Stumpff; Everhart & Pitkin, Am. J. Phys. 51, 1983, 712; Wisdom & Hernandez, MNRAS 453, 2015,
// 3015). With beta = 2 mu / r - v^2 and ds = dt / r, every conic obeys r = r0 + eta G1 + zeta G2 and t = r0 s + eta G2
// + zeta G3. Here G_n(s) = s^n (1/n! - beta s^2 / (n + 2)! + ...). Usually s counts from the start. Here it counts from
// the nearer end of the long axis, where eta = x . v is 0. All terms then have one sign, and nothing cancels: neither
// at a pericentre of 1e-17 of the start's distance, nor in a fall from rest. Anomalies need a case for each conic, and
// lose digits where the conics meet. Factors of many revolutions and differences that cancel are computed once, in two
// doubles.
#include "physics/kepler_orbit.h"

#include "numerics/elementary.h"
#include "std.h"

namespace carom {

namespace {

// Reach of the series in |beta| s^2. Beyond it a hyperbola's exponentials do not cancel.
constexpr double series_reach = 6;
constexpr DoubleDouble half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// The constants of a conic, from a position and a velocity.
struct Constants {
  DoubleDouble r;       // m
  DoubleDouble beta;    // m^2/s^2
  DoubleDouble eta;     // m^2/s: x . v
  DoubleDouble zeta;    // m^3/s^2: mu - beta r
  DoubleDouble square;  // m^4/s^2: of h
  DoubleDouble bend;    // m^3/s^2: |mu| times the eccentricity
  Vec3 h;               // m^2/s: x cross v
};

Constants constants(double mu, const Vec3& x, const Vec3& v) {
  const DoubleDouble strength = {mu, 0};
  Constants c;
  c.r = square_root(dot_compensated(x, x));
  c.beta = DoubleDouble{2 * mu, 0} / c.r - dot_compensated(v, v);
  c.eta = dot_compensated(x, v);
  c.zeta = strength - c.beta * c.r;

  // The angular momentum and its square.
  c.square = {0, 0};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const DoubleDouble part = difference_of_products(x[j], v[k], x[k], v[j]);
    c.square = c.square + part * part;
    c.h[i] = part.value();
  }

  // Both forms are (|mu| times the eccentricity)^2 as sums of squares. The first vanishes exactly for circles.
  c.bend =
      square_root(c.beta.hi > 0 ? c.zeta * c.zeta + c.beta * c.eta * c.eta : strength * strength - c.beta * c.square);
  return c;
}

/// The start's angle as seen from the pericentre.
SinCos true_anomaly(double mu, const Constants& c) {
  if (c.bend.hi == 0) return {0, 1};
  const double r = c.r.hi, e = c.bend.hi / mu;
  const double sine = c.eta.hi / r * (sqrt(c.square.hi) / c.bend.hi);
  // Near a circle the direction of the pericentre is lost to rounding. It only has to fit the start's phase.
  if (c.beta.hi > 0 && e < 0.5) return {sine, mu / (c.beta.hi * r) * (c.zeta.hi / c.bend.hi - e)};
  return {sine, ((c.square / c.r - DoubleDouble{mu, 0}) / c.bend).hi};
}

/// G1, G2, G3 of beta and s (in s/m: s, s^2 and s^3 times numbers).
struct Universal {
  double first, second, third;
};

Universal universal(double beta, double root, double s) {
  const double square = s * s, z = beta * square;
  if (z < -series_reach) {
    const double shrink = exp_minus(root * std::abs(s)), grow = 1 / shrink;
    const double first = std::copysign(0.5 * (grow - shrink), s) / root;
    return {first, (0.5 * (grow + shrink) - 1) / -beta, (first - s) / -beta};
  }

  const double size = std::abs(z);
  double second = 0, third = 0;
  for (size_t n = size < 0.3 ? 16 : size < 2.6 ? 22 : 28; n >= 2; n -= 2) {
    second = inverse_factorial[n] - z * second;
    third = inverse_factorial[n + 1] - z * third;
  }
  return {s * (1 - z * third), square * second, s * square * third};
}

/// The rounding error of inverse_factorial[n]: 1/n! - inverse_factorial[n].
// clang-format off
constexpr double inverse_factorial_rest[] = {
    0, 0, 0, 0x1.5555555555555p-57, 0x1.5555555555555p-59, 0x1.1111111111111p-63, -0x1.f49f49f49f49fp-65,
    0x1.a01a01a01a01ap-73, 0x1.a01a01a01a01ap-76, -0x1.c154f8ddc6c00p-73, 0x1.cbbc05b4fa99ap-76,
    -0x1.c062e06d1f209p-80, -0x1.2aec959e14c06p-83, 0x1.f28e0cc748ebep-87};
// clang-format on

/// 1/n! - z/(n + 2)! + z^2/(n + 4)! - ..., n = 2 or 3, to 2^-70 for |z| <= 6. The first terms are in two doubles.
DoubleDouble stumpff(DoubleDouble z, size_t n) {
  size_t m = n + 26;
  double tail = 0;
  for (; m > n + 10; m -= 2) tail = inverse_factorial[m] - z.hi * tail;
  DoubleDouble sum = {tail, 0};
  for (; m >= n; m -= 2) sum = DoubleDouble{inverse_factorial[m], inverse_factorial_rest[m]} - z * sum;
  return sum;
}

/// The time of the start (s) since an end of the long axis at `distance` (m). side = 1: the near end; -1: the far end.
DoubleDouble start_time(double mu, const Constants& c, double side, DoubleDouble distance) {
  // At parameter s from that end, bend G1 = eta and bend G0 = zeta.
  const DoubleDouble bend = side > 0 ? c.bend : -c.bend;
  if (bend.hi == 0) return {0, 0};

  // The parameter of the start, in doubles.
  const double root = sqrt(std::abs(c.beta.hi));
  double s = c.eta.hi / bend.hi;
  if (c.beta.hi > 0) s = arc_tangent(side * root * c.eta.hi, side * c.zeta.hi) / root;
  if (c.beta.hi < 0) s = arc_sinh(root * s) / root;

  const DoubleDouble exact = {s, 0}, one = {1, 0}, square = two_product(s, s), z = c.beta * square;
  // For a hyperbola far out, the time is distance s + bend G3, with G3 = (s - G1) / beta and distance beta + bend = mu.
  if (z.hi < -series_reach) return (two_product(mu, s) - c.eta) / c.beta;
  const DoubleDouble third = stumpff(z, 3), first = exact * (one - z * third), zeroth = one - z * stumpff(z, 2);

  // The error of s is G1 of a difference: sin(a - b) = sin(a) cos(b) - cos(a) sin(b), which holds for any beta.
  const double lacking = (c.eta * zeroth - c.zeta * first).hi / bend.hi;
  return exact * (distance + bend * square * third) + DoubleDouble{c.r.hi * lacking, 0};
}

/// x^(1/3) to 2 %, for x > 0.
double rough_cube_root(double x) {
  int exponent;
  double m = std::frexp(x, &exponent);
  for (; exponent % 3 != 0; --exponent) m *= 2;
  // Here m is in [1/2, 4).
  const double y = 0.68 + 0.245 * m;
  return std::ldexp(y - (y - m / (y * y)) / 3, exponent / 3);
}

/// log(x) to 0.006, for x > 0: log(3/4) + 2 atanh(w) for m = 3/4 (1 + w) / (1 - w).
double rough_logarithm(double x) {
  int exponent;
  // In [1/2, 1).
  const double m = std::frexp(x, &exponent);
  return 0.6931 * exponent - 0.2877 + 2 * (m - 0.75) / (m + 0.75);
}

}  // namespace

KeplerOrbit::KeplerOrbit(double mu, const Vec3& x, const Vec3& v) : mu_(mu), x_(x), v_(v) {
  const Constants c = constants(mu, x, v);
  const DoubleDouble strength = {mu, 0};
  beta_ = c.beta.hi;
  momentum_ = square_root(c.square).hi;
  const DoubleDouble root = square_root(beta_ > 0 ? c.beta : -c.beta);
  root_ = root.hi;

  // Two forms of the pericentre's distance. Each is a sum, never a difference.
  const DoubleDouble pericentre = mu > 0 ? c.square / (strength + c.bend) : (c.bend - strength) / -c.beta;
  near_ = {1, pericentre.hi, c.bend.hi};

  const SinCos angle = true_anomaly(mu, c);
  const Vec3 out = x / c.r.hi;
  const Vec3 along = momentum_ > 0 ? Vec3((c.h / momentum_).cross(out)) : Vec3(Vec3::Zero());
  ahead_ = angle.cos * out - angle.sin * along;
  aside_ = angle.sin * out + angle.cos * along;

  DoubleDouble start_from = pericentre;
  // Otherwise no double can count the turns.
  if (beta_ > 0 && mu / (beta_ * root_) < 0x1p900) {
    // In m and s.
    const DoubleDouble apocentre = (strength + c.bend) / c.beta, radian = strength / (c.beta * root);
    far_ = {-1, apocentre.hi, -c.bend.hi};
    period_ = DoubleDouble{4, 0} * half_pi * radian;
    quarter_ = (half_pi * radian).hi - near_.bend / (beta_ * root_);
    starts_far_ = c.zeta.hi < 0;
    if (starts_far_) start_from = apocentre;
  }
  start_ = start_time(mu, c, starts_far_ ? -1 : 1, start_from);
}

KeplerOrbit::Phase KeplerOrbit::phase(DoubleDouble t) const {
  DoubleDouble since = start_ + t;
  if (!(period_.hi < INFINITY)) return {&near_, since};

  // One pass suffices unless a double cannot count the turns. The phase is then unknown, but the position is still on
  // the orbit.
  constexpr int most = 32;
  const double half = 0.5 * period_.hi;
  for (int k = 0; k < most && std::abs(since.hi) > half; ++k) {
    const double turns = floor(since.hi / period_.hi + 0.5);
    since = since - period_ * DoubleDouble{turns, 0};
  }

  // The end of the long axis that is nearer in time.
  const bool same = std::abs(since.hi) <= (starts_far_ ? half - quarter_ : quarter_);
  if (!same) {
    const double sign = std::copysign(0.5, since.hi);
    since = since - DoubleDouble{sign * period_.hi, sign * period_.lo};
  }
  return {same == starts_far_ ? &far_ : &near_, since};
}

double KeplerOrbit::first_guess(const Apsis& from, double time) const {
  // For late times on a hyperbola: sinh(w) = n + mu w / bend, w = root s.
  const double n = beta_ < 0 ? root_ * -beta_ * time / from.bend : 0;
  if (n > 5) return rough_logarithm(2 * (n + mu_ / from.bend * rough_logarithm(2 * n))) / root_;

  // Otherwise the parabola's equation distance s + bend s^3 / 6 = time. Newton's method starts from the lesser of two
  // upper bounds.
  const double line = time / from.distance;
  if (from.bend * line * line < 0.5 * from.distance) return line;
  double s = min(line, rough_cube_root(6 * time / from.bend));
  for (int k = 0; k < 2; ++k) {
    const double third = from.bend * s * s / 6;
    s -= (s * (from.distance + third) - time) / (from.distance + 3 * third);
  }
  return s;
}

/// The s with distance s + bend G3(s) = time, to 1e-11 or better, for time > 0.
/// The method is Danby's fourth order form of Newton's (Celest. Mech. 40, 1987, 303), between bounds.
double KeplerOrbit::parameter(const Apsis& from, DoubleDouble time) const {
  // 2 to 4 are usual.
  constexpr int most = 100;
  // A step at which the fourth order leaves an error of its fourth power.
  constexpr double near = 0x1p-10;

  double s = first_guess(from, time.hi), low = 0, high = (beta_ > 0 ? 2 : 700) / root_;
  for (int k = 0; k < most; ++k) {
    const Universal g = universal(beta_, root_, s);
    const double rest = (time.hi - (from.distance * s + from.bend * g.third)) + time.lo;
    (rest > 0 ? low : high) = s;

    const double slope = from.distance + from.bend * g.second, bend = from.bend * g.first;
    double step = rest / slope;
    step = rest / (slope + 0.5 * step * bend);
    step = rest / (slope + step * (0.5 * bend + step * from.bend * (1 - beta_ * g.second) / 6));
    if (std::abs(step) <= near * s) return s + step;

    // Where the step leaves the bounds, their middle takes its place.
    const double next = s + step;
    s = next > low && next < high ? next : (high < INFINITY ? 0.5 * (low + high) : 2 * low);
  }
  return s;
}

void KeplerOrbit::at(DoubleDouble t, Vec3& x, Vec3& v) const {
  if (t.hi == 0) {
    x = x_;
    v = v_;
    return;
  }

  const auto [apsis, time] = phase(t);
  const double sign = std::copysign(1.0, time.hi);
  const DoubleDouble length = {sign * time.hi, sign * time.lo};
  const double s = length.hi == 0 ? 0 : parameter(*apsis, length);
  const Universal g = universal(beta_, root_, s);
  const double r = apsis->distance + apsis->bend * g.second;

  if (r == 0) {
    x = v = Vec3::Zero();
    return;
  }
  const double side = apsis->side;
  x = side * (apsis->distance - mu_ * g.second) * ahead_ + sign * side * momentum_ * g.first * aside_;
  v = -sign * side * (mu_ * g.first / r) * ahead_ + side * (momentum_ * (1 - beta_ * g.second) / r) * aside_;

  // The last step of Newton's method is taken by the position itself, because s would round it.
  const double rest = sign * ((length.hi - (apsis->distance * s + apsis->bend * g.third)) + length.lo);
  const Vec3 pull = -mu_ / r * (x / r) / r;
  x += rest * v;
  v += rest * pull;
}

double KeplerOrbit::closest_time() const {
  if (starts_far_) return 0.5 * period_.hi - start_.hi;
  return start_.hi > 0 ? period_.hi - start_.hi : std::abs(start_.hi);
}

}  // namespace carom
