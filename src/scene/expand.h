#pragma once
// The tree of a scene file without its shorthands: expressions become numbers, repeated things their members.
#include <map>
#include <string>

#include "scene/budget.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// The texts of expressions, by their paths in the file as --set takes them: "balls.red.position.x".
/// Those of repeated entries of a list, which have no name, are absent.
using ExpressionTexts = std::map<std::string, std::string>;

/// Writes short forms out in full: `restitution: 0.3` is `restitution: {default: 0.3}`. It costs nothing to repeat.
void write_out(Node& root);

/// Replaces each expression by its number, and each repeated thing `name` by its members `name.0`, `name.1`, ...
/// Adds errors, and marks values bad whose expression has no number. A thing with `repeat: 0` stays as it is.
/// More values than a file may have, or more members than `budget` has bodies, are refused before they are made.
ExpressionTexts expand(Node& root, const Budget& budget, Diagnostics& diagnostics);

/// The name of the repeated thing that a member belongs to: `bricks` of `bricks.3`. Empty: it is no member.
std::string_view family_of(std::string_view name);

}  // namespace carom
