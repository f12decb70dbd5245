// A region is what meets a few conditions: to be on one side of a plane, or within a distance of a point or an axis.
// Along a path each condition is a polynomial, of degree 2 or 4 on a parabola. Its roots are isolated in Bernstein's
// basis, by the number of changes of sign (Farouki, Computer Aided Geometric Design 29 (2012) 379). They are then
// refined on the path itself, for a parabola in double-double, so that a time has the rounding of one number.
// Conditions on single coordinates come first: far from the region the powers of a distance have no digits left.
#include "geometry/region_crossing.h"

#include "numerics/bernstein.h"
#include "numerics/bracketed_root.h"
#include "numerics/compensated.h"
#include "std.h"

namespace carom {

CenterPath CenterPath::along(const Vec3& x, const Vec3& v, const Vec3& a, double length) {
  CenterPath path{x, v, a, true, {}, length};
  path.displacement.fill(Vec3::Zero());
  path.displacement[0] = length * v;
  path.displacement[1] = (0.5 * length * length) * a;
  return path;
}

CenterPath CenterPath::along(const Vec3& x, const PolynomialPath::Terms& displacement, double length) {
  return {x, Vec3::Zero(), Vec3::Zero(), false, displacement, length};
}

namespace {

struct Stretch {
  double from, to;  // s
};

/// A condition on a centre: met where its value is below zero. It is a distance along an axis, or the squared distance
/// in some coordinates, less a limit.
class Condition {
 public:
  /// (x - point) . normal < reach
  static Condition side(const CenterPath& path, const Vec3& point, const Vec3& normal, double reach) {
    return {path, point, normal, reach, false};
  }
  /// |x - point| < reach, in the coordinates that `axes` has as ones
  static Condition round(const CenterPath& path, const Vec3& point, const Vec3& axes, double reach) {
    return {path, point, axes, reach, true};
  }

  double value(double t) const {
    array<DoubleDouble, 3> d;
    const Vec3 bent = path_.parabola ? Vec3(Vec3::Zero()) : PolynomialPath::value(path_.displacement, t / path_.length);

    // From the point.
    const DoubleDouble half_square = two_product(0.5 * t, t);
    for (int k = 0; k < 3; ++k) {
      DoubleDouble& at = d[size_t(k)];
      at = two_sum(path_.x[k], -point_[k]);
      at = path_.parabola ? at + (two_product(t, path_.v[k]) + half_square * DoubleDouble{path_.a[k], 0})
                          : at + DoubleDouble{bent[k], 0};
    }

    DoubleDouble sum = round_ ? -two_product(reach_, reach_) : DoubleDouble{-reach_, 0};
    for (int k = 0; k < 3; ++k) {
      const DoubleDouble& at = d[size_t(k)];
      if (axes_[k] != 0) sum = sum + at * (round_ ? at : DoubleDouble{axes_[k], 0});
    }

    return sum.value();
  }

  double slope(double t) const {
    const Vec3 w = path_.parabola ? Vec3(path_.v + t * path_.a)
                                  : Vec3(PolynomialPath::slope(path_.displacement, t / path_.length) / path_.length);
    return round_ ? 2 * axes_.cwiseProduct(distance(t)).dot(w) : axes_.dot(w);
  }

  /// As a polynomial on an interval.
  Bernstein on(const Stretch& in) const {
    const PolynomialPath::Terms terms =
        PolynomialPath::shifted(path_.displacement, in.from / path_.length, (in.to - in.from) / path_.length);
    const size_t count = path_.parabola ? 2 : PolynomialPath::terms;

    array<double, Bernstein::most_degree + 1> a{};
    a[0] = value(in.from);
    if (!round_) {
      for (size_t k = 0; k < count; ++k) a[k + 1] = axes_.dot(terms[k]);
      return Bernstein::of_powers(a, count);
    }

    const Vec3 start = axes_.cwiseProduct(distance(in.from));
    for (size_t k = 0; k < count; ++k) {
      const Vec3 term = axes_.cwiseProduct(terms[k]);
      a[k + 1] += 2 * start.dot(term);
      for (size_t j = 0; j < count; ++j) a[k + j + 2] += term.dot(terms[j]);
    }

    return Bernstein::of_powers(a, 2 * count);
  }

 private:
  Condition(const CenterPath& path, const Vec3& point, const Vec3& axes, double reach, bool round)
      : path_(path), point_(point), axes_(axes), reach_(reach), round_(round) {}

  /// From the point, m.
  Vec3 distance(double t) const {
    const Vec3 way = path_.parabola ? Vec3(t * (path_.v + (0.5 * t) * path_.a))
                                    : PolynomialPath::value(path_.displacement, t / path_.length);
    return (path_.x - point_) + way;
  }

  const CenterPath& path_;
  Vec3 point_, axes_;
  double reach_;
  bool round_;
};

/// The only root of a condition in an interval.
double refine(const Condition& condition, const Stretch& in, bool falling) {
  return bracketed_root([&](double t) { return condition.value(t); }, [&](double t) { return condition.slope(t); },
                        in.from, in.to, falling);
}

/// Appends the roots of a condition in an interval at which its sign changes, in order.
void add_roots(const Condition& condition, Bernstein& f, const Stretch& in, vector<double>& roots) {
  const int changes = f.changes();
  if (changes == 0) return;

  const double middle = in.from + 0.5 * (in.to - in.from);
  const bool narrow = !(middle > in.from && middle < in.to);
  if (changes == 1 || narrow) {
    const bool falling = f.b[0] > 0 || f.b[f.degree] < 0;
    if (changes % 2 == 1) roots.push_back(narrow ? in.to : refine(condition, in, falling));
    return;
  }

  Bernstein right = f.split();
  add_roots(condition, f, {in.from, middle}, roots);

  // A root at the middle itself is none of the open halves.
  if (right.b[0] == 0 && f.changes() % 2 == 0) {
    const auto sign = [](const Bernstein& of, bool last) {
      for (size_t k = 0; k <= of.degree; ++k)
        if (const double b = of.b[last ? of.degree - k : k]; b != 0) return b < 0 ? -1 : 1;
      return 0;
    };
    if (sign(f, true) * sign(right, false) < 0) roots.push_back(middle);
  }

  add_roots(condition, right, {middle, in.to}, roots);
}

/// Reduces the intervals to those in which the condition is met.
void restrict_to(const Condition& condition, vector<Stretch>& intervals) {
  vector<Stretch> met;
  vector<double> roots;
  for (const Stretch& in : intervals) {
    Bernstein f = condition.on(in);

    // Without a sign at the start, the next term tells it.
    double sign = 0;
    for (size_t k = 0; k <= f.degree && sign == 0; ++k) sign = f.b[k];

    roots.clear();
    add_roots(condition, f, in, roots);

    double from = in.from;
    bool below = sign < 0;
    for (const double root : roots) {
      if (below) met.push_back({from, root});
      from = root;
      below = !below;
    }
    if (below) met.push_back({from, in.to});
  }

  intervals = std::move(met);
}

/// When the path is inside the region, `margin` (m) wider on all sides.
vector<Stretch> inside_of(const WorldRegion& region, const CenterPath& path, const Stretch& in, double margin) {
  vector<Stretch> intervals{in};
  if (region.is_side()) {
    restrict_to(Condition::side(path, region.position, -region.normal, margin), intervals);
    return intervals;
  }

  const Vec3& half = region.volume.half;
  for (int k = 0; k < 3 && !intervals.empty(); ++k)
    for (const double side : {-1.0, 1.0})
      restrict_to(Condition::side(path, region.position, side * Vec3::Unit(k), half[k] + margin), intervals);

  if (region.volume.shape == Shape::box || intervals.empty()) return intervals;
  const Vec3 axes = region.volume.shape == Shape::sphere ? Vec3(1, 1, 1) : Vec3(1, 0, 1);
  restrict_to(Condition::round(path, region.position, axes, half.x() + margin), intervals);
  return intervals;
}

}  // namespace

optional<CrossingTime> next_crossing(const WorldRegion& region, const CenterPath& path, double from, bool inside,
                                     double margin) {
  if (!(path.length > from)) return nullopt;
  const vector<Stretch> deep = inside_of(region, path, {from, path.length}, inside ? margin : -margin);

  double sure = from;
  if (!inside) {
    if (deep.empty()) return nullopt;
    sure = deep.front().from;
  } else if (!deep.empty() && deep.front().from == from) {
    sure = deep.front().to;
    if (sure == path.length) return nullopt;
  }

  if (sure == from) return CrossingTime{from, from};

  // The boundary itself is crossed before.
  const vector<Stretch> real = inside_of(region, path, {from, sure}, 0);
  if (real.empty()) return CrossingTime{inside ? from : sure, sure};
  return CrossingTime{inside ? real.back().to : real.back().from, sure};
}

}  // namespace carom
