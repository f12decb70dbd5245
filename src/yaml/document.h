#pragma once
// YAML text to a tree of nodes with their places. Only document.cpp includes yaml-cpp.

#include "std.h"
#include "yaml/place.h"

namespace carom {

class Diagnostics;

struct Key {
  string text;
  Place place;
};

/// A value of the file. A map keeps the order of the file.
struct Node {
  enum class Kind : uint8_t { null, scalar, sequence, map };
  Kind kind = Kind::null;
  /// A scalar in quotes or a block of text. It is text even if it looks like a number.
  bool quoted = false;
  /// An error about this value was reported, so the value must not be used.
  bool bad = false;
  /// The word `none` in place of a value that defaults would give.
  bool cancels = false;
  /// The place of the value. A value without a place of its own (null, a block below its key) has that of its key.
  Place place;
  string text;       // of a scalar
  vector<Key> keys;  // of a map
  /// Of a sequence, or of a map: as many as keys.
  vector<Node> items;

  bool is_null() const { return kind == Kind::null; }
  bool is_scalar() const { return kind == Kind::scalar; }
  bool is_sequence() const { return kind == Kind::sequence; }
  bool is_map() const { return kind == Kind::map; }
  const Node* find(string_view key) const;
  Node* find(string_view key);
  const Key* find_key(string_view key) const;
};

/// Gives the key of a map this value, in its place or at the end of the map.
void set_key(Node& map, string_view key, Node value);
/// Does nothing if there is no such key.
void remove_key(Node& map, string_view key);

/// Parses sources[index] from `offset` on as exactly one document.
/// Refuses anchors, aliases, tags, duplicate and complex keys, `<<`, and trees deeper or larger than any scene.
/// Adds errors to `diagnostics`. Returns nothing if no tree is left to continue with.
optional<Node> parse_document(const vector<Source>& sources, uint32_t index, size_t offset, Diagnostics& diagnostics);

}  // namespace carom
