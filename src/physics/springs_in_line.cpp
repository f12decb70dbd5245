// Along a line s the push of a spring is k (l sign(s) - s). Between anchors that is linear, so that a method of any
// order keeps its order there. A step must end at an anchor. The error control alone would approach each passage in
// ever shorter steps. One of these would then step over the turn, with an error that the estimate just allows.
#include "physics/springs_in_line.h"

#include "physics/force.h"
#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

// Deviation across the line, as a share of the length, that counts as on the line.
constexpr double off_line = 0x1p-40;
// Rounding of a position on the line, as a share of the coordinates.
constexpr double rounding = 0x1p-44;
// A share of the step: a body that leaves an anchor has left it by then.
constexpr double soon = 0x1p-6;
// A body at more than so many times that rounding is off the anchor.
constexpr double plainly = 0x1p10;
constexpr int halvings = 60;

Vec3 direction(const Vec3& of) {
  const double length = of.norm();
  return length > 0 ? Vec3(of / length) : Vec3(Vec3::Zero());
}

}  // namespace

SpringsInLine::SpringsInLine(const World& world, Entity body, double time, const Vec3& x, const Vec3& v,
                             const Vec3& a) {
  for (const Force& force : world.forces) {
    const Spring* const spring = std::get_if<Spring>(&force.law);
    if (spring == nullptr || spring->rest_length == 0 || spring->stiffness == 0 || !acts(force, body, time)) continue;
    const Vec3 d = x - spring->anchor;
    const double rounded = rounding * (x.norm() + spring->anchor.norm() + spring->rest_length);

    // The direction is that of the position. Near the anchor, where the position is mere rounding, it is that of the
    // velocity.
    if (!any()) along_ = direction(d.norm() > plainly * rounded ? d : v);

    // The body must be on the line, and move along it.
    const double rate = sqrt(spring->stiffness / world.mass[body]), speed = v.norm() + rate * spring->rest_length;
    const bool on_line = d.cross(along_).norm() <= off_line * d.norm() + rounded;
    if (along_.isZero(0) || !on_line || !(v.cross(along_).norm() <= off_line * speed)) {
      springs_.clear();
      return;
    }

    // A body leaves an anchor in the direction in which it came.
    const double s = d.dot(along_);
    const double side = std::copysign(1.0, std::abs(s) > rounded ? s : v.dot(along_));
    springs_.push_back({spring->anchor, spring->stiffness * spring->rest_length / world.mass[body], side, rounded});
  }

  if (!any()) return;
  const Vec3 smooth = a + correction(x);
  if (!(smooth.cross(along_).norm() <= off_line * smooth.norm())) springs_.clear();
}

/// The spring's acceleration without a turn less that at x (m), in m/s^2.
Vec3 SpringsInLine::correction(const Vec3& x) const {
  Vec3 sum = Vec3::Zero();
  for (const OneSpring& spring : springs_) {
    sum += spring.push * (spring.side * along_ - direction(x - spring.anchor));
  }
  return sum;
}

double SpringsInLine::arrival(const Vec3& x, const PolynomialPath& path) const {
  double first = infinity;
  for (const OneSpring& spring : springs_) {
    const double start = spring.side * (x - spring.anchor).dot(along_);
    const auto beyond = [&](double t) { return start + spring.side * path.displacement_at(t).dot(along_) < 0; };
    if (!(start + spring.side * path.displacement_at(path.length).dot(along_) < -spring.rounded)) continue;

    // Between these times it passes the anchor.
    double before = start > spring.rounded ? 0 : soon * path.length, after = path.length;
    if (beyond(before)) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (before + after);
      (beyond(middle) ? after : before) = middle;
    }
    first = min(first, after);
  }

  return first;
}

}  // namespace carom
