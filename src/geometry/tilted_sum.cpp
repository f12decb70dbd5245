// The Minkowski sum of an upright cylinder and a wall at any angle: flat faces, caps, and patches of an oblique
// cylinder. A patch is treated in the shadow along its segment, where it is an arc of a circle. Contact with it is then
// contact of spheres in closed form.
#include "geometry/tilted_sum.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

constexpr int first_of_face[3] = {0, 0, 1}, second_of_face[3] = {1, 2, 2};

Vec3 level_part(const Vec3& p) {
  return {p.x(), 0, p.z()};
}

double level_length(const Vec3& p) {
  return sqrt(p.x() * p.x() + p.z() * p.z());
}

}  // namespace

TiltedSum::TiltedSum(const Volume& cylinder, const Wall& wall)
    : radius_(cylinder.half.x()),
      segments_{Vec3(0, cylinder.half.y(), 0), wall.half_width * wall.right, wall.half_height * wall.up},
      size_(radius_ + cylinder.half.y() + wall.half_width + wall.half_height) {
  for (size_t k = 0; k < 3; ++k) casts_[k] = std::abs(segments_[k].y()) > 0x1p-40 * segments_[k].norm();
  const Vec3 along[3] = {Vec3::UnitY(), wall.right, wall.up};
  for (size_t k = 0; k < 2; ++k) {
    const Vec3 cross = along[0].cross(along[k + 1]);
    const double sine = cross.norm();
    face_normals_[k] = sine < 0x1p-50 ? Vec3::Zero() : Vec3(cross / sine);
  }
  face_normals_[2] = wall.normal;
}

/// The extent of the sum along the unit vector n (m).
double TiltedSum::support(const Vec3& n) const {
  double reach = radius_ * level_length(n);
  for (const Vec3& segment : segments_) reach += std::abs(segment.dot(n));
  return reach;
}

TiltedSum::Patch TiltedSum::patch(uint8_t feature) const {
  const int along = (feature - patches) / 4, corner = (feature - patches) % 4;
  const Vec3& u = segments_[along == 0 ? 1 : 0];
  const Vec3& v = segments_[along == 2 ? 1 : 2];
  return {along, (corner % 2 == 0 ? 1.0 : -1.0) * u + (corner / 2 == 0 ? 1.0 : -1.0) * v};
}

/// p projected along a segment into the disc's plane.
Vec3 TiltedSum::shadow(const Vec3& p, int along) const {
  const Vec3& g = segments_[size_t(along)];
  return level_part(p - p.y() / g.y() * g);
}

/// The normal in space (not unit) of a line with the normal `level` in the projection along a segment.
Vec3 TiltedSum::slanted(const Vec3& level, int along) const {
  const Vec3& g = segments_[size_t(along)];
  return {level.x(), -(level.x() * g.x() + level.z() * g.z()) / g.y(), level.z()};
}

/// The corner of the shadow's parallelogram nearest to p's shadow, if a corner is the nearest part.
uint8_t TiltedSum::nearest_corner(const Vec3& p, int along) const {
  const Vec3 q = shadow(p, along);
  const Vec3 side[2] = {shadow(segments_[along == 0 ? 1 : 0], along), shadow(segments_[along == 2 ? 1 : 2], along)};

  uint8_t best = no_feature;
  double best_distance = never;
  for (int corner = 0; corner < 4; ++corner) {
    const double signs[2] = {corner % 2 == 0 ? 1.0 : -1.0, corner / 2 == 0 ? 1.0 : -1.0};
    const Vec3 e = q - (signs[0] * side[0] + signs[1] * side[1]);
    // The corner's own wedge: neither side that ends here comes nearer.
    if (signs[0] * e.dot(side[0]) < 0 || signs[1] * e.dot(side[1]) < 0) continue;

    const double distance = e.squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best = uint8_t(patches + 4 * along + corner);
    }
  }

  return best;
}

Vec3 TiltedSum::face_normal(uint8_t feature) const {
  const Vec3 n = feature < caps ? face_normals_[feature / 2] : Vec3(0, 1, 0);
  return feature % 2 == 0 ? n : Vec3(-n);
}

Separation TiltedSum::at(const Vec3& p, uint8_t feature) const {
  if (flat(feature)) {
    const Vec3 n = face_normal(feature);
    return {n.dot(p) - support(n), n, feature};
  }
  const Patch arc = patch(feature);
  const Vec3 e = shadow(p - arc.center, arc.along);
  const double rho = e.norm();
  const Vec3 n = slanted(rho > 0 ? Vec3(e / rho) : Vec3::UnitX(), arc.along).normalized();
  return {n.dot(p - arc.center) - radius_ * level_length(n), n, feature};
}

Separation TiltedSum::nearest(const Vec3& p) const {
  return nearest_but(p, -1);
}

Separation TiltedSum::nearest_but(const Vec3& p, int without) const {
  Separation best{-never, Vec3::UnitY(), caps};
  for (uint8_t face = 0; face < patches; face = uint8_t(face + 2)) {
    const Vec3 n = face_normal(face);
    if (n.isZero(0) || face / 2 == without) continue;
    const double along = n.dot(p), gap = std::abs(along) - support(n);
    if (gap > best.gap) best = {gap, along < 0 ? Vec3(-n) : n, uint8_t(face + (along < 0))};
  }

  for (int along = 0; along < 3; ++along) {
    if (!casts_[size_t(along)]) continue;
    const uint8_t corner = nearest_corner(p, along);
    if (corner == no_feature) continue;

    // For every normal the sum lies beyond the plane. The arc's own normal is the best of those across this segment.
    Separation s = at(p, corner);
    s.gap = s.normal.dot(p) - support(s.normal);
    if (s.gap > best.gap) best = s;
  }

  return best;
}

double TiltedSum::displaced_gap(const Vec3& p, uint8_t feature, double gap, const Vec3& by) const {
  if (flat(feature)) return gap + face_normal(feature).dot(by);
  // The change of length in the shadow, |e + by| - |e|.
  const Patch arc = patch(feature);
  const Vec3 e = shadow(p - arc.center, arc.along), d = shadow(by, arc.along);
  const double from = e.norm(), to = (e + d).norm();
  if (from == 0 || to == 0) return gap;
  const double slant_from = slanted(e / from, arc.along).norm(), slant_to = slanted((e + d) / to, arc.along).norm();
  return (gap * slant_from + d.dot(2 * e + d) / (from + to)) / slant_to;
}

double TiltedSum::bending(const Vec3& p, uint8_t feature, const Vec3& w) const {
  if (flat(feature)) return 0;
  const Patch arc = patch(feature);
  const Vec3 e = shadow(p - arc.center, arc.along), level = shadow(w, arc.along);
  const double rho = e.norm();
  if (rho == 0) return 0;
  const double across = (e.x() * level.z() - e.z() * level.x()) / rho;
  return across * across / rho / slanted(e / rho, arc.along).norm();
}

/// A patch's cross-section is an ellipse: the disc as seen along the segment.
double TiltedSum::curvature_radius(const Vec3& p, uint8_t feature) const {
  const Vec3& g = segments_[size_t(patch(feature).along)];
  return 1 / bending(p, feature, at(p, feature).normal.cross(g.normalized()));
}

bool TiltedSum::as_spheres(uint8_t feature, const RelativeMotion& m, RelativeMotion& reduced, double& radius) const {
  if (flat(feature)) return false;
  const Patch arc = patch(feature);
  reduced = {shadow(m.d - arc.center, arc.along), shadow(m.w, arc.along), shadow(m.a, arc.along), m.speeds,
             m.just_separated};
  radius = radius_;
  return true;
}

FeatureTime TiltedSum::leave(uint8_t feature, const RelativeMotion& m, double horizon) const {
  FeatureTime first{never, no_feature};
  if (!flat(feature)) return first;
  const Vec3 n = face_normal(feature);

  // The face is the part of the sum that lies farthest along n: a polygon about its centre, enlarged by the disc under
  // a cap.
  Vec3 center = Vec3::Zero();
  array<Vec3, 3> sides;
  size_t count = 0;
  for (size_t k = 0; k < 3; ++k) {
    const Vec3& g = segments_[k];
    const double along = g.dot(n);
    const bool spans =
        feature < caps && (int(k) == first_of_face[feature / 2] || int(k) == second_of_face[feature / 2]);

    if (spans || std::abs(along) <= 0x1p-50 * g.norm()) {
      sides[count++] = g;
    } else {
      center += along > 0 ? g : Vec3(-g);
    }
  }

  const bool cap = feature >= caps;
  if (!cap) center += radius_ * level_part(n) / level_length(n);
  const Vec3 d = m.d - center;

  Vec3 outward = Vec3::Zero();
  const auto offer = [&](double t, const Vec3& out) {
    if (!(t < first.time) || t > horizon) return;
    first.time = t;
    outward = out;
  };

  // The rim's straight parts.
  for (size_t k = 0; k < count; ++k) {
    const Vec3 q = n.cross(sides[k]).normalized();
    double reach = cap ? radius_ : 0;
    for (size_t j = 0; j < count; ++j)
      if (j != k) reach += std::abs(q.dot(sides[j]));

    for (double sign : {1.0, -1.0}) {
      const Vec3 out = sign * q;
      offer(plane_contact_time(reach - out.dot(d), -out.dot(m.w), -out.dot(m.a), 0, false, horizon), out);
    }
  }

  // Its round ends.
  if (cap) {
    for (double sign : {1.0, -1.0}) {
      const Vec3 end = count > 0 ? Vec3(sign * sides[0]) : Vec3::Zero();
      const RelativeMotion level{level_part(d - end), level_part(m.w), level_part(m.a), m.speeds, false};
      const Roots exits = exit_times(level, radius_, horizon);
      for (int k = 0; k < exits.count; ++k) {
        const double t = exits.at[size_t(k)];
        const Vec3 e = level.d + t * (level.w + 0.5 * t * level.a);
        if (end.dot(e) >= -0x1p-40 * end.norm() * radius_) offer(t, e.normalized());
      }
    }
  }

  if (first.time < never) {
    // A little beyond the rim another feature is the nearest.
    const Vec3 p = m.d + first.time * (m.w + 0.5 * first.time * m.a) + 0x1p-20 * radius_ * outward;
    first.feature = nearest_but(p, feature / 2).feature;
  }

  return first;
}

}  // namespace carom
