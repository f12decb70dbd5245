// Writes the table of fields as a JSON Schema, with one definition for each kind.
// One rule is not local: a map needs a key only where `defaults` lacks it.
// A definition therefore leaves such keys optional, and the root has a condition for each of them.
#include "scene/schema.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "scene/colors.h"
#include "scene/fields.h"
#include "scene/formula.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr string_view name_pattern = "^[A-Za-z_][A-Za-z0-9_-]*$";
// Members of a repeated thing, as a resolved scene has them.
constexpr string_view member_pattern = R"(^[A-Za-z_][A-Za-z0-9_-]*(\.(0|[1-9][0-9]*))?$)";
// Of numbers that expressions contain.
constexpr string_view variable_pattern = "^[A-Za-z_][A-Za-z0-9_]*$";
constexpr int longest_name = 200, longest_text = 10'000;
constexpr string_view control_characters = R"([\u0000-\u001f\u007f-\u009f\u2028\u2029\ufeff])";

Json reference(string_view definition) {
  return {{"$ref", fmt::format("#/definitions/{}", definition)}};
}

Json required(const vector<string_view>& keys) {
  return {{"required", keys}};
}

Json either(Json first, Json second) {
  return {{"anyOf", Json::array({std::move(first), std::move(second)})}};
}

/// The value below `key` matches `schema`.
Json at(string_view key, Json schema) {
  return {{"properties", {{string(key), std::move(schema)}}}};
}

/// The word none, which cancels a default.
const Json& cancelled() {
  static const Json word = {{"const", "none"}};
  return word;
}

/// The key is present, and does not cancel its default.
Json present(const Kind& kind, string_view key) {
  Json schema = required({key});
  if (!kind.defaults.empty()) schema.update(at(key, {{"not", cancelled()}}));
  return schema;
}

/// At least one of the keys is present.
Json one_required(const Kind& kind, const vector<string_view>& keys) {
  if (keys.size() == 1) return present(kind, keys.front());
  Json any = Json::array();
  for (const string_view key : keys) any.push_back(present(kind, key));
  return {{"anyOf", any}};
}

/// Finite numbers. The largest double is a bound under `not`.
/// To a validator .nan is within any bounds, so it exceeds that bound too and is refused.
Json number_schema(const Range& range) {
  constexpr double largest = numeric_limits<double>::max();
  Json schema = {{"type", "number"}};
  schema[range.above_min ? "exclusiveMinimum" : "minimum"] = number_json(max(range.min, -largest));
  if (range.max <= largest) schema[range.below_max ? "exclusiveMaximum" : "maximum"] = number_json(range.max);
  schema["not"] = {{"exclusiveMinimum", largest}};
  return schema;
}

Json whole_schema(const Range& range) {
  constexpr uint64_t largest = numeric_limits<uint64_t>::max();
  if (range.min == range.max) return {{"type", "integer"}, {"const", number_json(range.min)}};
  Json schema = {{"type", "integer"}, {"minimum", number_json(max(range.min, 0.0))}};
  schema["maximum"] = range.max < double(largest) ? number_json(range.max) : Json(largest);
  if (range.even) schema["multipleOf"] = 2;
  return schema;
}

/// least: 0: as many as `count`.
Json array_schema(Json each, int count, int least = 0) {
  return {{"type", "array"}, {"items", std::move(each)}, {"minItems", least > 0 ? least : count}, {"maxItems", count}};
}

Json numbers_schema(const Field& field) {
  return array_schema(holds_whole_numbers(field) ? whole_schema(field.range) : number_schema(limited_range(field)),
                      int(parts_of(facts_of(field.type).components).size()));
}

Json direction_schema(const Field& field) {
  Json schema = numbers_schema(field);
  schema["not"] = {{"items", {{"const", 0}}}};
  return schema;
}

/// Any scalar is a text, whatever type a YAML parser gives it.
Json text_schema(const Field& field) {
  if (!field.pattern.empty()) return {{"type", "string"}, {"pattern", field.pattern}};
  Json schema = {{"type", {"string", "number", "boolean"}}, {"maxLength", longest_text}};
  if (field.type == Type::file || field.type == Type::file_or_part) schema["minLength"] = 1;
  schema["not"] = {{"type", "string"}, {"pattern", control_characters}};
  return schema;
}

/// A pattern that matches the words in any case: [rR][eE][dD]|...
string in_any_case(const vector<string_view>& words) {
  string pattern = "^(";
  for (const string_view word : words) {
    if (word != words.front()) pattern += '|';
    for (const char c : word) pattern += fmt::format("[{}{}]", c, char(c - 32));
  }
  return pattern + ")$";
}

Json color_schema() {
  const Json names = {{"enum", color_names()}};
  const Json hex = {{"type", "string"}, {"format", "color-hex"}, {"pattern", "^#([0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})$"}};
  const Json any_case = {{"type", "string"}, {"pattern", in_any_case(color_names())}};
  return {{"anyOf", Json::array({names, hex, array_schema(number_schema({0, 1}), 3), any_case})}};
}

Json field_schema(const Field& field);

Json named_schema(const Kind& kind) {
  Json schema = {{"type", "object"}};
  const bool repeats = find_field(kind, "repeat") != nullptr;
  schema["propertyNames"] = {
      {"type", "string"}, {"pattern", repeats ? member_pattern : name_pattern}, {"maxLength", longest_name}};
  if (kind.also != nullptr) schema["properties"] = {{string(kind.also->key), field_schema(*kind.also)}};
  schema["additionalProperties"] = reference(kind.name);
  return schema;
}

/// A map from paths to values. The scene's schema determines which values are valid.
Json settings_schema() {
  return {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", {{"not", {{"type", "null"}}}}}};
}

Json axis_schema(const Kind& range) {
  const Json values = {{"type", "array"}, {"items", {{"not", {{"type", "null"}}}}}, {"minItems", 1}};
  return either(values, reference(range.name));
}

/// A map from names in expressions to numbers.
Json variables_schema(Json number) {
  return {{"type", "object"},
          {"propertyNames", {{"type", "string"}, {"pattern", variable_pattern}, {"maxLength", longest_name}}},
          {"additionalProperties", std::move(number)}};
}

Json repeat_schema() {
  Json indices = variables_schema(whole_schema({0, infinity}));
  indices["minProperties"] = 1;
  indices["maxProperties"] = 8;
  return either(whole_schema({0, infinity}), indices);
}

Json choice_schema(const Field& field) {
  Json all = Json::array();
  for (const string_view choice : choices(field)) all.push_back(json_of_yaml(word_in_yaml(choice)));
  return {{"enum", all}};
}

Json list_schema(const Field& field) {
  Json entry = reference(field.of);
  if (!field.plain.empty()) entry = either({{"enum", parts_of(field.plain)}}, entry);
  Json schema = {{"type", "array"}, {"items", std::move(entry)}};
  if (field.held->needs_entries) schema["minItems"] = 1;
  return schema;
}

/// A value that stands in place of a map.
Json value_for_part(const Field& field) {
  return field.type == Type::file_or_part ? text_schema(field) : number_schema(limited_range(field));
}

/// Of a type that only sweep files have.
Json schema_of_sweep(const Field& field) {
  if (field.type == Type::settings) return settings_schema();
  if (field.type == Type::cases) return {{"type", "array"}, {"items", settings_schema()}, {"minItems", 1}};
  return {{"type", "object"},
          {"minProperties", 1},
          {"additionalProperties", field.type == Type::axes ? axis_schema(*field.held) : reference(field.of)}};
}

Json value_schema(const Field& field) {
  switch (field.type) {
    // Single values.
    case Type::number:
      return number_schema(limited_range(field));
    case Type::number_or_none:
      return either(number_schema(limited_range(field)), cancelled());
    case Type::whole:
      return whole_schema(field.range);

    // Flags and texts.
    case Type::flag:
      return {{"type", "boolean"}};
    case Type::text:
    case Type::name:
    case Type::text_or_flag:
    case Type::file:
      return text_schema(field);
    case Type::choice:
      return choice_schema(field);

    // Lists of numbers.
    case Type::vector:
    case Type::extent:
      return numbers_schema(field);
    case Type::direction:
      return direction_schema(field);
    case Type::pixels:
      return either(numbers_schema(field), choice_schema(field));
    case Type::point_or_name:
      return either(numbers_schema(field), text_schema(field));

    // Colours and names.
    case Type::color:
      return {{"allOf", Json::array({reference("color")})}};
    case Type::color_or_none:
      return either(reference("color"), cancelled());
    case Type::color_or_part:
      return either(reference("color"), reference(field.of));

    case Type::number_or_part:
    case Type::file_or_part:
      return either(value_for_part(field), reference(field.of));

    case Type::two_names:
      return array_schema(text_schema(field), 2);
    case Type::name_or_two:
      return either(text_schema(field), array_schema(text_schema(field), 2, 1));
    case Type::names:
      return {{"type", "array"},
              {"items", field.of.empty() ? text_schema(field) : choice_schema(field)},
              {"minItems", 1},
              {"uniqueItems", true}};

    // Maps, and lists of maps.
    case Type::part:
      if (field.plain.empty()) return {{"allOf", Json::array({reference(field.of)})}};
      return either(reference(field.of), value_schema(*find_field(*field.held, field.plain)));
    case Type::part_or_flag:
      return either({{"type", "boolean"}}, reference(field.of));
    case Type::values:
      return variables_schema(number_schema(field.range));
    case Type::texts:
      return variables_schema(text_schema(field));
    case Type::repeat:
      return repeat_schema();

    case Type::named:
      return named_schema(*field.held);
    case Type::list:
      return list_schema(field);

    default:
      return schema_of_sweep(field);
  }
}

Json field_schema(const Field& field) {
  Json schema;
  const string unit = field.unit.empty() ? "" : fmt::format(" ({})", field.unit);
  schema["title"] = title_of(field) + unit;
  schema["description"] = described(field);
  schema.update(value_schema(field));
  if (!field.initial.empty()) schema["default"] = json_of_yaml(field.initial);
  if (!field.example.empty()) schema["examples"] = Json::array({json_of_yaml(field.example)});
  return schema;
}

/// A rule for maps in which `key` is present. If the kind has defaults, its value may cancel one, and no rule holds.
Json if_present(const Kind& kind, string_view key, Json rule) {
  if (kind.defaults.empty()) return rule;
  return {{"if", at(key, {{"not", cancelled()}})}, {"then", std::move(rule)}};
}

/// Field::one_of: each key excludes the rivals listed after it.
Json exclusions(const Kind& kind) {
  Json all = Json::object();
  for (const Field& field : kind.fields) {
    Json later = Json::object();
    bool passed = false;
    for (const string_view key : parts_of(field.one_of)) {
      if (passed) later[string(key)] = kind.defaults.empty() ? Json(false) : cancelled();
      passed = passed || key == field.key;
    }
    if (!later.empty()) all[string(field.key)] = if_present(kind, field.key, {{"properties", later}});
  }
  return all;
}

/// Field::engines of a key of `simulate`, or of a key in a part of it.
Json engine_rule(const Field& field, const Field* part = nullptr) {
  Json when = required({field.key});
  if (!field.initial.empty()) when.update(at(field.key, {{"not", {{"const", json_of_yaml(field.initial)}}}}));

  // In a part, the key or a plain value asks for the engine.
  if (part != nullptr) {
    Json of_part = required({part->key});
    when["type"] = "object";
    if (part->plain == field.key)
      when = either(when, {{"type", "string"}, {"not", {{"const", json_of_yaml(field.initial)}}}});
    of_part.update(at(part->key, when));
    when = of_part;
  }

  const vector<string_view> engines = parts_of(field.engines);
  const Field& engine = *find_field(kind_named("simulate"), "engine");
  Json then = at(engine.key, {{"enum", engines}});
  if (!contains(engines, engine.initial)) then.update(required({engine.key}));
  return {{"if", when}, {"then", then}};
}

/// Field::with, of a kind without defaults.
Json beside_rule(const Kind& kind, const Field& field) {
  vector<string_view> keys = parts_of(field.spared_by);
  keys.insert(keys.begin(), field.with);
  return {{"if", required({field.key})}, {"then", one_required(kind, keys)}};
}

/// Kind::beneath: if a value of the map beneath is invalid in the map that would inherit it, that map needs its own.
void add_beneath_rules(const Field& field, Json& rules) {
  const Kind* kind = field.held;
  if (kind == nullptr || kind->beneath.empty()) return;
  for (const Field& own : kind->fields) {
    const Field* below = find_field(kind_named(kind->beneath), own.key);
    if (below == nullptr || !own.range.even || below->range.even) continue;

    Json unsuited = required({own.key}), when = required({kind->beneath});
    unsuited["type"] = "object";
    unsuited.update(at(own.key, {{"not", value_schema(own)}}));
    when.update(at(kind->beneath, unsuited));

    const Json absent = {{"const", false}};
    Json given = required({own.key});
    given["type"] = "object";
    rules.push_back({{"if", when}, {"then", at(field.key, either(absent, given))}});
  }
}

/// A property whose default can be cancelled. Texts for readers stay outside.
Json or_none(Json property) {
  Json outer = Json::object();
  for (const char* key : {"title", "description", "default", "examples"}) {
    if (!property.contains(key)) continue;
    outer[key] = property[key];
    property.erase(key);
  }
  outer["anyOf"] = Json::array({std::move(property), cancelled()});
  return outer;
}

/// Lets an expression stand in place of every number below `schema`.
void allow_expressions(Json& schema) {
  if (!schema.is_structured()) return;
  for (Json& item : schema) allow_expressions(item);
  if (!schema.is_object()) return;
  const bool is_number = schema.contains("type") && (schema["type"] == "number" || schema["type"] == "integer");
  const bool is_choice = schema.contains("enum") && schema["enum"].is_array() && schema["enum"].front().is_number();
  if ((!is_number && !is_choice) || schema.contains("const")) return;
  Json outer = or_none(std::move(schema));
  outer["anyOf"][1] = reference("expression");
  schema = std::move(outer);
}

/// A map of this kind. Rules of the root require the keys that `defaults` may supply.
Json kind_schema(const Kind& kind) {
  Json schema = {{"description", kind.doc}, {"type", "object"}};
  Json properties = Json::object(), rules = Json::array();
  vector<string_view> keys;

  for (const Field& field : kind.fields) {
    Json& property = properties[string(field.key)] = field_schema(field);
    if (!kind.defaults.empty() && !field.own && field.type != Type::text) property = or_none(std::move(property));

    // Keys that only some engines accept.
    if (!field.engines.empty() && kind.name == "simulate") rules.push_back(engine_rule(field));
    if (field.type == Type::part && kind.name == "simulate")
      for (const Field& inner : field.held->fields)
        if (!inner.engines.empty()) rules.push_back(engine_rule(inner, &field));

    if (!field.with.empty() && kind.defaults.empty()) rules.push_back(beside_rule(kind, field));
    add_beneath_rules(field, rules);
  }

  if (kind.defaults.empty()) {
    for (const auto& need : needs_of(kind)) {
      if (need.size() == 1) {
        keys.push_back(need.front());
      } else {
        rules.push_back(one_required(kind, need));
      }
    }
  }

  if (!kind.any_of.empty()) rules.push_back(one_required(kind, parts_of(kind.any_of)));

  schema["properties"] = properties;
  if (!keys.empty()) schema["required"] = keys;
  schema["additionalProperties"] = false;
  if (const Json all = exclusions(kind); !all.empty()) schema["dependencies"] = all;
  if (!rules.empty()) schema["allOf"] = rules;
  return schema;
}

/// `defaults` has one of these keys for maps of this kind.
Json has_default(const Kind& kind, const vector<string_view>& keys) {
  Json part = required({kind.defaults});
  part.update(at(kind.defaults, one_required(kind, keys)));
  Json whole = required({"defaults"});
  whole.update(at("defaults", std::move(part)));
  return whole;
}

/// A part that need not be there where the defaults of its own kind have all that it needs (add_part_rules).
bool is_part_with_defaults(const Field& field) {
  return field.type == Type::part && !field.held->defaults.empty();
}

/// Adds the required keys of a kind that has defaults. `each` wraps a schema of one map into one of the root.
void add_rules(const Kind& kind, const function<Json(Json)>& each, Json& rules) {
  for (const auto& need : needs_of(kind))
    if (!is_part_with_defaults(*find_field(kind, need.front())))
      rules.push_back({{"if", has_default(kind, need)}, {"else", each(one_required(kind, need))}});
  for (const Field& field : kind.fields) {
    if (field.with.empty()) continue;
    // The rule holds where the key is present, and where the default takes effect because no rival hides it.
    const Json beside = {
        {"dependencies", {{string(field.key), if_present(kind, field.key, present(kind, field.with))}}}};
    rules.push_back({{"if", has_default(kind, {field.with})}, {"else", each(beside)}});
    vector<string_view> hiding = rivals(field);
    hiding.push_back(field.with);
    Json hidden = Json::array({one_required(kind, hiding), required({field.key})});
    hidden[1].update(at(field.key, cancelled()));
    rules.push_back(
        {{"if", {{"allOf", Json::array({has_default(kind, {field.key}), {{"not", has_default(kind, {field.with})}}})}}},
         {"then", each({{"anyOf", std::move(hidden)}})}});
  }
}

/// A part with defaults of its own. It stands in the map of `owner`, or comes complete from the owner's defaults.
void add_part_rules(const Kind& owner, const Field& field, const function<Json(Json)>& each, Json& rules) {
  const Kind& kind = *field.held;
  add_rules(
      kind, [&](Json schema) { return each(at(field.key, std::move(schema))); }, rules);
  for (const auto& need : needs_of(kind)) {
    Json part = required({owner.defaults}), owned = required({field.key});
    // `none` is no map, and brings nothing.
    Json own = one_required(kind, need);
    own["type"] = "object";
    owned.update(at(field.key, std::move(own)));
    part.update(at(owner.defaults, owned));
    Json whole = required({"defaults"});
    whole.update(at("defaults", part));
    rules.push_back({{"if", either(has_default(kind, need), whole)}, {"else", each(present(owner, field.key))}});
  }
}

Json root_rules(const Kind& root) {
  Json rules = Json::array();
  if (find_field(root, "defaults") == nullptr) return rules;
  for (const Field& field : root.fields) {
    if (field.type != Type::named || field.held->defaults.empty()) continue;
    const Kind& kind = *field.held;
    const auto each = [&](Json schema) { return at(field.key, {{"additionalProperties", std::move(schema)}}); };
    add_rules(kind, each, rules);
    for (const Field& part : kind.fields) {
      if (!is_part_with_defaults(part)) continue;
      // Where the part may be absent, it need not be complete either.
      const vector<string_view> sparing = parts_of(part.spared_by);
      const auto spared = [&](Json schema) {
        return each(sparing.empty() ? std::move(schema) : either(one_required(kind, sparing), std::move(schema)));
      };
      add_part_rules(kind, part, spared, rules);
    }
  }
  return rules;
}

/// Collects the kinds that a map of `kind` can hold, each once, in order.
void collect(const Kind& kind, vector<const Kind*>& found) {
  for (const Field& field : kind.fields) {
    const Kind* held = field.held;
    if (held == nullptr || contains(found, held)) continue;
    found.push_back(held);
    collect(*held, found);
  }
}

}  // namespace

string json_schema(string_view root_name) {
  const Kind& root = kind_named(root_name);
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", fmt::format("carom: {}", root.name)}};

  schema.update(kind_schema(root));
  if (Json rules = root_rules(root); !rules.empty()) {
    if (!schema.contains("allOf")) schema["allOf"] = Json::array();
    for (Json& rule : rules) schema["allOf"].push_back(std::move(rule));
  }

  // A definition for each kind.
  vector<const Kind*> held;
  collect(root, held);
  Json definitions = {{"color", color_schema()}};
  for (const Kind* kind : held) definitions[string(kind->name)] = kind_schema(*kind);

  if (root_name == "scene") {
    allow_expressions(schema);
    allow_expressions(definitions);
    definitions["expression"] = {
        {"description", "An expression: numbers, names of `let`, indices, + - * / ^ %, parentheses, pi, " +
                            listed(formula_functions()) + ". Angles are in degrees."},
        {"type", "string"},
        {"pattern", "^="},
        {"maxLength", longest_formula + 1}};
  }

  schema["definitions"] = std::move(definitions);
  return text_of_json(schema, 2) + "\n";
}

}  // namespace carom
