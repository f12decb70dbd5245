#pragma once
// A scene -> the YAML text that says the same without defaults.
#include <string>
#include <string_view>

#include "scene/decode.h"

namespace carom {

/// Text as a YAML scalar that is text whatever it looks like.
std::string in_quotes(std::string_view text);

/// A value as YAML in one line, numbers as authored.
std::string flow_text(const Node& node);

/// The scene with every default written out, numbers as authored. Loading it gives the same Scene, and the same text
/// again. Keys stand in the order of the table; things in the order of the file. Groups stay groups.
std::string resolved_text(const Node& root, const Inventory& inventory, const Scene& scene);

}  // namespace carom
