// What the code asks about a type stands here once, a row for each. A new type is one row, a check and a schema.
#include <algorithm>

#include "scene/field.h"
#include "std.h"

namespace carom {
namespace {

constexpr string_view axes = "x|y|z", sides = "width|height";

// clang-format off
constexpr TypeFacts all_types[] = {
    {.type = Type::number, .form = "a number{limits}{unit}"},
    {.type = Type::whole, .form = "{an} whole number{limits}", .whole = true},
    {.type = Type::flag, .form = "true or false", .text = true},
    {.type = Type::text, .form = "a text", .text = true},
    {.type = Type::text_or_flag, .form = "true, false or a text", .text = true},
    {.type = Type::choice, .form = "{choices}"},
    {.type = Type::vector, .form = "[x, y, z], three numbers{limits}{unit}", .inside = Inside::numbers, .components = axes},
    {.type = Type::direction, .form = "[x, y, z], three numbers, not all zero", .inside = Inside::numbers, .components = axes},
    {.type = Type::extent, .form = "[width, height], two numbers{limits}{unit}", .inside = Inside::numbers, .components = sides},
    {.type = Type::pixels, .form = "[width, height], two {even}whole numbers{limits}{unit}, or {choices}", .inside = Inside::numbers, .components = sides, .whole = true},
    {.type = Type::color, .form = "a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1"},
    {.type = Type::color_or_none, .form = "none or a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1"},
    {.type = Type::color_or_part, .form = "a colour (a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1), or a map of keys", .inside = Inside::map},
    {.type = Type::file, .form = "the path of a file, relative to the folder of the scene", .text = true},
    {.type = Type::name, .form = "a name"},
    {.type = Type::point_or_name, .form = "[x, y, z], three numbers{limits}{unit}, or a name", .inside = Inside::numbers, .components = axes},
    {.type = Type::two_names, .form = "[name, name]"},
    {.type = Type::names, .form = "a list of names, such as {example}", .other_form = "a list of {choices}"},
    {.type = Type::part, .form = "a map of keys", .inside = Inside::map, .other_form = "a map of keys, or a value of `{plain}`"},
    {.type = Type::part_or_flag, .form = "true, false or a map of keys", .inside = Inside::map},
    {.type = Type::values, .form = "a map from names to numbers, such as {{r: 0.05}}", .inside = Inside::values, .text = true},
    {.type = Type::texts, .form = "a map from names to texts, such as {example}", .inside = Inside::values, .text = true},
    {.type = Type::repeat, .form = "a whole number of at least 0, or a map from names of indices to such numbers, such as {{i: 6, j: 4}}", .whole = true, .text = true},
    {.type = Type::named, .form = "a map from names to entries", .inside = Inside::named},
    {.type = Type::list, .form = "a list", .inside = Inside::list, .other_form = "a list of maps, or {plain}"},
    {.type = Type::settings, .form = "a map from paths to values, such as {{balls.red.mass: 2}}"},
    {.type = Type::axes, .form = "a map from paths to lists or ranges, such as {{balls.red.mass: [1, 2]}} or {{balls.red.mass: {{from: 1, to: 2, count: 3}}}}", .inside = Inside::paths},
    {.type = Type::spans, .form = "a map from paths to ranges, such as {{balls.red.mass: {{from: 1, to: 2}}}}", .inside = Inside::paths},
    {.type = Type::cases, .form = "a list of maps from paths to values, such as [{{balls.red.mass: 2}}]"},
};
// clang-format on

constexpr bool is_in_order() {
  size_t i = 0;
  return std::ranges::all_of(all_types, [&](const TypeFacts& row) { return row.type == static_cast<Type>(i++); });
}
static_assert(is_in_order());

}  // namespace

const TypeFacts& facts_of(Type type) {
  return all_types[static_cast<size_t>(type)];
}

}  // namespace carom
