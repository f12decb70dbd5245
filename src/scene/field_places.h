#pragma once
// Where in a file a field can stand, and the fields that a path or a key may mean.
#include <string>
#include <string_view>
#include <vector>

#include "scene/fields.h"

namespace carom {

/// One row of the table and every path at which a file can have it: "balls.NAME.mass", "forces.N.from". Rows of several
/// kinds that say the same are one.
struct FieldPlaces {
  const Field* field = nullptr;
  std::vector<const Kind*> kinds;
  std::vector<std::string> paths;
};

/// Those that `key` means: a whole path as `--set` has it, in which names and numbers of entries may be left out
/// (balls.red.mass, balls.mass); the end of one (rest_speed, restitution.combine); or a kind's key (ball.mass).
/// Empty: none.
std::vector<FieldPlaces> find_places(std::string_view key);

/// Every path of a scene, each once, names and numbers of entries left out: "simulate.duration", "balls.mass".
std::vector<std::string> plain_paths();
/// Those of them in which nothing had to be left out: `--set` takes them as they are.
std::vector<std::string> settable_paths();

/// Where a file can have a map of this kind: "balls.NAME", "defaults.ball".
std::vector<std::string> paths_of(const Kind& kind);

/// The kind whose name this is, else null.
const Kind* find_kind(std::string_view name);

/// What may have been meant by a key that means nothing: "did you mean `x`?", or empty.
std::string suggest_place(std::string_view key);

}  // namespace carom
