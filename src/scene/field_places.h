#pragma once
// The places in a file where a field can stand, and the fields that a path or key may mean.

#include "scene/fields.h"
#include "std.h"

namespace carom {

/// One row of the table and every path at which a file can have it: "balls.NAME.mass", "forces.N.from".
/// Equal rows of several kinds count as one.
struct FieldPlaces {
  const Field* field = nullptr;
  vector<const Kind*> kinds;
  vector<string> paths;
};

/// The places that `key` may mean. Empty: none. `key` is one of three:
/// - a whole path as in `--set`, with or without names and numbers of entries (balls.red.mass, balls.mass);
/// - the end of a path (rest_speed, restitution.combine);
/// - a key of a kind (ball.mass).
vector<FieldPlaces> find_places(string_view key);

/// Every path of a scene, each once, without names and numbers of entries: "simulate.duration", "balls.mass".
vector<string> plain_paths();
/// The plain paths that contain no names or numbers, so that `--set` accepts them unchanged.
vector<string> settable_paths();

/// The places in a file of maps of this kind: "balls.NAME", "defaults.ball".
vector<string> paths_of(const Kind& kind);

/// A suggestion for an unknown key: "did you mean `x`?", or empty.
string suggest_place(string_view key);

}  // namespace carom
