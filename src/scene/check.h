#pragma once
// Checks a tree of nodes against the table of fields.
// It reports unknown, missing and misplaced keys, wrong types, and numbers out of range.

#include "scene/field.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Checks the whole tree of a scene and adds every error.
/// Values that failed are marked bad. Map entries with a wrong key stay, and lookups of correct keys ignore them.
/// `folder`: the folder of the scene file, for its meshes.
void check_scene(Node& root, const string& folder, Diagnostics& diagnostics);

/// The same for the tree of a sweep file. The paths in it are checked against its scene later.
void check_sweep(Node& root, Diagnostics& diagnostics);

/// The defaults of maps of `kind`: scene -> defaults -> kind. Null: none.
const Node* defaults_for(const Node& root, const Kind& kind);

/// A path given in a scene file, relative to the working folder. An absolute `path` is returned unchanged.
string beneath(const string& folder, const string& path);

/// "did you mean `x`?", or the possible keys of `kind`.
string suggest_key(string_view wrong, const Kind& kind);

}  // namespace carom
