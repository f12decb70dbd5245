#pragma once
// A scene to the equivalent YAML text that needs no defaults.

#include "scene/decode.h"
#include "std.h"

namespace carom {

/// `text` as a YAML scalar that is always read as text.
string in_quotes(string_view text);

/// A value as YAML in one line, numbers as authored.
string flow_text(const Node& node);

/// A key as YAML: in quotes if readers of YAML 1.1 would take it for a flag, such as `on`.
string key_text(string_view key);

/// A number as YAML, in the form that these readers take for a number: 1.0e-9, not 1e-9.
string number_text(string_view number);

/// The scene with every default written out and numbers as authored.
/// Loading it gives the same Scene, and resolving that gives the same text.
/// Keys stand in the order of the table, and things in the order of the file. Groups stay groups.
string resolved_text(const Node& root, const Inventory& inventory, const Scene& scene, const string& folder);

}  // namespace carom
