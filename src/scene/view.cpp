// Looks a key up in the layers of a View: own map, defaults, table.
// A layer that holds a rival of the key ends the search, because the rival replaces the key.
#include "scene/view.h"

#include "scene/colors.h"
#include "std.h"
#include "yaml/values.h"

namespace carom {
namespace {

bool usable(const Node* node, Node::Kind kind) {
  return node != nullptr && !node->bad && node->kind == kind;
}

}  // namespace

optional<double> as_number(const Node* node) {
  return usable(node, Node::Kind::scalar) ? parse_number(node->text) : nullopt;
}

optional<uint64_t> as_whole(const Node* node) {
  return usable(node, Node::Kind::scalar) ? parse_whole(node->text) : nullopt;
}

optional<bool> as_flag(const Node* node) {
  return usable(node, Node::Kind::scalar) ? optional(node->text == "true") : nullopt;
}

optional<string> as_text(const Node* node) {
  return usable(node, Node::Kind::scalar) ? optional(node->text) : nullopt;
}

optional<Vec3> as_vector(const Node* node) {
  if (!usable(node, Node::Kind::sequence) || node->items.size() != 3) return nullopt;
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const optional<double> x = as_number(&node->items[size_t(i)]);
    if (!x) return nullopt;
    v[i] = *x;
  }
  return v;
}

optional<Color> as_color(const Node* node) {
  if (const optional<Vec3> v = as_vector(node)) return Color{v->x(), v->y(), v->z()};
  return usable(node, Node::Kind::scalar) ? parse_color(node->text) : nullopt;
}

Place place_of(const Node& node) {
  for (const Node& item : node.items) {
    if (item.place.source > node.place.source) return item.place;
  }
  return node.place;
}

const Node* View::given(string_view key) const {
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
    for (const string_view rival : rivals(field)) {
      const Node* node = layer->find(rival);
      // A rival of the defaults that the own map hides replaces nothing.
      if (node != nullptr && !node->cancels && (layer == own_ || given(rival) != nullptr)) return {nullptr, true};
    }
  }
  return {nullptr, false};
}

const Node* View::find(string_view key) const {
  const Field* field = find_field(*kind_, key);
  return field == nullptr ? nullptr : find(*field);
}

const Node* View::find(const Field& field) const {
  const Found found = search(field);
  return found.node != nullptr || found.is_replaced ? found.node : field.member.initial_node;
}

optional<double> View::number(string_view key) const {
  return as_number(find(key));
}
optional<uint64_t> View::whole(string_view key) const {
  return as_whole(find(key));
}
optional<Vec3> View::vector(string_view key) const {
  return as_vector(find(key));
}
optional<Color> View::color(string_view key) const {
  return as_color(find(key));
}

optional<bool> View::flag(string_view key) const {
  return as_flag(find(key));
}

optional<string> View::text(string_view key) const {
  return as_text(find(key));
}

View View::part(string_view key) const {
  return part(*find_field(*kind_, key));
}

View View::part(const Field& field) const {
  const Key* at = own_ == nullptr ? nullptr : own_->find_key(field.key);
  const Node* beneath = field.held->beneath.empty() ? nullptr : given(field.held->beneath);
  return View(given(field), *field.held, at == nullptr ? where_ : at->place,
              beneath != nullptr && beneath->is_map() ? beneath : nullptr);
}

bool View::wants(string_view key) const {
  const Node* node = given(key);
  return node != nullptr && (node->is_map() || as_flag(node).value_or(false));
}

Place View::place(string_view key) const {
  const Node* node = given(key);
  return node == nullptr ? where_ : place_of(*node);
}

}  // namespace carom
