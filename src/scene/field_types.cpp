// What the code asks about a type stands here once, a row for each. A new type is one row, a check and a schema.

#include "scene/field.h"
#include "std.h"

namespace carom {
namespace {

constexpr string_view axes = "x|y|z", sides = "width|height";

// clang-format off
constexpr TypeFacts all_types[] = {
    {Type::number, "a number{limits}{unit}"},
    {Type::number_or_none, "none or a number{limits}{unit}"},
    {Type::whole, "{an} whole number{limits}"},
    {Type::flag, "true or false", Inside::text},
    {Type::text, "a text", Inside::text},
    {Type::text_or_flag, "true, false or a text", Inside::text},
    {Type::choice, "{choices}"},
    {Type::vector, "[x, y, z], three numbers{limits}{unit}", Inside::numbers, axes},
    {Type::direction, "[x, y, z], three numbers, not all zero", Inside::numbers, axes},
    {Type::extent, "[width, height], two numbers{limits}{unit}", Inside::numbers, sides},
    {Type::pixels, "[width, height], two {even}whole numbers{limits}{unit}, or {choices}", Inside::numbers, sides},
    {Type::color, "a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1"},
    {Type::color_or_none, "none or a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1"},
    {Type::color_or_part, "a colour (a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1), or a map of keys", Inside::map, "", "", true},
    {Type::number_or_part, "a number{limits}{unit}, or a map of keys", Inside::map, "", "", true},
    {Type::file, "the path of a file, relative to the folder of the scene", Inside::text},
    {Type::file_or_part, "the path of a file, relative to the folder of the scene, or a map of keys", Inside::map, "", "", true},
    {Type::name, "a name"},
    {Type::point_or_name, "[x, y, z], three numbers{limits}{unit}, or a name", Inside::numbers, axes},
    {Type::two_names, "[name, name]"},
    {Type::name_or_two, "a name, or a list of one or two names"},
    {Type::names, "a list of names, such as {example}", Inside::nothing, "", "a list of {choices}"},
    {Type::part, "a map of keys", Inside::map, "", "a map of keys, or a value of `{plain}`"},
    {Type::part_or_flag, "true, false or a map of keys", Inside::map},
    {Type::values, "a map from names to numbers, such as {{r: 0.05}}", Inside::values},
    {Type::texts, "a map from names to texts, such as {example}", Inside::values},
    {Type::repeat, "a whole number of at least 0, or a map from names of indices to such numbers, such as {{i: 6, j: 4}}", Inside::counts},
    {Type::named, "a map from names to entries", Inside::named},
    {Type::list, "a list", Inside::list, "", "a list of maps, or {plain}"},
    {Type::settings, "a map from paths to values, such as {{balls.red.mass: 2}}"},
    {Type::axes, "a map from paths to lists or ranges, such as {{balls.red.mass: [1, 2]}} or {{balls.red.mass: {{from: 1, to: 2, count: 3}}}}", Inside::paths},
    {Type::spans, "a map from paths to ranges, such as {{balls.red.mass: {{from: 1, to: 2}}}}", Inside::paths},
    {Type::cases, "a list of maps from paths to values, such as [{{balls.red.mass: 2}}]"},
};
// clang-format on

constexpr bool is_in_order() {
  size_t i = 0;
  return all_of(all_types, [&](const TypeFacts& row) { return row.type == static_cast<Type>(i++); });
}
static_assert(is_in_order());

}  // namespace

const TypeFacts& facts_of(Type type) {
  return all_types[size_t(type)];
}

}  // namespace carom
