// Flattens the tree of a scene file along the table of fields, which gives the unit of each value.
// It reads the text itself and not a decoded Scene, so that values keep their paths and places.
#include "scene/scene_values.h"

#include <fmt/format.h>

#include "scene/fields.h"
#include "scene/load.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace carom {
namespace {

class Flattener {
 public:
  void map(const string& path, const Node& node, const Kind& kind) {
    if (!node.is_map()) return leaf(path, node, {});
    for (size_t i = 0; i < node.items.size(); ++i) {
      const Field* field = find_field(kind, node.keys[i].text);
      const string below = path.empty() ? node.keys[i].text : path + "." + node.keys[i].text;
      if (field == nullptr)
        leaf(below, node.items[i], {});
      else
        value(below, node.items[i], *field);
    }
  }

  vector<SceneValue> found;

 private:
  void value(const string& path, const Node& node, const Field& field) {
    const TypeFacts& facts = facts_of(field.type);
    const auto below = [&](string_view step) { return fmt::format("{}.{}", path, step); };
    const bool is_map = node.is_map(), is_list = node.is_sequence();

    switch (facts.inside) {
      case Inside::map:
        if (!is_map) break;
        return map(path, node, *field.held);
      case Inside::named:
        if (!is_map) break;
        for (size_t i = 0; i < node.items.size(); ++i) map(below(node.keys[i].text), node.items[i], *field.held);
        return;

      case Inside::values:
        if (!is_map) break;
        for (size_t i = 0; i < node.items.size(); ++i) leaf(below(node.keys[i].text), node.items[i], {});
        return;

      case Inside::list:
        if (!is_list) break;
        for (size_t i = 0; i < node.items.size(); ++i) map(below(to_string(i)), node.items[i], *field.held);
        return;

      case Inside::numbers: {
        const vector<string_view> names = parts_of(facts.components);
        if (!is_list || node.items.size() != names.size()) break;
        for (size_t i = 0; i < names.size(); ++i) leaf(below(names[i]), node.items[i], field.unit);
        return;
      }
      default:
        break;
    }

    leaf(path, node, field.unit);
  }

  void leaf(const string& path, const Node& node, string_view unit) {
    found.push_back({path, text_of_value(node), string(unit), node.place.offset});
  }
};

}  // namespace

string text_of_value(const Node& node) {
  if (node.is_scalar()) {
    const auto number = node.quoted ? nullopt : parse_number(node.text);
    return number ? shortest(*number) : node.text;
  }
  string text;
  for (size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (node.is_map()) text += node.keys[i].text + ": ";
    text += text_of_value(node.items[i]);
  }
  if (node.is_sequence()) return "[" + text + "]";
  return node.is_map() ? "{" + text + "}" : text;
}

vector<SceneValue> scene_values(const string& name, const string& text) {
  vector<Source> sources = {{name, text}};
  Diagnostics diagnostics(sources);
  optional<Node> root;
  if (check_text(sources[0], 0, diagnostics)) root = parse_document(sources, 0, 0, diagnostics);
  if (!root || !diagnostics.empty()) throw SceneError(diagnostics, false);
  Flattener flattener;
  flattener.map("", *root, kind_named("scene"));
  return std::move(flattener.found);
}

string without_tables(string text) {
  const size_t output = text.rfind("\noutput:\n");
  const size_t line = output == string::npos ? output : text.find("\n  tables: ", output);
  if (line != string::npos) text.erase(line, text.find('\n', line + 1) - line);
  return text;
}

TablesOutput own_tables(const string& text) {
  TablesOutput tables;
  // Few scenes choose, and parsing takes longer than this search.
  if (text.find("tables") == string::npos) return tables;
  try {
    for (const SceneValue& value : scene_values("scene.yaml", text)) {
      if (value.path == "output.tables.separator")
        tables.separator = value.text == ";"     ? TablesOutput::Separator::semicolon
                           : value.text == "tab" ? TablesOutput::Separator::tab
                                                 : TablesOutput::Separator::comma;
      if (value.path == "output.tables.decimal" && value.text == ",") tables.decimal = TablesOutput::Decimal::comma;
    }
  } catch (const SceneError&) {
    return {};
  }
  return tables;
}

vector<string> own_measure_names(const string& text) {
  constexpr string_view start = "measures.";
  vector<string> names;
  try {
    for (const SceneValue& value : scene_values("scene.yaml", text))
      if (value.path.starts_with(start)) names.push_back(value.path.substr(start.size()));
  } catch (const SceneError&) {
    return {};
  }
  return names;
}

}  // namespace carom
