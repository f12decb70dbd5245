// The simulators: a random scene made of the bytes, loaded and run.
#include "fuzz/any_scene.h"
#include "fuzz/memory_file.h"
#include "fuzz/simulation.h"
#include "fuzz/targets.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::fuzz {

namespace {

constexpr double patience = 60;  // s of CPU time, with sanitizers

}  // namespace

void simulate_bytes(string_view bytes) {
  const AnyScene made = make_any_scene(1, bytes);
  const MemoryFile file(made.yaml());
  unique_ptr<Scene> scene;
  try {
    scene = make_unique<Scene>(load_scene(file.path()));
  } catch (const SceneError&) {
    return;  // bodies that overlap, an engine that lacks something
  }
  string text;
  for (const string& violation : simulate(*scene, patience).violations) text += violation + "\n";
  if (!text.empty()) throw Finding(text + "---8<---\n" + made.yaml() + "--->8---");
}

vector<string> simulator_seeds() {
  vector<string> seeds;
  for (unsigned kind = 0; kind < 39; ++kind) {
    string bytes(1, static_cast<char>(kind));
    for (unsigned k = 0; k < 200; ++k) bytes += static_cast<char>((kind * 7919 + k * k * 104729) >> 7);
    seeds.push_back(bytes);
  }
  return seeds;
}

}  // namespace carom::fuzz
