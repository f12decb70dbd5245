#pragma once
// Paths as they are recorded. A path is final once all that happens at an instant has happened: it is looked at when
// the first change at a later one is about to come, or when an advance ends.
#include <span>
#include <vector>

#include "physics/path_piece.h"
#include "simulate/exact_bodies.h"

namespace carom {

class PathLog {
 public:
  /// Records nothing unless options.record_paths.
  explicit PathLog(const ExactBodies& bodies) : bodies_(bodies) {}

  /// Empties the buffer for the next advance.
  void begin_advance();
  /// Call before body i gets another path now, or anything that its path is made of changes.
  void note_change(Entity i) {
    if (bodies_.options.record_paths) [[unlikely]]
      note(i);
  }
  /// Records the paths that have changed.
  void record_changes();
  bool full() const { return full_; }
  std::span<const PathPiece> pieces() const { return pieces_; }  // in order

 private:
  void note(Entity i);
  PathPiece piece_of(Entity i, double from) const;

  const ExactBodies& bodies_;
  std::vector<PathPiece> pieces_;
  std::vector<Entity> changed_;  // bodies whose paths are to be recorded as they are when all that happens
  Instant changed_at_;           // at this instant has happened
  bool full_ = false;
};

}  // namespace carom
