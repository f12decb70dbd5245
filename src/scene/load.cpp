// Runs the steps of loading in the order in which a hostile or wrong file can do harm.
// These are bytes, syntax, keys and values, the number of all things, and only then memory for bodies.
// Each step adds its errors, and the next step adds more where it can.
#include "scene/load.h"

#include <fmt/format.h>

#include <new>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/expand.h"
#include "scene/expressions.h"
#include "scene/fields.h"
#include "scene/hollow.h"
#include "scene/member.h"
#include "scene/resolve.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/start.h"
#include "scene/table.h"
#include "std.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace carom {
namespace {

void stop_if_wrong(const Diagnostics& diagnostics, const LoadOptions& options) {
  if (!diagnostics.empty()) throw SceneError(diagnostics, options.color);
}

/// The scene of a run must not be longer than a file that is read.
/// `start`: the key of that name; null: there is none.
void check_length(const Inventory& inventory, const Scene& scene, const Key* start, Diagnostics& diagnostics) {
  if (scene.resolved.size() <= max_source_bytes) return;
  if (scene.made_from.start)
    return diagnostics.add(start->place,
                           fmt::format("with the places of its bodies the scene has {} bytes; the limit is {}",
                                       scene.resolved.size(), max_source_bytes),
                           "expected fewer bodies");

  for (const BodyEntry& body : inventory.bodies)
    if (body.group && body.view.given("members") != nullptr)
      return diagnostics.add(body.view.place("members"),
                             fmt::format("with the balls of {} the scene has {} bytes; the limit is {}",
                                         in_backticks(body.key->text), scene.resolved.size(), max_source_bytes),
                             "expected fewer balls");
  if (inventory.families.empty()) return;

  // The first repeated thing.
  optional<Place> where;
  const auto look = [&](const auto& entries) {
    for (size_t i = 0; i < entries.size() && !where; ++i)
      if (!family_of(entries[i].key->text).empty()) where = entries[i].key->place;
  };
  look(inventory.bodies);
  look(inventory.fixed);
  look(inventory.strings);

  diagnostics.add(
      where.value_or(Place{}),
      fmt::format("with its members the scene has {} bytes; the limit is {}", scene.resolved.size(), max_source_bytes),
      "expected a smaller `repeat`; many balls of one kind are a group: `groups`");
}

string folder_of(const string& path) {
  const size_t slash = path.rfind('/');
  return slash == string::npos ? "" : slash == 0 ? "/" : path.substr(0, slash);
}

}  // namespace

struct SceneFile::Impl {
  Impl(const string& the_path, const LoadOptions& the_options)
      : path(the_path), options(the_options), sources(1), parsing(sources) {
    optional<Node> tree;
    if (read_source(path, sources[0], parsing) && check_text(sources[0], 0, parsing)) {
      tree = parse_document(sources, 0, 0, parsing);
    }

    if (!tree) stop_if_wrong(parsing, options);
    if (!tree->is_map()) {
      parsing.add(tree->place, tree->is_null() ? "this file holds no scene" : "this is not a scene",
                  "expected a map of keys, such as `scene: 1`");
      stop_if_wrong(parsing, options);
    }

    if (tree->find("scene") == nullptr && tree->find("sweep") != nullptr) {
      parsing.add(tree->find_key("sweep")->place, "this is a sweep, not a scene",
                  fmt::format("run it by `carom sweep {}`", path));
      stop_if_wrong(parsing, options);
    }

    root = std::move(*tree);
    write_out(root, kind_named("scene"));
  }

  Scene scene(const vector<Setting>& settings) {
    sources.resize(1);
    for (const string& set : options.set) sources.push_back({"--set " + set, set, true});
    for (const Setting& setting : settings)
      sources.push_back({setting.where.empty() ? "--set " + setting.text : setting.where, setting.text, true});
    Diagnostics diagnostics = parsing;
    Node tree = root;
    for (uint32_t i = 1; i < sources.size(); ++i) {
      apply_setting(tree, sources, i, diagnostics);
      write_out(tree, kind_named("scene"));
    }
    return resolve(tree, diagnostics);
  }

  Scene resolve(Node& tree, Diagnostics& diagnostics) {
    const string folder = folder_of(path);
    Scene scene;

    scene.made_from.expressions = expand(tree, options.seed, options.budget, diagnostics);
    apply_tables(tree, folder, sources, scene.made_from, diagnostics);
    check_scene(tree, folder, diagnostics);
    apply_start(tree, folder, options, scene.made_from, diagnostics);

    scene.file = path;
    const View whole(&tree, kind_named("scene"), Place{});
    scene.title = whole.text("title").value_or("");
    if (const auto look = choice_of(whole, *find_field(whole.kind(), "look"))) scene.look = SceneLook(*look);
    scene.seed = options.seed ? *options.seed : whole.whole("seed").value_or(0);
    scene.roster.empty = empty_families(tree);

    // The world.
    const Inventory inventory = take_inventory(tree, options.budget, diagnostics);
    if (inventory.fits) decode_regions(tree, inventory, scene, diagnostics);
    decode_laws(tree, inventory, scene, diagnostics);
    Forms forms(folder, options, diagnostics);
    decode_fixed(inventory, forms, scene, diagnostics);
    if (inventory.fits) decode_strings(inventory, scene, diagnostics);

    decode_requests(tree, inventory, options, scene, diagnostics);
    if (inventory.fits) decode_stops(tree, inventory, scene, diagnostics);
    if (inventory.fits) decode_bodies(tree, inventory, forms, scene, diagnostics);
    if (inventory.fits) decode_lengths(inventory, scene, diagnostics);
    if (inventory.fits) decode_rest_lengths(tree, inventory, scene, diagnostics);
    if (inventory.fits && diagnostics.empty()) check_hollows(inventory, scene, diagnostics);

    // What needs the bodies.
    decode_camera(tree, inventory, scene, diagnostics);
    if (inventory.fits) decode_overlay(tree, inventory, scene, diagnostics);
    check_engine(tree, scene, diagnostics);
    take_measures(tree, scene, diagnostics);
    if (diagnostics.empty() && options.budget.enforced) check_steps(tree, scene, options.budget, diagnostics);

    stop_if_wrong(diagnostics, options);

    scene.meshes = forms.files(scene.output.video ? scene.output.video->file : "");
    scene.requested = scene.output;
    scene.resolved = resolved_text(tree, inventory, scene, folder);

    check_length(inventory, scene, tree.find_key("start"), diagnostics);
    stop_if_wrong(diagnostics, options);
    return scene;
  }

  /// The things that expand() has left in place because they have no members.
  static vector<EmptyFamily> empty_families(const Node& tree) {
    vector<EmptyFamily> families;
    for (const Field& field : kind_named("scene").fields) {
      const Node* things = field.type == Type::named ? tree.find(field.key) : nullptr;
      if (things == nullptr || !things->is_map() || !find_field(*field.held, "repeat")) continue;
      for (size_t i = 0; i < things->keys.size(); ++i)
        if (things->items[i].is_map() && things->items[i].find_key("repeat") != nullptr)
          families.push_back({field.key, things->keys[i].text});
    }
    return families;
  }

  /// Takes the measures of the file, which name things of the scene. The whole scene must be decoded before.
  void take_measures(const Node& tree, Scene& scene, Diagnostics& diagnostics) const {
    if (const Node* let = tree.find("let"); let != nullptr && let->is_map())
      for (size_t i = 0; i < let->items.size(); ++i)
        if (const auto number = parse_number(let->items[i].text)) scene.measures.numbers[let->keys[i].text] = *number;

    const Node* measures = tree.find("measures");
    if (measures == nullptr || !measures->is_map()) return;
    for (size_t i = 0; i < measures->items.size(); ++i)
      if (!measures->items[i].bad) scene.measures.own.push_back({measures->keys[i].text, measures->items[i].text});

    if (!diagnostics.empty() || !options.measure_fault) return;
    for (size_t i = 0; i < measures->items.size(); ++i) {
      const auto [fault, span] = options.measure_fault(scene, scene.measures.own[i]);

      const size_t remedy = min(fault.find("; "), fault.size());
      const Node& node = measures->items[i];
      if (!fault.empty())
        diagnostics.add(span.length == 0 ? node.place : place_in(node, 0, {span.at, span.length, "", ""}),
                        fault.substr(0, remedy), remedy < fault.size() ? fault.substr(remedy + 2) : string());
    }
  }

  string path;
  LoadOptions options;
  // The file, then one for each setting and each table.
  vector<Source> sources;
  /// Errors of the text after which parsing could continue.
  Diagnostics parsing;
  Node root;
};

namespace {

/// Runs `work`. Running out of memory becomes an error of the scene.
template <typename Work>
auto within_memory(const string& path, const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw SceneError(fmt::format("{}: error: not enough memory for this scene\n   = expected fewer bodies\n", path), 1,
                     {{path, 0, 0, "not enough memory for this scene", "expected fewer bodies", ""}});
  }
}

}  // namespace

SceneFile::SceneFile(const string& path, const LoadOptions& options)
    : impl_(within_memory(path, [&] { return make_unique<Impl>(path, options); })) {}
SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;

Scene SceneFile::scene(const vector<Setting>& settings) {
  return within_memory(impl_->path, [&] { return impl_->scene(settings); });
}

SceneError SceneFile::error(const vector<SceneFault>& faults) const {
  Diagnostics diagnostics(impl_->sources);
  for (const SceneFault& fault : faults) {
    if (fault.place)
      diagnostics.add(*fault.place, fault.fault, fault.remedy);
    else
      diagnostics.add_unplaced(impl_->path, fault.fault, fault.remedy);
  }
  return {diagnostics, impl_->options.color};
}

const string& SceneFile::text() const {
  return impl_->sources.front().text;
}

Scene load_scene(const string& path, const LoadOptions& options) {
  return SceneFile(path, options).scene();
}

}  // namespace carom
