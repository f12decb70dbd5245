#pragma once
// A text as the loader of scenes reads it: checked, then parsed.
#include <gtest/gtest.h>

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"
#include "yaml/source.h"

namespace carom {

/// A file `a.yaml` with this text, its tree, and the errors.
struct Parsed {
  explicit Parsed(string text) : sources{{"a.yaml", std::move(text)}} {
    if (check_text(sources[0], 0, diagnostics)) root = parse_document(sources, 0, 0, diagnostics);
  }
  Parsed(const Parsed&) = delete;

  /// All errors as a terminal without colour shows them.
  string errors() const { return diagnostics.text(false); }

  /// The only error: "line:column message = remedy".
  string error() const {
    const vector<ErrorRecord> all = diagnostics.records();
    if (all.size() != 1) return to_string(all.size()) + " errors: " + errors();
    return to_string(all[0].line) + ":" + to_string(all[0].column) + " " + all[0].message + " = " + all[0].remedy;
  }

  /// The text of a value's place.
  string marked(const Node& node) const { return sources[0].text.substr(node.place.offset, node.place.length); }

  vector<Source> sources;
  Diagnostics diagnostics{sources};
  optional<Node> root;
};

}  // namespace carom
