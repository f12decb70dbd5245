#pragma once
// The value at a path of a scene's tree, such as restitution.default or balls.red.position.x.

#include "std.h"
#include "yaml/document.h"

namespace carom {

struct ValueAtPath {
  /// A number with its shortest digits, any other value as written.
  string text;
  /// What is wrong with the path, and what to do. Empty: it has a value.
  string problem, remedy;
};

/// The value in effect: the file's own, else that of `defaults`, else the format's.
/// A map that the scene lacks has no values, except one whose keys can all be left out (`restitution`).
ValueAtPath value_at(const Node& root, string_view path);

}  // namespace carom
