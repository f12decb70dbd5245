#pragma once
// YAML text -> a tree of nodes that know their places. The only file that talks to yaml-cpp is document.cpp.
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

/// A value of the file. Maps keep the order of the file.
struct Node {
  enum class Kind : std::uint8_t { null, scalar, sequence, map };
  Kind kind = Kind::null;
  bool quoted = false;  // a scalar in quotes or a block of text: text even if it looks like a number
  bool bad = false;     // an error about this value was reported: the value is not to be used
  Place place;       // of the value; of its key where the value has no place of its own (null, a block below its key)
  std::string text;  // of a scalar
  std::vector<Key> keys;    // of a map
  std::vector<Node> items;  // of a sequence; of a map, as many as keys

  bool is(Kind k) const { return kind == k; }
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  const Key* find_key(std::string_view key) const;
};

/// Parses sources[index] from `offset` on as exactly one document. Refuses anchors, aliases, tags, duplicate and
/// complex keys, `<<`, and trees deeper or larger than any scene. Adds errors; nothing if there is no tree to go on
/// with.
std::optional<Node> parse_document(const std::vector<Source>& sources, std::uint32_t index, std::size_t offset,
                                   Diagnostics& diagnostics);

}  // namespace carom
