#pragma once
// A checked map as the decoder sees it: what it says itself, else its defaults, else the table's.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "numerics/vec3.h"
#include "scene/colors.h"
#include "scene/fields.h"
#include "yaml/document.h"

namespace carom {

/// Where a value comes from.
class View {
 public:
  /// `own` null: an empty map. `defaults` null: none. `where`: the map's key, for errors about it.
  View(const Node* own, const Kind& kind, Place where, const Node* defaults = nullptr)
      : own_(own != nullptr && own->is(Node::Kind::map) ? own : nullptr),
        kind_(&kind),
        where_(where),
        defaults_(defaults) {}

  /// The value that holds; null: none. A key that excludes this one (Field::one_of) hides what lies below it.
  const Node* find(std::string_view key) const;
  /// The same without the table's own default.
  const Node* given(std::string_view key) const;

  // Nothing if there is no value, or one that was reported bad.
  std::optional<double> number(std::string_view key) const;
  std::optional<std::uint64_t> whole(std::string_view key) const;
  std::optional<bool> flag(std::string_view key) const;
  std::optional<std::string> text(std::string_view key) const;
  std::optional<Vec3> vector(std::string_view key) const;
  std::optional<Color> color(std::string_view key) const;

  /// A nested map, its defaults ignored.
  View part(std::string_view key, std::string_view kind) const;

  const Node* own() const { return own_; }
  const Kind& kind() const { return *kind_; }
  Place where() const { return where_; }
  /// Of the value if the file or a --set gives one, else of the map.
  Place place(std::string_view key) const;

 private:
  const Node* own_;
  const Kind* kind_;
  Place where_;
  const Node* defaults_;
};

/// The node that a Field::initial stands for.
const Node& initial_node(const Field& field);

std::optional<double> as_number(const Node* node);
std::optional<std::uint64_t> as_whole(const Node* node);
std::optional<Vec3> as_vector(const Node* node);
std::optional<Color> as_color(const Node* node);

/// The place of a value; of a part of it that a --set gave, if there is one.
Place place_of(const Node& node);

}  // namespace carom
