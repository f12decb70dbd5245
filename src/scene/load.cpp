// The order of the steps is the order in which a hostile or mistaken file can do harm: bytes, syntax, keys and values,
// how many of everything, and only then memory for bodies. Every step adds its errors and lets the next one add more.
#include "scene/load.h"

#include <fmt/format.h>

#include <new>

#include "scene/check.h"
#include "scene/decode.h"
#include "scene/document.h"
#include "scene/resolve.h"
#include "scene/settings.h"

namespace carom {
namespace {

void stop_if_wrong(const Diagnostics& diagnostics, const LoadOptions& options) {
  if (!diagnostics.empty()) throw SceneError(diagnostics.text(options.color), diagnostics.count());
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : slash == 0 ? "/" : path.substr(0, slash);
}

Scene load(const std::string& path, const LoadOptions& options) {
  std::vector<Source> sources(1 + options.set.size());
  Diagnostics diagnostics(sources);
  for (std::size_t i = 0; i < options.set.size(); ++i)
    sources[i + 1] = {"--set " + options.set[i], options.set[i], true};

  std::optional<Node> root;
  if (read_source(path, sources[0], diagnostics) && check_text(sources[0], 0, diagnostics)) {
    root = parse_document(sources, 0, 0, diagnostics);
  }
  if (!root) stop_if_wrong(diagnostics, options);
  if (!root->is(Node::Kind::map)) {
    diagnostics.add(root->place, root->is(Node::Kind::null) ? "this file holds no scene" : "this is not a scene",
                    "expected a map of keys, such as `scene: 1`");
    stop_if_wrong(diagnostics, options);
  }
  for (std::uint32_t i = 1; i < sources.size(); ++i) apply_setting(*root, sources, i, diagnostics);
  check_scene(*root, folder_of(path), diagnostics);

  Scene scene;
  scene.file = path;
  const View whole(&*root, kind_named("scene"), Place{});
  scene.title = whole.text("title").value_or("");
  scene.seed = options.seed ? *options.seed : whole.whole("seed").value_or(0);
  const Inventory inventory = take_inventory(*root, options.budget, diagnostics);
  decode_laws(*root, inventory, scene, diagnostics);
  Forms forms(folder_of(path), options, diagnostics);
  decode_fixed(*root, inventory, forms, scene, diagnostics);
  decode_requests(*root, inventory, options.budget, scene, diagnostics);
  if (inventory.fits) decode_bodies(*root, inventory, forms, scene, diagnostics);
  check_engine(*root, scene, diagnostics);
  stop_if_wrong(diagnostics, options);
  scene.meshes = forms.files(scene.output.video ? scene.output.video->file : "");
  scene.resolved = resolved_text(*root, inventory, scene);
  return scene;
}

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
  try {
    return load(path, options);
  } catch (const std::bad_alloc&) {
    throw SceneError(fmt::format("{}: error: not enough memory for this scene\n   = expected fewer bodies\n", path), 1);
  }
}

}  // namespace carom
