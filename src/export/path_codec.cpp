// One function codes a piece in both directions, so that the two sides cannot differ.
//
// In a gas the impact of two bodies gives their velocities, and the closed form of its time the start. Only the pair is
// stored, and the rounding of the simulator's own formulas. In a crowd the drift of a step gives the next place, and
// two drifts give the kick between them, unless the body has had an impact.
//
// An entry has, in these columns:
//   body    1 more than the body less that of the entry before less 1, folded (0, -1, 1, ... are 0, 1, 2, ...); 0: a
//           collision. With `strikes`, the other body less this one less 1, folded.
//   shape   bits of EntryShape; of a collision its kind
//   others  what the shape says that the prediction lacks, in the order of the calls
// A collision has a and b in `other`, less those of the collision before, folded, and the difference of its time to
// that one's. Where impulses are recorded, the difference of its impulse to that one's comes after it in `velocity`.
#include "export/path_codec.h"

#include <cstring>

#include "physics/restitution.h"
#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

enum EntryShape : uint8_t {
  time_mask = 3,
  other_traits = 4,
  other_place = 8,
  other_velocity = 16,
  other_acceleration = 32,
  strikes = 64,     // where a piece is not kicked
  other_base = 64,  // of a kicked piece
  odd_kick = 128
};

/// How the start of a piece follows.
enum StartWay : uint8_t {
  of_entry_before,  // the same
  end_of_piece,     // where the step ends that the body's present piece is
  since_piece,      // the present piece's start and a number of seconds
  plain
};

enum PieceTrait : uint32_t {
  is_kicked = 1,
  is_curve = 2,
  is_parabola = 4,
  is_part = 8,
  is_joint = 16,
  is_removed = 32,
  is_fading = 64,
  first_law = 128,
  all_laws = 3 * first_law,
  is_late = 512,  // `from` is not the first double of the start, nor that of the entry before
  all_traits = 1023
};

uint32_t traits_of(const PathPiece& piece) {
  return (piece.kicked ? is_kicked : 0u) | (piece.curve ? is_curve : 0u) |
         (piece.curve && piece.curve->is_parabola ? is_parabola : 0u) | (piece.part_of != no_entity ? is_part : 0u) |
         (piece.joint ? is_joint : 0u) | (piece.removed ? is_removed : 0u) | (piece.fade != 0 ? is_fading : 0u) |
         uint32_t(piece.law) * first_law;
}

bool same_bits(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}
bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}
bool same_bits(const DoubleDouble& a, const DoubleDouble& b) {
  return same_bits(a.hi, b.hi) && same_bits(a.lo, b.lo);
}

double seconds(const DoubleDouble& from, const DoubleDouble& to) {
  return (to.hi - from.hi) + (to.lo - from.lo);
}

DoubleDouble after(const DoubleDouble& time, double dt) {
  const DoubleDouble sum = two_sum(time.hi, dt);
  return fast_two_sum(sum.hi, sum.lo + time.lo);
}

/// From the start of a kicked piece to the middle of its step (s).
double half_step(const PathPiece& piece) {
  return seconds(piece.start, piece.until);
}

double product(const Vec3& a, const Vec3& b) {
  return a.x() * b.x() + (a.y() * b.y() + a.z() * b.z());
}

/// The place (m) at a time (s) since the start of a parabola or a curve.
Vec3 place_at(const PathPiece& piece, double t) {
  if (piece.curve) return piece.x + piece.curve->displacement_at(t);
  const double half = 0.5 * t;
  return {piece.x.x() + t * (piece.v.x() + half * piece.a.x()), piece.x.y() + t * (piece.v.y() + half * piece.a.y()),
          piece.x.z() + t * (piece.v.z() + half * piece.a.z())};
}

Vec3 velocity_at(const PathPiece& piece, double t) {
  if (piece.curve) return piece.v + piece.curve->change_at(t);
  return {piece.v.x() + t * piece.a.x(), piece.v.y() + t * piece.a.y(), piece.v.z() + t * piece.a.z()};
}

Vec3 place_at(const PathPiece& piece, const DoubleDouble& time) {
  return place_at(piece, seconds(piece.start, time));
}

/// The velocity that the body has at `time`. At the end of Verlet's steps the next acceleration is missing.
Vec3 velocity_at(const PathPiece& piece, const DoubleDouble& time) {
  const Vec3 v = velocity_at(piece, seconds(piece.start, time));
  if (piece.kicked) return v - seconds(time, piece.until) * piece.kick;
  return piece.curve ? Vec3(v - piece.curve->ahead) : v;
}

/// Where the step ends that a piece is.
DoubleDouble end_of(const PathPiece& piece) {
  if (piece.kicked) return after(piece.start, 2 * half_step(piece));
  return after(piece.start, piece.curve ? piece.curve->length : 0);
}

/// Finds the velocity before a kick: (v - base) / time has the bits of `kick`. False: none has.
bool find_base(double usual, double v, double time, double kick, double& base) {
  const auto gives_kick = [&](double candidate) {
    base = candidate;
    return same_bits((v - base) / time, kick);
  };
  if (gives_kick(usual)) return true;
  const double near = v - time * kick;
  if (gives_kick(near)) return true;
  return gives_kick(std::nextafter(near, v)) || gives_kick(std::nextafter(near, 2 * near - v)) || gives_kick(near);
}

uint64_t fold(int64_t x) {
  return uint64_t(x) << 1 ^ uint64_t(x >> 63);
}
int64_t unfold(uint64_t x) {
  return int64_t(x >> 1 ^ (0 - (x & 1)));
}

/// What is read may be any number.
int64_t sum(int64_t a, int64_t b) {
  return int64_t(uint64_t(a) + uint64_t(b));
}

int64_t number_of(Entity e) {
  return int64_t(e);
}

}  // namespace

double PredictedImpact::impulse() const {
  return (approach + restitution * approach) / (1 / mass + 1 / other_mass);
}
Vec3 PredictedImpact::after() const {
  return v - (impulse() / mass) * normal;
}
Vec3 PredictedImpact::other_after() const {
  return other_v + (impulse() / other_mass) * normal;
}

/// One direction: the same calls write an entry, or read it.
template <typename Columns>
struct PathCodec::Side {
  Columns& columns;
  uint8_t shape = 0;
  bool damaged = false;

  /// Whether a bit of the shape is set. The writer sets it if `yes`.
  bool flag(uint8_t bit, bool yes) {
    if constexpr (Columns::writes) {
      if (yes) shape |= bit;
      return yes;
    } else {
      return (shape & bit) != 0;
    }
  }
  void value(Column column, double predicted, double& actual) {
    if constexpr (Columns::writes)
      columns.difference(column, predicted, actual);
    else
      actual = columns.difference(column, predicted);
  }
  void value(Column column, const Vec3& predicted, Vec3& actual) {
    for (int k = 0; k < 3; ++k) value(column, predicted[k], actual[k]);
  }
  void value(Column column, const DoubleDouble& predicted, DoubleDouble& actual) {
    value(column, predicted.hi, actual.hi);
    value(column, predicted.lo, actual.lo);
  }
  /// The same, with no more than a bit of the shape if it is as predicted.
  template <typename Value>
  void value(uint8_t bit, Column column, const Value& predicted, Value& actual) {
    if (flag(bit, Columns::writes && !same_bits(predicted, actual)))
      value(column, predicted, actual);
    else
      actual = predicted;
  }
  /// A whole number that is most often near `predicted`.
  void number(Column column, int64_t predicted, int64_t& actual) {
    if constexpr (Columns::writes)
      columns.number(column, fold(actual - predicted));
    else
      actual = sum(predicted, unfold(columns.number(column)));
  }
  /// A body. What is read must be one.
  void entity(Column column, Entity predicted, Entity& actual, size_t bodies) {
    int64_t number_read = number_of(actual);
    number(column, number_of(predicted), number_read);
    if (number_read < 0 || number_read >= int64_t(bodies)) {
      damaged = true;
      number_read = 0;
    }
    actual = Entity(number_read);
  }
};

PathCodec::PathCodec(const World& world, bool impulses)
    : entities_(world.entity_count()),
      impulses_(impulses),
      present_(world.body_count()),
      mass_(world.mass),
      radius_(world.radius) {}

void PathCodec::begin_block(double time) {
  body_ = no_entity;
  from_ = time;
  start_ = {time, 0};
  until_ = {time, 0};
  collision_ = {};
  restitution_ = 0;
  last_mass_ = 0;
  last_radius_ = 0;
  struck_ = no_entity;
}

void PathCodec::write(ColumnWriter& to, const PathPiece& piece, const PathPiece* next, const World& world) {
  Side<ColumnWriter> side{to};
  PathPiece written = piece;
  to.number(Column::body, 1 + fold(number_of(piece.body) - number_of(body_ + 1)));
  PredictedImpact impact = impact_between(piece, next, world);
  code(side, written, impact);
  to.byte(Column::shape, side.shape);
  present_[piece.body] = std::move(written);
}

void PathCodec::write(ColumnWriter& to, const CollisionMark& collision) {
  to.number(Column::body, 0);
  to.byte(Column::shape, uint8_t(collision.kind));
  to.number(Column::other, fold(number_of(collision.a) - number_of(collision_.a)));
  to.number(Column::other, fold(number_of(collision.b) - number_of(collision_.b)));
  to.difference(Column::time, collision_.time, collision.time);
  if (impulses_) to.difference(Column::velocity, collision_.impulse, collision.impulse);
  collision_ = collision;
}

bool PathCodec::read(ColumnReader& from, Recorded& recorded) {
  Side<ColumnReader> side{from};
  const uint64_t which = from.number(Column::body);
  side.shape = from.byte(Column::shape);
  if (which == 0) {
    recorded.kind = Recorded::Kind::collision;
    CollisionMark& mark = recorded.collision;
    mark.kind = static_cast<CollisionKind>(side.shape);

    side.entity(Column::other, collision_.a, mark.a, present_.size());
    side.entity(Column::other, collision_.b, mark.b, entities_);
    mark.time = from.difference(Column::time, collision_.time);
    if (impulses_) mark.impulse = from.difference(Column::velocity, collision_.impulse);
    collision_ = mark;
    return !side.damaged && !from.damaged();
  }

  recorded.kind = Recorded::Kind::piece;
  const int64_t body = sum(number_of(body_ + 1), unfold(which - 1));
  if (body < 0 || body >= int64_t(present_.size())) return false;
  recorded.piece = {};
  recorded.piece.body = Entity(body);
  PredictedImpact impact;
  code(side, recorded.piece, impact);
  present_[recorded.piece.body] = recorded.piece;
  return !side.damaged && !from.damaged();
}

template <typename Columns>
void PathCodec::code(Side<Columns>& side, PathPiece& piece, PredictedImpact& impact) {
  const PathPiece& before = present_[piece.body];
  if (before.body == no_entity) code_size(side, piece.body);

  // What kind of piece it is.
  const int64_t usual = traits_of(before);
  int64_t traits = usual;
  if constexpr (Columns::writes) traits = traits_of(piece) | (same_bits(piece.from, usual_from(piece)) ? 0u : is_late);
  if (side.flag(other_traits, traits != usual)) side.number(Column::other, usual, traits);
  if (traits < 0 || traits > all_traits) side.damaged = true;
  piece.kicked = (traits & is_kicked) != 0;
  piece.removed = (traits & is_removed) != 0;
  piece.joint = (traits & is_joint) != 0;
  piece.law = static_cast<PathLaw>((traits & all_laws) / first_law);

  // When it holds.
  if (!piece.kicked && side.flag(strikes, impact.other != no_entity))
    side.entity(Column::body, piece.body + 1, impact.other, present_.size());
  if (impact.other != no_entity && (before.body == no_entity || present_[impact.other].body == no_entity)) {
    side.damaged = true;
    impact.other = no_entity;
  }
  code_time(side, piece, impact.other);
  const double from = usual_from(piece);
  if (traits & is_late)
    side.value(Column::time, from, piece.from);
  else
    piece.from = from;

  // The motion.
  PolynomialPath curve;
  if (piece.curve) curve = *piece.curve;
  curve.is_parabola = (traits & is_parabola) != 0;
  code_place(side, piece);
  if (traits & is_curve) code_step(side, piece, curve);
  code_velocity(side, piece, impact, curve.ahead);
  if (traits & is_curve) code_curve(side, piece, curve);
  code_rest(side, piece, traits);

  body_ = piece.body;
  from_ = piece.from;
  start_ = piece.start;
  if (piece.kicked) until_ = piece.until;
}

/// The first double at which a piece holds: that of its start, but none before the entry before.
double PathCodec::usual_from(const PathPiece& piece) const {
  const double hi = piece.start.hi;
  return max(piece.start.lo > 0 ? std::nextafter(hi, infinity) : hi, from_);
}

/// A body's mass and radius, with its first piece. Most often they are those of the body before.
template <typename Columns>
void PathCodec::code_size(Side<Columns>& side, Entity body) {
  side.value(Column::other, last_mass_, mass_[body]);
  side.value(Column::other, last_radius_, radius_[body]);
  last_mass_ = mass_[body];
  last_radius_ = radius_[body];
}

template <typename Columns>
void PathCodec::code_time(Side<Columns>& side, PathPiece& piece, Entity other) const {
  const PathPiece& before = present_[piece.body];
  DoubleDouble since = before.start;
  if (other != no_entity && since.value() < present_[other].start.value()) since = present_[other].start;

  double dt = 0;
  uint8_t way = side.shape & time_mask;
  if constexpr (Columns::writes) {
    if (!same_bits(piece.start, start_)) {
      dt = seconds(since, piece.start);
      way = same_bits(piece.start, end_of(before))     ? end_of_piece
            : same_bits(piece.start, after(since, dt)) ? since_piece
                                                       : plain;
    }
    side.shape |= way;
  }

  if (way == of_entry_before) {
    piece.start = start_;
  } else if (way == end_of_piece) {
    piece.start = end_of(before);
  } else if (way == since_piece) {
    const double expected = other == no_entity ? seconds(since, start_) : contact_time(before, present_[other], since);
    side.value(Column::time, expected, dt);
    piece.start = after(since, dt);
  } else {
    side.value(Column::time, start_, piece.start);
  }
}

template <typename Columns>
void PathCodec::code_place(Side<Columns>& side, PathPiece& piece) const {
  const PathPiece& before = present_[piece.body];
  if (piece.law == PathLaw::frame) {
    // The engine `book` moves a body by its new velocity.
    side.value(other_velocity, Column::velocity, before.v, piece.v);
    const Vec3 x = before.x + seconds(before.start, piece.start) * piece.v;
    side.value(other_place, Column::place, x, piece.x);
  } else {
    side.value(other_place, Column::place, place_at(before, piece.start), piece.x);
  }

  const Vec3 a = before.curve ? before.curve->acceleration(seconds(before.start, piece.start)) : before.a;
  side.value(other_acceleration, Column::acceleration, a, piece.a);
}

/// Length and advance of a method's step. Euler's method is ahead by half of a step.
template <typename Columns>
void PathCodec::code_step(Side<Columns>& side, const PathPiece& piece, PolynomialPath& curve) const {
  const PolynomialPath* const before = present_[piece.body].curve.get();
  side.value(Column::curve, before ? before->length : 0, curve.length);
  const bool is_ahead = before && !before->ahead.isZero(0);
  side.value(Column::curve, is_ahead ? Vec3((0.5 * curve.length) * piece.a) : Vec3(Vec3::Zero()), curve.ahead);
}

/// `ahead`: of its curve.
template <typename Columns>
void PathCodec::code_velocity(Side<Columns>& side, PathPiece& piece, PredictedImpact& impact, const Vec3& ahead) {
  if (impact.other != no_entity) {
    predict_impact(piece, impact);
    side.value(Column::other, restitution_, impact.restitution);
    restitution_ = impact.restitution;
  }

  if (piece.kicked) {
    code_kick(side, piece);
  } else if (piece.law != PathLaw::frame) {
    Vec3 v = impact.other != no_entity ? impact.after() : piece.body == struck_ ? struck_v_ : next_velocity(piece);
    if (!ahead.isZero(0)) v += ahead;
    side.value(other_velocity, Column::velocity, v, piece.v);
  }
  struck_ = impact.other;
  if (struck_ != no_entity) struck_v_ = impact.other_after();
}

/// The velocity without an impact.
Vec3 PathCodec::next_velocity(const PathPiece& piece) const {
  const PathPiece& before = present_[piece.body];
  const Vec3 v = velocity_at(before, piece.start);
  if (before.law != PathLaw::verlet) return v;
  return v + (0.5 * seconds(before.start, piece.start)) * (piece.a - before.a);
}

/// The step of a crowd. Its kick follows from the drift and from the velocity before, which is the drift before unless
/// there was an impact.
template <typename Columns>
void PathCodec::code_kick(Side<Columns>& side, PathPiece& piece) const {
  const PathPiece& before = present_[piece.body];
  const double age = before.kicked ? half_step(before) : 0;
  const bool same_step = same_bits(piece.start, start_) && seconds(start_, until_) > 0;
  const DoubleDouble until = same_step ? until_ : after(piece.start, age);
  const Vec3 usual = before.kicked ? before.v : velocity_at(before, piece.start);

  Vec3 base = usual;
  bool odd = false;
  if constexpr (Columns::writes) {
    const double time = half_step(piece) + age;
    odd = !same_bits(until, piece.until);
    for (int k = 0; k < 3; ++k) odd = !find_base(usual[k], piece.v[k], time, piece.kick[k], base[k]) || odd;
  }
  odd = side.flag(odd_kick, odd);
  if (odd)
    side.value(Column::time, until, piece.until);
  else
    piece.until = until;

  const double time = half_step(piece) + age;
  side.value(other_base, Column::kick, usual, base);
  const Vec3 v = base + time * (before.kicked ? before.kick : before.a);
  side.value(other_velocity, Column::velocity, v, piece.v);
  if (Columns::writes && !odd) return;
  const Vec3 kick = (piece.v - base) / time;
  if (odd)
    side.value(Column::kick, kick, piece.kick);
  else
    piece.kick = kick;
}

/// What few pieces have.
template <typename Columns>
void PathCodec::code_rest(Side<Columns>& side, PathPiece& piece, int64_t traits) {
  const PathPiece& before = present_[piece.body];
  if (traits & is_fading) side.value(Column::other, before.fade, piece.fade);
  if (piece.law == PathLaw::frame) side.value(Column::other, before.rounding, piece.rounding);
  if (traits & is_part) side.entity(Column::other, 0, piece.part_of, present_.size());
  if (!piece.joint) return;
  side.value(Column::other, mass_[piece.body], piece.mass);
  side.value(Column::other, radius_[piece.body], piece.radius);
  side.value(Column::other, before.half, piece.half);
  mass_[piece.body] = piece.mass;
  radius_[piece.body] = piece.radius;
}

/// The first two terms follow from velocity and acceleration. The others are near those of the step before.
template <typename Columns>
void PathCodec::code_curve(Side<Columns>& side, PathPiece& piece, PolynomialPath& curve) const {
  const PolynomialPath* const before = present_[piece.body].curve.get();
  const double length = curve.length;
  const double ratio = before ? length / before->length : 0;
  double power = ratio * ratio;

  for (size_t k = 0; k < PolynomialPath::terms; ++k) {
    Vec3 term = Vec3::Zero();
    if (k == 0) term = length * piece.v;
    if (k == 1)
      term = curve.is_parabola ? Vec3((0.5 * length * length) * piece.a) : Vec3(0.5 * length * (length * piece.a));
    if (k > 1 && before) term = (power *= ratio) * before->displacement[k];
    side.value(Column::curve, term, curve.displacement[k]);
  }
  if constexpr (!Columns::writes) piece.curve = make_shared<PolynomialPath>(curve);
}

/// When two balls meet that move as these pieces do (s, from `since` on).
double PathCodec::contact_time(const PathPiece& a, const PathPiece& b, const DoubleDouble& since) const {
  const Vec3 d = place_at(b, since) - place_at(a, since);
  const Vec3 w = velocity_at(b, since) - velocity_at(a, since);
  const double sizes = radius_[a.body] + radius_[b.body];
  const double closing = product(d, w);
  const double square = product(w, w);
  const double gap = product(d, d) - sizes * sizes;
  return gap / (sqrt(closing * closing - square * gap) - closing);
}

/// The impact of a body that is at its place, all but the restitution.
void PathCodec::predict_impact(const PathPiece& piece, PredictedImpact& impact) const {
  const PathPiece& before = present_[piece.body];
  const PathPiece& other = present_[impact.other];
  impact.v = velocity_at(before, piece.start);
  impact.other_v = velocity_at(other, piece.start);
  const Vec3 d = place_at(other, piece.start) - piece.x;
  impact.normal = d / sqrt(product(d, d));
  impact.approach = -product(impact.other_v - impact.v, impact.normal);
  impact.mass = mass_[piece.body];
  impact.other_mass = mass_[impact.other];
}

/// The impact with which a piece and the next one begin, if there is one.
PredictedImpact PathCodec::impact_between(const PathPiece& piece, const PathPiece* next, const World& world) const {
  PredictedImpact impact;
  if (next == nullptr || piece.kicked || next->kicked || piece.law == PathLaw::frame ||
      !same_bits(piece.start, next->start))
    return impact;
  if (present_[piece.body].body == no_entity || present_[next->body].body == no_entity) return impact;
  impact.other = next->body;
  predict_impact(piece, impact);

  // With another rule of the simulator it is none.
  for (const double e : {pair_restitution(world, piece.body, next->body), 0.0}) {
    impact.restitution = e;
    const double off = (impact.after() - piece.v).norm() + (impact.other_after() - next->v).norm();
    if (off <= 0x1p-30 * impact.approach) return impact;
  }
  impact.other = no_entity;
  return impact;
}

template void PathCodec::code(Side<ColumnWriter>&, PathPiece&, PredictedImpact&);
template void PathCodec::code(Side<ColumnReader>&, PathPiece&, PredictedImpact&);

}  // namespace carom
