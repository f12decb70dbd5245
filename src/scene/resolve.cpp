// Writes the resolved scene from the views of the tree, not from the decoded Scene.
// Numbers thus keep the digits of the author, and a second resolution gives the same text.
// Only values that decoding chooses (colours, steps, directions, names of copies) override the views.
#include "scene/resolve.h"

#include <fmt/format.h>

#include <filesystem>

#include "scene/check.h"
#include "scene/colors.h"
#include "scene/engines.h"
#include "scene/fields.h"
#include "scene/member.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/letters.h"
#include "yaml/values.h"

namespace carom {
namespace {

/// Whether readers of YAML 1.1 take a plain word for a flag, or for nothing.
bool is_word_elsewhere(string_view text) {
  const string word = in_lower_case(text);
  const auto words = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"};
  return ranges::any_of(words, [&](string_view one) { return one == word; });
}

string vector_text(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", number_text(shortest(v.x())), number_text(shortest(v.y())),
                     number_text(shortest(v.z())));
}

/// Texts that replace the values of a View, by key. An empty text leaves the key out.
using Overrides = map<string_view, string>;

string flow(const View& view, const Overrides& overrides = {}) {
  string out;
  for (const Field& field : view.kind().fields) {
    string text;
    if (const auto it = overrides.find(field.key); it != overrides.end()) {
      text = it->second;
    } else if (const Node* node = view.find(field.key)) {
      text = flow_text(*node);
    }

    if (text.empty()) continue;
    if (!out.empty()) out += ", ";
    out += fmt::format("{}: {}", key_text(field.key), text);
  }

  return "{" + out + "}";
}

class Resolver {
 public:
  Resolver(const Node& root, const Inventory& inventory, const Scene& scene, const string& folder)
      : root_(root), inventory_(inventory), scene_(scene), folder_(folder) {}

  string run() {
    const Kind& kind = kind_named("scene");
    const View whole(&root_, kind, Place{});

    line("scene", "1");
    line("title", flow_text(*whole.find("title")));
    line("seed", to_string(scene_.seed));
    if (const Node* let = root_.find("let"); let != nullptr && !let->items.empty()) line("let", flow_text(*let));
    line("gravity", flow_text(*whole.find("gravity")));
    line("restitution", flow(scene_part(root_, "restitution")));
    // The order of these keys in the file is the order of the bodies and of the planes.
    for (const Key& key : root_.keys) {
      if (key.text == "balls") bodies("balls", "ball");
      if (key.text == "bodies") bodies("bodies", "body");
      if (key.text == "groups") bodies("groups", "group");
      if (key.text == "planes") fixed("planes", "plane");
      if (key.text == "room") room();
      if (key.text == "walls") fixed("walls", "wall");
      if (key.text == "obstacles") fixed("obstacles", "obstacle");
    }

    strings();
    regions();
    forces();
    simulate();
    if (const Node* measures = root_.find("measures"); measures != nullptr && !measures->items.empty())
      line("measures", flow_text(*measures));

    // What pictures show, and the outputs.
    camera();
    look();
    lights();
    if (const Node* background = root_.find("background")) line("background", flow_text(*background));
    overlay();
    output();
    return std::move(out_);
  }

 private:
  void line(string_view key, string_view text) { out_ += fmt::format("{}: {}\n", key_text(key), text); }
  void entry(string_view key, string_view text) { out_ += fmt::format("  {}: {}\n", key_text(key), text); }

  /// Writes `key:` for entries to follow, or `key: {}`.
  void heading(string_view key, bool empty) {
    out_ += empty ? fmt::format("{}: {{}}\n", key) : fmt::format("{}:\n", key);
  }

  string default_restitution() const { return flow_text(*scene_part(root_, "restitution").find("default")); }

  /// Writes the colour that was chosen. With one, a mesh would not have the colours of its file.
  static void add_color(const View& view, const Color& chosen, const optional<MeshUse>& mesh, Overrides& overrides) {
    if (view.find("color") == nullptr && !mesh) overrides["color"] = in_quotes(hex_text(chosen));
  }

  /// Sets the key `mesh` to the copy in the run's folder, or to the absolute path of a file without a copy.
  void name_copy(const View& view, const optional<MeshUse>& mesh, Overrides& overrides) const {
    for (const MeshFile& file : scene_.meshes) {
      if (!mesh || mesh->file != file.file) continue;
      const string name = file.copy.empty() ? std::filesystem::absolute(file.file).string() : file.copy;
      overrides["mesh"] = mesh_text(view, in_quotes(name));
    }
  }

  /// The value of `mesh` with another file, in quotes.
  static string mesh_text(const View& view, const string& file) {
    return view.find("mesh")->is_map() ? flow(view.part("mesh"), {{"file", file}}) : file;
  }

  void bodies(string_view key, string_view kind) {
    heading(key, root_.find(key)->items.empty());
    for (size_t i = 0; i < inventory_.bodies.size(); ++i) {
      const BodyEntry& body = inventory_.bodies[i];
      if (body.view.kind().name != kind) continue;

      Overrides overrides;
      const View &view = body.view, &each = body.each;

      if (each.find("restitution") == nullptr) overrides["restitution"] = default_restitution();
      add_color(each, scene_.roster.bodies[i].color, scene_.roster.bodies[i].mesh, overrides);
      name_copy(each, scene_.roster.bodies[i].mesh, overrides);

      if (!body.group) {
        entry(body.key->text, flow(each, overrides));
        continue;
      }

      const bool lists_members = view.find("members") != nullptr;
      // A group's velocity is written once, in the group.
      if (!lists_members) overrides["velocity"] = "";
      Overrides group_overrides{{"ball", flow(each, overrides)}};
      if (!lists_members) group_overrides["in"] = flow(view.part("in"));
      if (!lists_members && view.find("speed") == nullptr && view.find("velocity") == nullptr)
        group_overrides["velocity"] = flow_text(*each.find("velocity"));

      entry(body.key->text, flow(view, group_overrides));
    }
    without_members(key, kind);
  }

  /// Writes the things of a map that are repeated no time. Their own expressions have no numbers, and stay.
  void without_members(string_view key, string_view name) {
    const Node& map = *root_.find(key);
    const Kind& kind = kind_named(name);
    for (size_t i = 0; i < map.keys.size(); ++i) {
      if (map.items[i].find_key("repeat") == nullptr) continue;
      const View view = thing_view(root_, map.keys[i], map.items[i], kind);

      Overrides overrides = whole_paths(view);
      if (name == "group") {
        const View each = member_view(root_, view);
        overrides["ball"] = flow(each, whole_paths(each));
        if (view.find("members") == nullptr) overrides["in"] = flow(view.part("in"));
      }

      entry(map.keys[i].text, flow(view, overrides));
    }
  }

  /// The files of a map that is not decoded, as absolute paths.
  Overrides whole_paths(const View& view) const {
    Overrides overrides;
    for (const Field& field : view.kind().fields) {
      const bool is_file = field.type == Type::file, is_mesh = field.type == Type::file_or_part;
      const Node* file = is_file || is_mesh ? view.find(field) : nullptr;
      if (file != nullptr && file->is_map()) file = file->find("file");
      if (file == nullptr) continue;
      const string name = in_quotes(std::filesystem::absolute(beneath(folder_, file->text)).string());
      overrides[field.key] = is_mesh ? mesh_text(view, name) : name;
    }
    return overrides;
  }

  void fixed(string_view key, string_view kind) {
    heading(key, root_.find(key)->items.empty());
    for (const FixedEntry& thing : inventory_.fixed) {
      if (thing.view.kind().name == kind) entry(thing.key->text, fixed_text(thing));
    }
    without_members(key, kind);
  }

  string fixed_text(const FixedEntry& thing) const {
    const View& view = thing.view;
    const FixedLook& known = scene_.roster.fixed[thing.first];
    Overrides overrides;
    add_color(view, known.color, known.mesh, overrides);
    if (view.kind().name == "wall" && view.find("up") == nullptr)
      overrides["up"] = vector_text(default_up(scene_.world.wall(inventory_.body_count + thing.first).normal));
    name_copy(view, known.mesh, overrides);

    // Windows that do not repeat are a list.
    const Node* const motion = view.find("motion");
    if (motion != nullptr && motion->keys.size() == 1 && motion->keys[0].text == "windows")
      overrides["motion"] = flow_text(motion->items[0]);
    return flow(view, overrides);
  }

  void strings() {
    if (root_.find("strings") == nullptr) return;
    heading("strings", root_.find("strings")->items.empty());
    for (size_t i = 0; i < inventory_.strings.size(); ++i) {
      const View& view = inventory_.strings[i].view;
      Overrides overrides;
      if (view.find("length") == nullptr) overrides["length"] = number_text(shortest(scene_.world.strings[i].length));
      entry(inventory_.strings[i].key->text, flow(view, overrides));
    }
    without_members("strings", "string");
  }

  void regions() {
    const Node* node = root_.find("regions");
    if (node == nullptr) return;
    heading("regions", node->items.empty());
    for (size_t i = 0; i < node->keys.size(); ++i)
      entry(node->keys[i].text, flow(View(&node->items[i], kind_named("region"), Place{})));
  }

  void forces() {
    const Node* node = root_.find("forces");
    if (node == nullptr) return;
    if (node->items.empty()) return line("forces", "[]");
    heading("forces", false);
    for (const Node& item : node->items) {
      if (item.find_key("repeat") != nullptr) {
        out_ += fmt::format("  - {}\n", flow_text(item));
        continue;
      }
      out_ += fmt::format("  - {}\n", flow(View(&item, kind_named("force"), item.place)));
    }
  }

  void room() {
    for (const FixedEntry& thing : inventory_.fixed)
      if (thing.view.kind().name == "room") line("room", fixed_text(thing));
  }

  void simulate() {
    const View view = scene_part(root_, "simulate");
    Overrides overrides;
    if (scene_.simulate.engine == Engine::book && view.find("step") == nullptr)
      overrides["step"] = number_text(shortest(*scene_.simulate.step));
    overrides["contact"] = flow(view.part("contact"));
    line("simulate", flow(view, overrides));
  }

  void camera() {
    if (root_.find("camera") == nullptr) return;
    Overrides overrides;
    // Near and far follow from the bodies' size and motion, as the eye does.
    const auto& follow = scene_.camera->follow;
    if (scene_.camera->fit || (follow && !follow->has_eye)) overrides = {{"near", ""}, {"far", ""}};
    const View view = scene_part(root_, "camera");
    for (const char* const part : {"fit", "orbit"})
      if (view.given(part) != nullptr) overrides[part] = flow(view.part(part));
    line("camera", flow(view, overrides));
  }

  void look() {
    if (const Node* const node = root_.find("look"); node != nullptr) line("look", flow_text(*node));
  }

  void lights() {
    const Node* node = root_.find("lights");
    if (node == nullptr) return;
    heading("lights", node->items.empty());
    for (size_t i = 0; i < node->keys.size(); ++i) {
      if (node->items[i].find_key("repeat") != nullptr) continue;
      const bool ambient = node->keys[i].text == "ambient";
      entry(node->keys[i].text,
            ambient ? flow_text(node->items[i]) : flow(View(&node->items[i], kind_named("light"), Place{})));
    }
    without_members("lights", "light");
  }

  void overlay() {
    const Overlay& overlay = scene_.overlay;
    const View whole(&root_, kind_named("scene"), Place{});
    if (!overlay.caption.empty()) line("caption", in_quotes(overlay.caption));
    if (overlay.trails) line("trails", flow(whole.part("trails")));
    if (overlay.flash) line("flash", "true");
    if (const Node* arrows = root_.find("arrows")) line("arrows", flow_text(*arrows));
    if (overlay.labels) line("labels", flow(whole.part("labels")));
    if (overlay.scale_bar) line("scale_bar", "true");
    if (const Node* shutter = root_.find("shutter")) line("shutter", flow_text(*shutter));
  }

  void output() {
    const View view(root_.find("output"), kind_named("output"), Place{});
    heading("output", false);
    for (const OutputKind& kind : output_kinds()) {
      if (!kind.keys.empty() && kind.asked(scene_.output)) entry(kind.name, output_text(view, kind));
      if (kind.keys.empty() && is_said(kind)) entry(kind.name, kind.asked(scene_.output) ? "true" : "false");
    }
    if (scene_.output.tables != TablesOutput{}) entry("tables", flow(view.part("tables")));
  }

  /// Whether the text of a scene has this flag. `plots`, `report` and `regions` are absent unless they are true,
  /// as an output with settings is.
  bool is_said(const OutputKind& kind) const {
    if (kind.name == "flights") return flights_matter();
    return (kind.name != "plots" && kind.name != "report" && kind.name != "regions") || kind.asked(scene_.output);
  }

  string output_text(const View& view, const OutputKind& kind) const {
    const View part = view.part(kind.name);
    Overrides overrides;
    // Decoding may give a GIF another rate than that of frames.
    if (kind.name == "video" && part.number("fps") != scene_.output.video->fps)
      overrides["fps"] = number_text(shortest(scene_.output.video->fps));
    return flow(part, overrides);
  }

  /// Whether flights are possible and their default could differ.
  bool flights_matter() const {
    return goes_along_parabolas(scene_.world, scene_.simulate) && (scene_.output.pictures() || scene_.output.flights);
  }

  const Node& root_;
  const Inventory& inventory_;
  const Scene& scene_;
  const string& folder_;  // of the scene file
  string out_;
};

}  // namespace

string in_quotes(string_view text) {
  string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

string number_text(string_view number) {
  string text(number);
  if (const size_t point = text.find_first_not_of("+-"); text.substr(min(point, text.size())).starts_with('.'))
    text.insert(point, "0");
  const size_t power = text.find_first_of("eE");
  if (power == string::npos) return text;
  if (text[power + 1] != '-' && text[power + 1] != '+') text.insert(power + 1, "+");
  if (text.find('.') == string::npos) text.insert(power, ".0");
  return text;
}

string key_text(string_view key) {
  return is_word_elsewhere(key) ? in_quotes(key) : string(key);
}

string flow_text(const Node& node) {
  if (node.is_scalar()) {
    if (!node.quoted && parse_number(node.text)) return number_text(node.text);
    const bool is_flag = node.text == "true" || node.text == "false";
    const bool plain = !node.quoted && is_name(node.text) && (is_flag || !is_word_elsewhere(node.text));
    return plain ? node.text : in_quotes(node.text);
  }

  string out;
  for (size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) out += ", ";
    if (node.is_map()) out += key_text(node.keys[i].text) + ": ";
    out += flow_text(node.items[i]);
  }
  return node.is_map() ? "{" + out + "}" : "[" + out + "]";
}

string resolved_text(const Node& root, const Inventory& inventory, const Scene& scene, const string& folder) {
  return Resolver(root, inventory, scene, folder).run();
}

}  // namespace carom
