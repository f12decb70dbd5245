#pragma once
// A part of the record of a motion: a piece of a path, a collision, or an event that sets times.

#include "physics/collision.h"
#include "physics/path_piece.h"
#include "std.h"

namespace carom {

/// What a record has of a collision.
struct CollisionMark {
  double time = 0;  // s
  CollisionKind kind = CollisionKind::body_body;
  Entity a = no_entity;  // as in Collision
  Entity b = no_entity;
  double impulse = 0;  // N s; 0: not recorded
};

/// The event of a trigger of the World. What it changes lies ahead, so that it may be known at any time before.
struct EventMark {
  uint32_t trigger = 0;
  double fired = 0;  // s, as in Tally
};

struct Recorded {
  enum class Kind : uint8_t { piece, collision, event };
  Kind kind = Kind::piece;
  // Of its kind.
  PathPiece piece{};
  CollisionMark collision{};
  EventMark event{};

  /// The first double (s) at which it holds, or may be known.
  double from() const {
    return kind == Kind::piece ? piece.from : kind == Kind::collision ? collision.time : -infinity;
  }
};

inline CollisionMark mark_of(const Collision& collision) {
  return {collision.time, collision.kind, collision.a, collision.b, collision.impulse};
}

/// The mark of a collision, if it comes before a piece that holds from `from` (s) on. Otherwise nothing. A collision
/// that begins the piece may lie between two doubles, the later of which is `from`: then the mark has that one.
inline optional<CollisionMark> mark_until(const Collision& collision, double from) {
  if (collision.time > from) return {};
  CollisionMark mark = mark_of(collision);
  if (std::nextafter(mark.time, from) == from) mark.time = from;
  return mark;
}

/// Calls `mark` and `piece` for the collisions and pieces of one advance, each in order, collisions first.
template <typename Mark, typename Piece>
void in_order(span<const Collision> collisions, span<const PathPiece> pieces, const Mark& mark, const Piece& piece) {
  size_t next = 0;
  for (const PathPiece& each : pieces) {
    for (; next < collisions.size(); ++next) {
      const optional<CollisionMark> before = mark_until(collisions[next], each.from);
      if (!before) break;
      mark(*before);
    }
    piece(each);
  }
  for (; next < collisions.size(); ++next) mark(mark_of(collisions[next]));
}

}  // namespace carom
