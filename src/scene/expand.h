#pragma once
// The tree of a scene file without its shorthands: expressions become numbers, repeated things their members.

#include "scene/budget.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

struct Kind;

/// The texts of expressions, by paths as --set takes them: "balls.red.position.x". A repeated thing has one for all its
/// members, and "bricks.repeat" for their number. A thing has those of its defaults that it uses.
/// Expressions of repeated entries of a list, which have no name, are absent. Of very many none is kept.
using ExpressionTexts = map<string, string>;

/// The text of the expression that made the value at a path of a resolved scene. Null: none did, or it is not known.
const string* expression_at(const ExpressionTexts& texts, string_view path);
/// The same for the number of members of the repeated thing that the path belongs to.
const string* repeat_of(const ExpressionTexts& texts, string_view path);

/// Writes short forms out in full: `restitution: 0.3` is `restitution: {default: 0.3}`. It costs nothing to repeat.
void write_out(Node& part, const Kind& kind);

/// Replaces each expression by its number, and each repeated thing `name` by its members `name.0`, `name.1`, ...
/// A group without a ball gets an empty one where `defaults` have a ball.
/// Adds errors, and marks values bad whose expression has no number. A thing with `repeat: 0` stays as it is.
/// More values than a file may have, or more members than `budget` has bodies, are refused before they are made.
/// `seed`: in place of the file's, for rand(i).
ExpressionTexts expand(Node& root, optional<uint64_t> seed, const Budget& budget, Diagnostics& diagnostics);

}  // namespace carom
