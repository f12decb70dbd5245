#pragma once
// A tree of nodes against the table of fields: unknown, missing and misplaced keys, wrong types, numbers out of range.
#include <string>

#include "scene/fields.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// Checks the whole tree of a scene and adds every error. Values that failed are marked bad; map entries whose key is
/// wrong stay and are ignored where known keys are looked up. `folder` is that of the scene file, for its meshes.
void check_scene(Node& root, const std::string& folder, Diagnostics& diagnostics);

/// The same for the tree of a sweep file; what its paths mean is the scene's matter.
void check_sweep(Node& root, Diagnostics& diagnostics);

/// The defaults that a map of `kind` falls back on: scene -> defaults -> kind; null: none.
const Node* defaults_for(const Node& root, const Kind& kind);

/// A path that a scene names, from the working folder: `path` itself if it is absolute.
std::string beneath(const std::string& folder, const std::string& path);

/// "did you mean `x`?", or what a key of `kind` can be.
std::string suggest_key(std::string_view wrong, const Kind& kind);

}  // namespace carom
