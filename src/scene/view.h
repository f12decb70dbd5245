#pragma once
// A checked map as the decoder reads it: its own values, else its defaults, else the table's.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "numerics/vec3.h"
#include "scene/colors.h"
#include "scene/fields.h"
#include "yaml/document.h"

namespace carom {

/// Looks up a value in three layers: the map itself, its defaults, the table.
class View {
 public:
  /// `own` null: an empty map. `defaults` null: no defaults. `where`: the place of the map's key, for errors about it.
  View(const Node* own, const Kind& kind, Place where, const Node* defaults = nullptr)
      : own_(own != nullptr && own->is(Node::Kind::map) ? own : nullptr),
        kind_(&kind),
        where_(where),
        defaults_(defaults) {}

  /// The value in effect, or null. A key that excludes this one (Field::one_of) hides the layers below it.
  const Node* find(std::string_view key) const;
  const Node* find(const Field& field) const;  // a row of kind()
  /// The same without the table's default.
  const Node* given(std::string_view key) const;
  const Node* given(const Field& field) const;

  // Each returns nothing if there is no value or a bad one.
  std::optional<double> number(std::string_view key) const;
  std::optional<std::uint64_t> whole(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<Vec3> vector(std::string_view key) const;
  std::optional<Color> color(std::string_view key) const;

  /// A nested map. Its defaults are ignored, and the map of its kind's `beneath` lies below it.
  View part(std::string_view key, std::string_view kind) const;
  /// Whether the key requests its object: the value is a map or true.
  bool wants(std::string_view key) const;

  const Node* own() const { return own_; }
  const Kind& kind() const { return *kind_; }
  Place where() const { return where_; }
  /// The place of the value if the file or a --set gives one, else that of the map.
  Place place(std::string_view key) const;

 private:
  /// A value of the map or of its defaults, or whether another key replaces it.
  struct Found {
    const Node* node;
    bool is_replaced;
  };
  Found search(const Field& field) const;

  const Node* own_;
  const Kind* kind_;
  Place where_;
  const Node* defaults_;
};

/// The node of a Field::initial.
const Node& initial_node(const Field& field);

std::optional<double> as_number(const Node* node);
std::optional<std::uint64_t> as_whole(const Node* node);
std::optional<bool> as_flag(const Node* node);
std::optional<std::string> as_text(const Node* node);
std::optional<Vec3> as_vector(const Node* node);
std::optional<Color> as_color(const Node* node);

/// The place of a value. If a --set gave a part of it, the place of that part.
Place place_of(const Node& node);

}  // namespace carom
