// Flattens the tree of a scene file along the table of fields, which gives the unit of each value.
// It reads the text itself and not a decoded Scene, so that values keep their paths and places.
#include "scene/scene_values.h"

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
    if (!node.is(Node::Kind::map)) return leaf(path, node, {});
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
    switch (field.type) {
      case Type::part:
      case Type::part_or_flag:
      case Type::color_or_part:
        return map(path, node, kind_named(field.of));
      case Type::named:
        if (!node.is(Node::Kind::map)) return leaf(path, node, {});
        for (size_t i = 0; i < node.items.size(); ++i)
          map(path + "." + node.keys[i].text, node.items[i], kind_named(field.of));
        return;
      case Type::values:
      case Type::texts:
        if (!node.is(Node::Kind::map)) return leaf(path, node, {});
        for (size_t i = 0; i < node.items.size(); ++i) leaf(path + "." + node.keys[i].text, node.items[i], {});
        return;
      case Type::list:
        if (!node.is(Node::Kind::sequence)) return leaf(path, node, {});
        for (size_t i = 0; i < node.items.size(); ++i) {
          const string entry = path + "." + std::to_string(i);
          node.items[i].is(Node::Kind::scalar) ? leaf(entry, node.items[i], {})
                                               : map(entry, node.items[i], kind_named(field.of));
        }
        return;
      case Type::vector:
      case Type::direction:
      case Type::point_or_name:
        return numbers(path, node, field, array<string_view, 3>{"x", "y", "z"});
      case Type::extent:
      case Type::pixels:
        return numbers(path, node, field, array<string_view, 2>{"width", "height"});
      default:
        return leaf(path, node, field.unit);
    }
  }

  template <size_t Size>
  void numbers(const string& path, const Node& node, const Field& field, const array<string_view, Size>& names) {
    if (!node.is(Node::Kind::sequence) || node.items.size() != Size) return leaf(path, node, field.unit);
    for (size_t i = 0; i < Size; ++i) leaf(path + "." + string(names[i]), node.items[i], field.unit);
  }

  void leaf(const string& path, const Node& node, string_view unit) {
    found.push_back({path, text_of_value(node), string(unit), node.place.offset});
  }
};

}  // namespace

string text_of_value(const Node& node) {
  if (node.is(Node::Kind::scalar)) {
    const auto number = node.quoted ? nullopt : parse_number(node.text);
    return number ? shortest(*number) : node.text;
  }
  string text;
  for (size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (node.is(Node::Kind::map)) text += node.keys[i].text + ": ";
    text += text_of_value(node.items[i]);
  }
  if (node.is(Node::Kind::sequence)) return "[" + text + "]";
  return node.is(Node::Kind::map) ? "{" + text + "}" : text;
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
