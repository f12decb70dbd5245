#include "scene/member.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/value_json.h"
#include "yaml/values.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

template <typename T>
bool put(const optional<T>& found, T& value) {
  if (found) value = *found;
  return found.has_value();
}

}  // namespace

bool take(const View& view, const Field& field, double& value) {
  return put(as_number(view.find(field)), value);
}

bool take(const View& view, const Field& field, uint64_t& value) {
  return put(as_whole(view.find(field)), value);
}

bool take(const View& view, const Field& field, int& value) {
  const optional<uint64_t> whole = as_whole(view.find(field));
  if (whole) value = int(min<uint64_t>(*whole, 1 << 30));
  return whole.has_value();
}

bool take(const View& view, const Field& field, bool& value) {
  if (field.type == Type::flag) return put(as_flag(view.find(field)), value);
  const optional<size_t> choice = choice_of(view, field);
  if (choice) value = *choice == 1;
  return choice.has_value();
}

bool take(const View& view, const Field& field, string& value) {
  return put(as_text(view.find(field)), value);
}

bool take(const View& view, const Field& field, Vec3& value) {
  return put(as_vector(view.find(field)), value);
}

bool take(const View& view, const Field& field, Size& value) {
  const Node* node = view.find(field);
  if (const optional<string> name = as_text(node)) return put(size_named(*name), value);
  if (node == nullptr || node->bad || node->items.size() != 2) return false;
  const optional<uint64_t> width = as_whole(&node->items[0]), height = as_whole(&node->items[1]);
  if (!width || !height) return false;
  value = {int(min<uint64_t>(*width, 1 << 30)), int(min<uint64_t>(*height, 1 << 30))};
  return true;
}

bool take(const View& view, const Field& field, Rectangle& value) {
  const Node* node = view.find(field);
  if (node == nullptr || node->bad || node->items.size() != 2) return false;
  const optional<double> width = as_number(&node->items[0]), height = as_number(&node->items[1]);
  return put(width, value.width) && put(height, value.height);
}

bool take(const View& view, const Field& field, const Node*& value) {
  value = view.given(field);
  return value != nullptr;
}

bool take(const View& view, const Field& field, vector<string>& value) {
  const Node* node = view.find(field);
  if (node == nullptr || node->bad) return false;
  value.clear();
  for (const Node& item : node->items) value.push_back(item.text);
  return true;
}

bool take(const View& view, const Field& field, Color& value) {
  return put(as_color(view.find(field)), value);
}

bool take(const View& view, const Field& field, BodyColor& value) {
  const Node* node = view.find(field);
  if (node == nullptr || !node->is_map()) return put(as_color(node), value.plain);
  if (!node->bad) value.by = filled<Coloring>(view.part(field));
  return !node->bad;
}

optional<size_t> choice_of(const View& view, const Field& field) {
  const optional<string> text = as_text(view.find(field));
  const vector<string_view> all = choices(field);
  const auto at = text ? ranges::find(all, *text) : all.end();
  return at == all.end() ? nullopt : optional(size_t(at - all.begin()));
}

Json json_value(const Field& field, bool value) {
  return field.type == Type::flag ? Json(value) : Json(string(choices(field)[value ? 1 : 0]));
}

Json json_value(const Field&, const Vec3& value) {
  return Json::array({value.x(), value.y(), value.z()});
}

Json json_value(const Field&, const Size& value) {
  return Json::array({value.width, value.height});
}

Json json_value(const Field&, const Rectangle& value) {
  return Json::array({value.width, value.height});
}

Json json_value(const Field&, const Node* value) {
  return value != nullptr ? json_of(*value) : Json();
}

Json json_value(const Field&, const vector<string>& value) {
  return value.empty() ? Json() : Json(value);
}

Json json_value(const Field&, const Color& value) {
  return Json::array({value.r, value.g, value.b});
}

Json json_value(const Field& field, const BodyColor& value) {
  return value.by ? json_of(*field.held, &*value.by) : json_value(field, value.plain);
}

string yaml_of(double value) {
  return shortest(value);
}

string yaml_of(const Vec3& value) {
  return fmt::format("[{}, {}, {}]", shortest(value.x()), shortest(value.y()), shortest(value.z()));
}

string yaml_of(const Color& value) {
  for (const string_view name : color_names())
    if (*parse_color(name) == value) return string(name);
  return fmt::format("[{}, {}, {}]", shortest(value.r), shortest(value.g), shortest(value.b));
}

void fill(void* settings, const View& view) {
  for (const Field& field : view.kind().fields)
    if (field.member.fill != nullptr) field.member.fill(settings, view, field);
}

Json json_of(const Kind& kind, const void* settings) {
  Json json = Json::object();
  for (const Field& field : kind.fields)
    if (field.member.json != nullptr) json[string(field.key)] = field.member.json(settings, field);
  return json;
}

}  // namespace carom
