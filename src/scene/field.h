#pragma once
// A row of the scene format, and what follows from it alone. A key is a row of the table (fields.h).
// Where maps of its kind fill a struct, it is also a member of that struct (member.h).
#include <nlohmann/json_fwd.hpp>

#include "std.h"

namespace carom {

enum class Type : uint8_t {
  number,          // finite
  number_or_none,  // finite, or the word none
  whole,           // >= 0
  flag,            // true or false
  text,            // one line
  text_or_flag,    // one line, true or false
  choice,          // one of Field::of, separated by |
  vector,          // [x, y, z], numbers
  direction,       // [x, y, z], not all zero; any length
  extent,          // [width, height], numbers in range
  pixels,          // [width, height], wholes in range, or one of Field::of, separated by |
  color,           // CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1
  color_or_none,   // a colour, or the word none
  color_or_part,   // a colour, or a map of kind Field::of
  number_or_part,  // a finite number, or a map of kind Field::of
  file,            // path, from the scene file's folder
  file_or_part,    // a path, or a map of kind Field::of
  name,            // of a body or a fixed thing
  point_or_name,   // [x, y, z], numbers in range, or the name of a body
  two_names,       // [name, name] of bodies or fixed things
  name_or_two,     // a name, or a list of one or two
  /// A list of names, at least one. If Field::of is given, they are from it, separated by |.
  names,
  part,  // a map of kind Field::of
  /// A map of kind Field::of, true (a map of defaults) or false (absent).
  part_or_flag,
  values,  // a map from names to numbers
  texts,   // a map from names to texts of one line
  /// How many members a thing has: a whole number, or a map from names of indices to such numbers.
  repeat,
  named,     // a map from names to kind Field::of
  list,      // a list of maps of kind Field::of
  settings,  // a map from paths into a scene, such as balls.red.mass, to values
  axes,      // a map from paths to lists of values, or to maps of kind "range"
  spans,     // a map from paths to maps of kind Field::of
  cases      // a list of maps from paths to values
};

/// The pattern of a name, a group's member, or a side of the room.
inline constexpr string_view reference =
    R"(^[A-Za-z_][A-Za-z0-9_-]*(\.([0-9]+|[xyz]_(min|max)|side|bottom|top|\{.+\})){0,2}$)";

/// Numbers from `min` to `max`, ends included unless a flag excludes them.
struct Range {
  double min = -infinity;
  double max = infinity;
  bool above_min = false;  // min itself is not allowed
  bool below_max = false;  // max itself is not allowed
  bool even = false;       // whole numbers only
};

/// What stands below a value, by the next step of a path. From `map` on these are maps.
enum class Inside : uint8_t {
  nothing,
  text,     // nothing, and the value holds neither numbers nor names of things
  counts,   // of a map from indices; it is read before all else
  numbers,  // those of a list, by TypeFacts::components
  values,   // those of a map, by name
  map,      // the keys of a map of kind Field::of
  named,    // maps of kind Field::of, by name
  list,     // maps of kind Field::of, by number
  paths     // maps of kind Field::of, by path into a scene
};

/// What all rows of one type have in common.
struct TypeFacts {
  Type type;
  /// The form of a value (expected()), with the names of its arguments in braces.
  string_view form;
  Inside inside = Inside::nothing;
  string_view components = {};  // separated by |
  string_view other_form = {};  // where the row has `plain`, and of names with Field::of
  bool or_value = false;        // a single value may stand in place of the map
};
const TypeFacts& facts_of(Type type);

struct Field;
struct Kind;
struct Node;
class View;

/// The struct member that a key fills. The struct is the one that maps of the kind stand for.
/// Rows get it from member.h.
struct Member {
  /// Fills the member if the view has a value.
  void (*fill)(void* settings, const View& view, const Field& field) = nullptr;
  /// The member of a new struct, as YAML. Empty: absent unless given.
  string (*initial)(const Field& field) = nullptr;
  nlohmann::ordered_json (*json)(const void* settings, const Field& field) = nullptr;
  /// Field::initial as a tree, of rows without a member, too. Null: none. The table makes it.
  const Node* initial_node = nullptr;
};

struct Field {
  string_view key = {};
  Type type = Type::number;
  string_view unit = {};
  Range range = {};
  /// The default as YAML. Empty: absent unless given. A row with a member takes the member's default.
  string_view initial = {};
  string_view of = {};  // kind, or choices
  /// Keys of the kind that exclude one another, including this one, separated by |.
  string_view one_of = {};
  /// Whether this key, or another of `one_of` or `spared_by`, must be present.
  bool needed = false;
  /// Keys of the kind beside which this one is not needed, and does not need `with`; separated by |.
  string_view spared_by = {};
  string_view doc = {};
  string_view example = {};  // a value as YAML
  /// Empty: derived from the key.
  string_view title = {};
  /// A key of the kind that must stand beside this one, unless one of `spared_by` does.
  string_view with = {};
  /// Engines that accept a value other than `initial`, separated by |. Empty: all.
  string_view engines = {};
  /// A regular expression for the schema, for a text or for names.
  string_view pattern = {};
  /// What may stand in place of a map. For a map: a plain value, that of this key. For the maps of a list: these words,
  /// separated by |.
  string_view plain = {};
  bool own = false;  // never taken from Kind::beneath
  /// Pictures depend on the key and on all below it, and the motion does not. (On a mesh with `fit` it does.)
  bool drawn = false;
  /// Absent: the decoder reads the key itself (keys of the whole scene; lists; a group's ball, which has defaults).
  Member member = {};
  /// The kind `of` of the map, or of the maps in a list or named map. Null: the value holds none. The table finds it.
  const Kind* held = nullptr;
};

/// A row with what all rows have.
constexpr Field row(string_view key, string_view doc, string_view example, Field rest = {}) {
  rest.key = key;
  rest.doc = doc;
  rest.example = example;
  return rest;
}

struct Kind {
  string_view name;  // as Field::of has it
  /// For messages: "a", "an", or "" before a name that is the key itself.
  string_view article;
  string_view doc;
  span<const Field> fields;
  /// A colour that may stand beside the names of such maps (lights: ambient).
  const Field* also = nullptr;
  /// The key of `defaults` that supplies values missing in maps of this kind.
  string_view defaults = {};
  /// Keys of which at least one must be present, separated by |.
  string_view any_of = {};
  /// The neighbouring kind that supplies values missing in maps of this kind.
  string_view beneath = {};
  /// A list of such maps must not be empty.
  bool needs_entries = false;
};

const Field* find_field(const Kind& kind, string_view key);

/// A phrase for use after a noun: "above 0", "from 1 to 8", "of at least 0". Empty: any number.
string describe(const Range& range);
bool contains(const Range& range, double value);
/// Whether each number of a value of this field, or in it, is a whole number.
bool holds_whole_numbers(const Field& field);

/// The largest number of a unit, whatever the field, and the smallest where numbers must be above 0.
/// Within these limits doubles hold every energy, distance to the eighth power, and quotient of two of them.
/// Floats hold every length that grids and pictures use.
struct UnitLimit {
  string_view unit;
  double smallest, largest;
};
span<const UnitLimit> unit_limits();

/// The field's range, within the limits of its unit.
Range limited_range(const Field& field);

/// "a run computes with numbers from 1e-30 to 1e+30 m": the message for a number beyond limited_range().
string limit_text(const Range& limits, string_view unit);

/// The form of a value of this field: "a number above 0 in kg", "[x, y, z] in m", "average, minimum or maximum".
string expected(const Field& field);

/// "Only with `mesh`.": the key that must stand beside this one. Empty: none.
string condition_text(const Field& field);

/// The field in sentences: its doc, the form of a value, its default, the keys that it excludes.
string described(const Field& field);

/// The parts of "a|b|c".
vector<string_view> parts_of(string_view text);
bool has_part(string_view text, string_view part);

/// The keys that exclude this one.
vector<string_view> rivals(const Field& field);

/// The other keys that may stand in place of a needed one: those that exclude it, and those that spare it.
vector<string_view> substitutes(const Field& field);

/// For each needed field, the keys of which one must be present.
vector<vector<string_view>> needs_of(const Kind& kind);

/// The first of these that holds the field's key. Empty: the field is not needed.
vector<string_view> need_with(const Kind& kind, const Field& field);

/// A word as YAML. One that begins with no letter or digit, such as a comma, is in quotes.
string word_in_yaml(string_view word);

/// The choices of a field, as separate words.
vector<string_view> choices(const Field& field);

/// The title, or one derived from the key: "Rest speed".
string title_of(const Field& field);

/// Whether maps of a kind are below a value of this field, by names or numbers.
bool holds_entries(const Field& field);
/// Whether a value of this field can be one map of kind Field::of.
bool holds_map(const Field& field);

/// "a", "a or b", "a, b or c"
string listed(const vector<string_view>& words);

}  // namespace carom
