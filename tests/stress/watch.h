#pragma once
// A run and its recorded states.

#include "std.h"
#include "stress/scene.h"

namespace carom::stress {

/// The start of a piece of a body's path, and whether the body drifts straight along it, in a crowd.
struct Piece {
  double from;  // s
  bool drifts;
};

struct Watched {
  vector<vector<Piece>> pieces;  // by body, with states at requested times only
  vector<Collision> records;
  vector<State> seen;  // at the requested times
  State start, end;
  Tally tally;
  string error;           // of the end of the run
  bool too_slow = false;  // it exceeded the time limit
};

/// Runs a scene, with states at these times (s, ascending), to the end; for at most this long (s of CPU time).
Watched watch(const RandomScene& scene, const vector<double>& times, double patience);

/// Times (s) for states of a scene with known collisions: some, and just before and after collisions and changes of the
/// forces.
vector<double> sample_times(const RandomScene& scene, const vector<Collision>& records);

/// The scene with lengths, times and masses multiplied by 2^these.
RandomScene scaled(RandomScene scene, int length, int time, int mass);

/// The first difference of two runs of the same scene in a bit; empty: none. Those of b are in units of 2^these.
string difference(const Watched& a, const Watched& b, int length, int time, int mass);

/// The scene with its axes turned, x to y to z to x; with x and z exchanged where upright cylinders forbid that.
RandomScene turned(RandomScene scene);

}  // namespace carom::stress
