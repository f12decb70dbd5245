#pragma once
// The scene format as plain data: every kind of map a scene holds and every key of it. From this one table follow the
// decoder, the messages about wrong keys and values, the resolved scene, --set, the schema, the page of the format and
// `carom explain`. A key is a row here and, where maps of its kind fill a struct, a member of that (member.h).
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

enum class Type : std::uint8_t {
  number,        // finite
  whole,         // >= 0
  flag,          // true or false
  text,          // one line
  choice,        // one of Field::of, separated by |
  vector,        // [x, y, z], numbers
  direction,     // [x, y, z], not all zero; any length
  extent,        // [width, height], numbers in range
  pixels,        // [width, height], wholes in range
  color,         // CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1
  file,          // path, from the scene file's folder
  two_names,     // [name, name] of bodies or fixed things
  names,         // a list of names, at least one; of Field::of, separated by |, if that says any
  part,          // a map of kind Field::of
  part_or_flag,  // the same, or true: a map of defaults, or false: absent
  named,         // a map from names to kind Field::of
  list,          // a list of maps of kind Field::of
  settings,      // a map from paths into a scene, such as balls.red.mass, to values there
  axes,          // a map from paths to lists of values, or to maps of kind "range"
  cases          // a list of maps from paths to values
};

/// Numbers from `min` to `max`, ends included unless said otherwise.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool above_min = false;  // min itself is not allowed
  bool below_max = false;  // max itself is not allowed
  bool even = false;       // whole numbers only
};

struct Field;
class View;

/// The member that a key fills, of the struct that maps of its kind stand for. Rows get theirs from member.h.
struct Member {
  void (*fill)(void* settings, const View& view, const Field& field) = nullptr;  // where the view has a value
  std::string (*initial)(const Field& field) = nullptr;  // of a new struct, as YAML; empty: absent unless given
  nlohmann::ordered_json (*json)(const void* settings, const Field& field) = nullptr;
};

struct Field {
  std::string_view key;
  Type type = Type::number;
  std::string_view unit = {};
  Range range = {};
  std::string_view initial =
      {};                    // the default as YAML; empty: absent unless given. Of a row with a member: the member's
  std::string_view of = {};  // kind, or choices
  std::string_view one_of = {};  // keys of the kind that exclude one another, this one among them, separated by |
  bool needed = false;           // this or another of `one_of`
  std::string_view doc = {};
  std::string_view example = {};  // a value as YAML
  std::string_view title = {};    // empty: the key says it
  std::string_view with = {};     // a key of the kind that has to stand beside this one
  std::string_view engines = {};  // those that know another value than `initial`, separated by |; empty: all
  std::string_view pattern = {};  // of a text or of names, a regular expression for the schema
  bool needs_entries = false;     // of a list: it is not empty
  Member member = {};             // none: the decoder reads the key itself
};

struct Kind {
  std::string_view name;     // as Field::of has it
  std::string_view article;  // for messages: "a", "an", or "" before a name that is the key itself
  std::string_view doc;
  std::span<const Field> fields;
  const Field* also = nullptr;     // a colour that may stand beside the names of such maps (lights: ambient)
  std::string_view defaults = {};  // the key of `defaults` with what a map of this kind does not say itself
  std::string_view any_of = {};    // keys of which at least one is there, separated by |
  std::string_view beneath = {};   // the kind beside it whose values hold where a map of this kind has none
};

/// Fills a struct with what a map says; its other members stay. `settings`: the struct that the view's kind stands for.
void fill(void* settings, const View& view);
/// The struct's members as JSON, in the order of the kind's keys.
nlohmann::ordered_json json_of(const Kind& kind, const void* settings);

/// Every kind of a scene file, "scene" first.
std::span<const Kind> kinds();
/// Every kind of a sweep file, "sweep" first.
std::span<const Kind> sweep_kinds();
/// The kinds of each sort of file; a file is a map of the first of them.
std::vector<std::span<const Kind>> families();
const Kind& kind_named(std::string_view name);  // there must be one
const Field* find_field(const Kind& kind, std::string_view key);

/// For use after a noun: "above 0", "from 1 to 8", "of at least 0"; empty: any.
std::string describe(const Range& range);
bool contains(const Range& range, double value);

/// How large the numbers of a unit may be, whatever their field, and how small where they must be above 0. Within these
/// no energy, no distance to the eighth power and no quotient of two of them leaves the doubles, and no length the
/// floats that grids and pictures use.
struct UnitLimit {
  std::string_view unit;
  double smallest, largest;
};
std::span<const UnitLimit> unit_limits();

/// The field's range, within the limits of its unit.
Range limited_range(const Field& field);

/// "a run computes with numbers from 1e-30 to 1e+30 m": of a number beyond limited_range().
std::string limit_text(const Range& limits, std::string_view unit);

/// What a value of this field looks like: "a number above 0 in kg", "[x, y, z] in m", "average, minimum or maximum".
std::string expected(const Field& field);

/// What the field is in sentences: its doc, what a value looks like, its default, what it excludes.
std::string described(const Field& field);

/// "a|b|c", one by one.
std::vector<std::string_view> parts_of(std::string_view text);

/// The keys that exclude this one.
std::vector<std::string_view> rivals(const Field& field);

/// The choices, one by one.
std::vector<std::string_view> choices(const Field& field);

/// "Rest speed": the title, or what the key says.
std::string title_of(const Field& field);

/// The kind of the map that the value is, or of those in it; null: there are none.
const Kind* held_kind(const Field& field);

/// "a", "a or b", "a, b or c"
std::string listed(const std::vector<std::string_view>& words);

}  // namespace carom
