#pragma once
// The record of paths. A path is final when everything at an instant has happened.
// It is therefore read before the first change at a later instant, or at the end of an advance.

#include "physics/path_piece.h"
#include "simulate/path/curved_flights.h"
#include "simulate/path/path_extremes.h"
#include "simulate/path/paths.h"
#include "std.h"

namespace carom {

class Crossings;

class PathLog {
 public:
  /// Records nothing unless options.record_paths, and watches nothing unless options.watch. The crossings follow the
  /// paths that have changed.
  PathLog(const BodyPaths& bodies, Crossings& crossings);
  /// Motions in closed form are those of `curved`, which must outlive this object. Call it before the first change.
  void follow(const CurvedFlights& curved) { curved_ = &curved; }

  /// Empties the buffer for the next advance.
  void begin_advance();
  /// Call this before body i gets another path at the present instant, or before any data of its path change.
  void note_change(Entity i) {
    if (wanted_) [[unlikely]]
      note(i);
  }
  /// Records the paths that have changed.
  void record_changes();
  /// Ends the run at `time` (s). What changes at this instant holds from there on.
  void end(double time);
  /// What changes at the present instant is seen from `from` on only.
  void delay(const Instant& from) { delayed_ = from; }
  /// The first double at which all recorded paths hold (s).
  double latest() const { return latest_; }
  bool full() const { return full_; }
  span<const PathPiece> pieces() const { return pieces_; }  // in order
  const PathExtremes& extremes() const { return extremes_; }

  void keep(auto& archive) {
    archive(extremes_, pieces_, changed_, changed_at_, delayed_, end_, latest_, full_, closed_);
  }

 private:
  void note(Entity i);
  bool goes_on(Entity i);
  PathPiece piece_of(Entity i, double from) const;

  const BodyPaths& bodies_;
  const CurvedFlights* curved_ = nullptr;
  PathExtremes extremes_;
  Crossings& crossings_;
  // A change of a path concerns the record, the crossings or the end of the run; or these or the extremes.
  const bool followed_, wanted_;  // to be recorded, followed, or for the run's end
  vector<PathPiece> pieces_;
  // Bodies with changed paths. They are recorded when everything at the instant `changed_at_` has happened.
  vector<Entity> changed_;
  Instant changed_at_, delayed_;
  double end_ = never, latest_ = 0;  // s: the run's end, and the last piece's start
  bool full_ = false;
  LazyArray<uint8_t> closed_;  // by body: whether its last piece is a motion in closed form
};

}  // namespace carom
