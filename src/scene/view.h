#pragma once
// A checked map as the decoder reads it: its own values, else its defaults, else the table's.

#include "numerics/vec3.h"
#include "scene/colors.h"
#include "scene/field.h"
#include "std.h"
#include "yaml/document.h"

namespace carom {

/// Looks up a value in three layers: the map itself, its defaults, the table.
class View {
 public:
  /// `own` null: an empty map. `defaults` null: no defaults. `where`: the place of the map's key, for errors about it.
  View(const Node* own, const Kind& kind, Place where, const Node* defaults = nullptr)
      : own_(own != nullptr && own->is_map() ? own : nullptr), kind_(&kind), where_(where), defaults_(defaults) {}

  /// The value in effect, or null. A key that excludes this one (Field::one_of) hides the layers below it.
  const Node* find(string_view key) const;
  const Node* find(const Field& field) const;  // a row of kind()
  /// The same without the table's default.
  const Node* given(string_view key) const;
  const Node* given(const Field& field) const;

  // Each returns nothing if there is no value or a bad one.
  optional<double> number(string_view key) const;
  optional<uint64_t> whole(string_view key) const;
  optional<bool> flag(string_view key) const;
  optional<string> text(string_view key) const;
  optional<Vec3> vector(string_view key) const;
  optional<Color> color(string_view key) const;

  /// A nested map. Its defaults are ignored, and the map of its kind's `beneath` lies below it.
  View part(string_view key) const;
  View part(const Field& field) const;
  /// Whether the key requests its object: the value is a map or true.
  bool wants(string_view key) const;

  const Node* own() const { return own_; }
  const Kind& kind() const { return *kind_; }
  Place where() const { return where_; }
  /// The place of the value if the file or a --set gives one, else that of the map.
  Place place(string_view key) const;

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

optional<double> as_number(const Node* node);
optional<uint64_t> as_whole(const Node* node);
optional<bool> as_flag(const Node* node);
optional<string> as_text(const Node* node);
optional<Vec3> as_vector(const Node* node);
optional<Color> as_color(const Node* node);

/// The place of a value. If a --set gave a part of it, the place of that part.
Place place_of(const Node& node);

}  // namespace carom
