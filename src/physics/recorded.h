#pragma once
// A part of the record of a motion: a piece of a path, or a collision.
#include <cmath>
#include <cstddef>
#include <span>

#include "physics/collision.h"
#include "physics/path_piece.h"

namespace carom {

/// What a record has of a collision.
struct CollisionMark {
  double time = 0;  // s
  CollisionKind kind = CollisionKind::body_body;
  Entity a = no_entity;  // as in Collision
  Entity b = no_entity;
};

struct Recorded {
  enum class Kind : std::uint8_t { piece, collision };
  Kind kind = Kind::piece;
  // Of its kind.
  PathPiece piece{};
  CollisionMark collision{};

  /// The first double (s) at which it holds.
  double from() const { return kind == Kind::piece ? piece.from : collision.time; }
};

/// Calls `mark` and `piece` for the collisions and pieces of one advance, each in order. A collision comes before the
/// pieces that begin with it, and at the first double at which they hold.
template <typename Mark, typename Piece>
void in_order(std::span<const Collision> collisions, std::span<const PathPiece> pieces, const Mark& mark,
              const Piece& piece) {
  std::size_t next = 0;
  const auto marks_until = [&](double time) {
    for (; next < collisions.size() && collisions[next].time <= time; ++next) {
      const Collision& of = collisions[next];
      const bool rounds_up = std::nextafter(of.time, time) == time;
      mark(CollisionMark{rounds_up ? time : of.time, of.kind, of.a, of.b});
    }
  };

  for (const PathPiece& each : pieces) {
    marks_until(each.from);
    piece(each);
  }
  for (; next < collisions.size(); ++next)
    mark(CollisionMark{collisions[next].time, collisions[next].kind, collisions[next].a, collisions[next].b});
}

}  // namespace carom
