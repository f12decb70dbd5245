#pragma once
// YAML text to a tree of nodes with their places. Only document.cpp includes yaml-cpp.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "yaml/source.h"

namespace carom {

class Diagnostics;

struct Key {
  std::string text;
  Place place;
};

/// A value of the file. A map keeps the order of the file.
struct Node {
  enum class Kind : std::uint8_t { null, scalar, sequence, map };
  Kind kind = Kind::null;
  /// A scalar in quotes or a block of text. It is text even if it looks like a number.
  bool quoted = false;
  /// An error about this value was reported, so the value must not be used.
  bool bad = false;
  /// The word `none` in place of a value that defaults would give.
  bool cancels = false;
  /// The place of the value. A value without a place of its own (null, a block below its key) has that of its key.
  Place place;
  std::string text;       // of a scalar
  std::vector<Key> keys;  // of a map
  /// Of a sequence, or of a map: as many as keys.
  std::vector<Node> items;

  bool is(Kind k) const { return kind == k; }
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  const Key* find_key(std::string_view key) const;
};

/// Parses sources[index] from `offset` on as exactly one document.
/// Refuses anchors, aliases, tags, duplicate and complex keys, `<<`, and trees deeper or larger than any scene.
/// Adds errors to `diagnostics`. Returns nothing if no tree is left to continue with.
std::optional<Node> parse_document(const std::vector<Source>& sources, std::uint32_t index, std::size_t offset,
                                   Diagnostics& diagnostics);

}  // namespace carom
