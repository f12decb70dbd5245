// Keeps each body's pieces in a list of its own. Pieces that are too old are removed when they are half of the list, so
// that the cost of a piece does not depend on the length of a run.
#include "overlay/tracks.h"

#include <numeric>

#include "std.h"

namespace carom {

Tracks::Tracks(Entity bodies, const vector<Entity>& on, double seconds)
    : seconds_(seconds), bodies_(on), wanted_(bodies, on.empty()), pieces_(bodies) {
  if (on.empty()) {
    bodies_.resize(bodies);
    std::iota(bodies_.begin(), bodies_.end(), Entity{0});
  }
  for (const Entity body : on) wanted_[body] = true;
}

void Tracks::add(span<const PathPiece> pieces) {
  for (const PathPiece& piece : pieces) {
    if (!has(piece.body)) continue;
    if (piece.part_of == no_entity && !piece.removed)
      add(piece.body,
          {.from = piece.from, .start = piece.start, .x = piece.x, .v = piece.v, .a = piece.a, .curve = piece.curve});
    else
      end(piece.body, piece.from);
  }
}

void Tracks::add(Entity body, const TrackPiece& piece) {
  end(body, piece.from);
  forget(body, piece.from - seconds_);
  pieces_[body].push_back(piece);
}

void Tracks::end(Entity body, double time) {
  vector<TrackPiece>& pieces = pieces_[body];
  if (!pieces.empty()) pieces.back().until = min(pieces.back().until, time);
}

void Tracks::forget(Entity body, double before) {
  vector<TrackPiece>& pieces = pieces_[body];
  const auto kept = ranges::find_if(pieces, [&](const TrackPiece& piece) { return piece.until > before; });
  if (2 * (kept - pieces.begin()) > pieces.end() - pieces.begin()) pieces.erase(pieces.begin(), kept);
}

}  // namespace carom
