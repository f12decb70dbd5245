#pragma once
// Joins a row of the table of fields with the struct member that its key fills.
// The member's default is the key's default. The member's type determines how the value is read and written.
#include <nlohmann/json.hpp>
#include <type_traits>

#include "numerics/vec3.h"
#include "scene/colors.h"
#include "scene/field.h"
#include "scene/keys.h"
#include "scene/output.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {

/// Fills a struct from a map. Members without a value keep theirs. `settings`: the struct of the view's kind.
void fill(void* settings, const View& view);
/// The struct's members as JSON, in the order of the kind's keys.
nlohmann::ordered_json json_of(const Kind& kind, const void* settings);

// Reading. Each returns false if the map has no value or a bad one.
// Then the member keeps its value, but an optional one becomes empty.
bool take(const View& view, const Field& field, double& value);
bool take(const View& view, const Field& field, uint64_t& value);
// Accepts a whole number, or a choice of whole numbers.
bool take(const View& view, const Field& field, int& value);
// Accepts a flag, or two choices of which the second is true.
bool take(const View& view, const Field& field, bool& value);
bool take(const View& view, const Field& field, string& value);
bool take(const View& view, const Field& field, Vec3& value);
bool take(const View& view, const Field& field, Size& value);
bool take(const View& view, const Field& field, Rectangle& value);
bool take(const View& view, const Field& field, Color& value);
bool take(const View& view, const Field& field, BodyColor& value);
/// Names.
bool take(const View& view, const Field& field, vector<string>& value);
/// The value with its place, bad or not: names, a file.
bool take(const View& view, const Field& field, const Node*& value);
/// The index of a choice.
optional<size_t> choice_of(const View& view, const Field& field);

// Writing, as JSON and as YAML.
nlohmann::ordered_json json_value(const Field& field, bool value);
nlohmann::ordered_json json_value(const Field& field, const Vec3& value);
nlohmann::ordered_json json_value(const Field& field, const Size& value);
nlohmann::ordered_json json_value(const Field& field, const Rectangle& value);
nlohmann::ordered_json json_value(const Field& field, const Color& value);
nlohmann::ordered_json json_value(const Field& field, const BodyColor& value);
nlohmann::ordered_json json_value(const Field& field, const Node* value);
/// Null: there are none.
nlohmann::ordered_json json_value(const Field& field, const vector<string>& value);
string yaml_of(double value);
string yaml_of(const Vec3& value);
string yaml_of(const Color& value);

template <typename T>
inline constexpr bool is_optional = false;
template <typename T>
inline constexpr bool is_optional<optional<T>> = true;

/// Whether T is a struct that a nested map fills.
template <typename T>
inline constexpr bool is_settings = std::is_class_v<T> && !requires(const View& view, const Field& field, T& value) {
  take(view, field, value);
};

template <typename T>
bool take_any(const View& view, const Field& field, T& value) {
  if constexpr (is_optional<T>) {
    typename T::value_type inner{};
    const bool good = take_any(view, field, inner);
    value = good ? optional(inner) : nullopt;
    return good;

  } else if constexpr (is_settings<T>) {
    if (!view.wants(field.key)) return false;
    fill(&value, view.part(field));
    return true;

  } else if constexpr (std::is_enum_v<T>) {
    const optional<size_t> choice = choice_of(view, field);
    if (choice) value = static_cast<T>(*choice);
    return choice.has_value();
  } else {
    return take(view, field, value);
  }
}

template <typename T>
nlohmann::ordered_json json_any(const Field& field, const T& value) {
  if constexpr (is_optional<T>) {
    return value ? json_any(field, *value) : nlohmann::ordered_json();
  } else if constexpr (is_settings<T>) {
    return json_of(*field.held, &value);
  } else if constexpr (std::is_enum_v<T>) {
    return string(choices(field)[size_t(value)]);

  } else if constexpr (std::is_same_v<T, bool> || std::is_class_v<T> || std::is_pointer_v<T>) {
    if constexpr (std::is_same_v<T, string>)
      return value;
    else
      return json_value(field, value);
  } else {
    return value;
  }
}

template <typename T>
string yaml_any(const Field& field, const T& value) {
  if constexpr (is_optional<T>) {
    return value ? yaml_any(field, *value) : "";
  } else if constexpr (std::is_pointer_v<T>) {
    return "";

  } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3> || std::is_same_v<T, Color>) {
    return yaml_of(value);
  } else if constexpr (std::is_same_v<T, string>) {
    return value;

  } else {
    const nlohmann::ordered_json json = json_any(field, value);
    if (json.is_string()) return word_in_yaml(json.get<string>());
    string text = text_of_json(json);
    if (json.is_array()) text.replace(text.find(','), 1, ", ");
    return text;
  }
}

/// The member of an Owner that a key fills.
template <typename Owner, auto pointer>
inline constexpr Member fills = {
    [](void* settings, const View& view, const Field& field) {
      take_any(view, field, static_cast<Owner*>(settings)->*pointer);
    },
    [](const Field& field) { return field.needed ? string() : yaml_any(field, Owner{}.*pointer); },
    [](const void* settings, const Field& field) {
      return json_any(field, static_cast<const Owner*>(settings)->*pointer);
    }};

/// The same without a fixed default: it depends on other keys, or absence has a meaning of its own.
template <typename Owner, auto pointer>
inline constexpr Member fills_if_given = {fills<Owner, pointer>.fill, nullptr, fills<Owner, pointer>.json};

/// The type of the values that fill a T.
template <typename T>
constexpr Type type_of() {
  if constexpr (is_optional<T>) return type_of<typename T::value_type>();
  if constexpr (std::is_same_v<T, uint64_t> || std::is_same_v<T, int>) return Type::whole;
  if constexpr (std::is_same_v<T, bool>) return Type::flag;
  if constexpr (std::is_same_v<T, string>) return Type::text;
  if constexpr (std::is_same_v<T, Vec3>) return Type::vector;
  if constexpr (std::is_same_v<T, Rectangle>) return Type::extent;
  if constexpr (std::is_same_v<T, Size>) return Type::pixels;
  if constexpr (std::is_same_v<T, Color>) return Type::color;
  if constexpr (std::is_same_v<T, BodyColor>) return Type::color_or_part;
  if constexpr (std::is_enum_v<T>) return Type::choice;
  if constexpr (is_settings<T>) return Type::part;
  return Type::number;
}

/// A row whose key fills the member of an Owner. The member's type is that of the key, unless `rest` has another.
template <typename Owner, auto pointer>
constexpr Field row(string_view key, string_view doc, string_view example, Field rest = {}) {
  rest.member = fills<Owner, pointer>;
  if (rest.type == Type::number) rest.type = type_of<std::remove_cvref_t<decltype(Owner{}.*pointer)>>();
  return row(key, doc, example, rest);
}

/// The same without a fixed default.
template <typename Owner, auto pointer>
constexpr Field row_if_given(string_view key, string_view doc, string_view example, Field rest = {}) {
  Field field = row<Owner, pointer>(key, doc, example, rest);
  field.member.initial = nullptr;
  return field;
}

/// A new struct, filled from a map.
template <typename Settings>
Settings filled(const View& view) {
  Settings settings;
  fill(&settings, view);
  return settings;
}

/// A row shared by several kinds, with the member of one of them.
constexpr Field with(Field field, Member member) {
  field.member = member;
  return field;
}

}  // namespace carom
