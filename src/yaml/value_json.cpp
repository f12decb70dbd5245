// A scalar becomes a number, a flag or text by the rules of the scene loader. A general YAML reader would take other
// words for flags.
#include "yaml/value_json.h"

#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/values.h"

namespace carom {

using Json = nlohmann::ordered_json;

Json json_of_text(string_view text) {
  return Json::parse(text, nullptr, false);
}

string text_of_json(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json number_json(double value) {
  constexpr double whole_below = 9007199254740992.0;
  if (floor(value) == value && std::fabs(value) < whole_below) return int64_t(value);
  return value;
}

Json json_of(const Node& node) {
  Json out;
  switch (node.kind) {
    case Node::Kind::null:
      break;
    case Node::Kind::scalar:
      if (!node.quoted && (node.text == "true" || node.text == "false")) return node.text == "true";
      if (const optional<double> number = parse_number(node.text); number && !node.quoted) return number_json(*number);
      return node.text;

    case Node::Kind::sequence:
      out = Json::array();
      for (const Node& item : node.items) out.push_back(json_of(item));
      break;

    case Node::Kind::map:
      out = Json::object();
      for (size_t i = 0; i < node.keys.size(); ++i) out[node.keys[i].text] = json_of(node.items[i]);
      break;
  }
  return out;
}

Json json_of_yaml(string_view yaml) {
  vector<Source> sources(1);
  sources[0].text = yaml;
  Diagnostics diagnostics(sources);
  const optional<Node> node = parse_document(sources, 0, 0, diagnostics);
  return node ? json_of(*node) : Json();
}

string cell_text(string_view yaml) {
  if (yaml.starts_with('+')) {
    const auto number = parse_number(yaml);
    return number ? shortest(*number) : string(yaml);
  }
  if (!yaml.starts_with('"') && !yaml.starts_with('\'')) return string(yaml);
  const Json json = json_of_yaml(yaml);
  return json.is_string() ? json.get<string>() : string(yaml);
}

}  // namespace carom
