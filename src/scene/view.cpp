// Looks a key up in the layers of a View: own map, defaults, table.
// A layer that holds a rival of the key ends the search, because the rival replaces the key.
// The table's defaults are parsed once, at first use.
#include "scene/view.h"

#include <map>

#include "scene/colors.h"
#include "yaml/diagnostics.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// Parses every default of the table, each once.
std::map<std::string_view, Node> parse_initials() {
  std::map<std::string_view, Node> nodes;
  std::vector<Source> sources(1);
  Diagnostics diagnostics(sources);
  const auto parse = [&](const Field& field) {
    if (field.initial.empty() || nodes.contains(field.initial)) return;
    sources[0].text = field.initial;
    if (std::optional<Node> node = parse_document(sources, 0, 0, diagnostics))
      nodes.emplace(field.initial, std::move(*node));
  };
  for (const std::span<const Kind> family : families()) {
    for (const Kind& kind : family)
      for (const Field& field : kind.fields) parse(field);
  }
  return nodes;
}

bool usable(const Node* node, Node::Kind kind) {
  return node != nullptr && !node->bad && node->is(kind);
}

}  // namespace

const Node& initial_node(const Field& field) {
  static const std::map<std::string_view, Node> nodes = parse_initials();
  return nodes.at(field.initial);
}

std::optional<double> as_number(const Node* node) {
  return usable(node, Node::Kind::scalar) ? parse_number(node->text) : std::nullopt;
}

std::optional<std::uint64_t> as_whole(const Node* node) {
  return usable(node, Node::Kind::scalar) ? parse_whole(node->text) : std::nullopt;
}

std::optional<bool> as_flag(const Node* node) {
  return usable(node, Node::Kind::scalar) ? std::optional(node->text == "true") : std::nullopt;
}

std::optional<std::string> as_text(const Node* node) {
  return usable(node, Node::Kind::scalar) ? std::optional(node->text) : std::nullopt;
}

std::optional<Vec3> as_vector(const Node* node) {
  if (!usable(node, Node::Kind::sequence) || node->items.size() != 3) return std::nullopt;
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> x = as_number(&node->items[static_cast<std::size_t>(i)]);
    if (!x) return std::nullopt;
    v[i] = *x;
  }
  return v;
}

std::optional<Color> as_color(const Node* node) {
  if (const std::optional<Vec3> v = as_vector(node)) return Color{v->x(), v->y(), v->z()};
  return usable(node, Node::Kind::scalar) ? parse_color(node->text) : std::nullopt;
}

Place place_of(const Node& node) {
  for (const Node& item : node.items) {
    if (item.place.source > node.place.source) return item.place;
  }
  return node.place;
}

const Node* View::given(std::string_view key) const {
  const Field* field = find_field(*kind_, key);
  return field == nullptr ? nullptr : given(*field);
}

const Node* View::given(const Field& field) const {
  return search(field).node;
}

View::Found View::search(const Field& field) const {
  for (const Node* layer : {own_, defaults_}) {
    if (layer == nullptr || (field.own && layer == defaults_)) continue;
    if (const Node* node = layer->find(field.key)) return {node->cancels ? nullptr : node, false};
    for (const std::string_view rival : rivals(field)) {
      const Node* node = layer->find(rival);
      if (node != nullptr && !node->cancels) return {nullptr, true};
    }
  }
  return {nullptr, false};
}

const Node* View::find(std::string_view key) const {
  const Field* field = find_field(*kind_, key);
  return field == nullptr ? nullptr : find(*field);
}

const Node* View::find(const Field& field) const {
  const Found found = search(field);
  return found.node != nullptr || found.is_replaced || field.initial.empty() ? found.node : &initial_node(field);
}

std::optional<double> View::number(std::string_view key) const {
  return as_number(find(key));
}
std::optional<std::uint64_t> View::whole(std::string_view key) const {
  return as_whole(find(key));
}
std::optional<Vec3> View::vector(std::string_view key) const {
  return as_vector(find(key));
}
std::optional<Color> View::color(std::string_view key) const {
  return as_color(find(key));
}

std::optional<bool> View::flag(std::string_view key) const {
  return as_flag(find(key));
}

std::optional<std::string> View::text(std::string_view key) const {
  return as_text(find(key));
}

View View::part(std::string_view key, std::string_view name) const {
  const Kind& kind = kind_named(name);
  const Key* at = own_ == nullptr ? nullptr : own_->find_key(key);
  const Node* beneath = kind.beneath.empty() ? nullptr : given(kind.beneath);
  return View(given(key), kind, at == nullptr ? where_ : at->place,
              beneath != nullptr && beneath->is(Node::Kind::map) ? beneath : nullptr);
}

bool View::wants(std::string_view key) const {
  const Node* node = given(key);
  return node != nullptr && (node->is(Node::Kind::map) || as_flag(node).value_or(false));
}

Place View::place(std::string_view key) const {
  const Node* node = given(key);
  return node == nullptr ? where_ : place_of(*node);
}

}  // namespace carom
