// The scene loader, the sweep loader, --set.

#include "fuzz/memory_file.h"
#include "fuzz/targets.h"
#include "paths.h"
#include "physics/world.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "scene/sweep.h"
#include "std.h"
#include "yaml/letters.h"
#include "yaml/source.h"

namespace carom::fuzz {

namespace {

constexpr size_t longest_seed = 8000;  // bytes; of longer ones an input would have only the beginning

LoadOptions options() {
  LoadOptions options;
  options.budget.bodies = 300;  // groups are laid out one by one
  options.mesh_points = [](const string&) { return vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}; };
  return options;
}

/// The text of an error is whole: valid UTF-8, without bytes that control a terminal, with the right count.
void hold(const SceneError& error) {
  const string text = error.what();
  if (text.empty() || error.count == 0) throw Finding("an error without a text");
  for (size_t i = 0; i < text.size();) {
    char32_t code = 0;
    const int length = utf8_length(text, i, code);
    if (length == 0) throw Finding("an error's text is not UTF-8: " + text);
    if (code != '\n' && (code < ' ' || (code >= 0x7F && code < 0xA0)))
      throw Finding("an error's text has a control character: " + text);
    i += static_cast<size_t>(length);
  }
}

bool all_finite(const vector<Vec3>& vectors) {
  return all_of(vectors, [](const Vec3& v) { return v.allFinite(); });
}

/// The guarantees of a loaded scene.
void hold(const Scene& scene) {
  const World& world = scene.world;
  const size_t n = world.body_count();
  if (world.radius.size() != n || world.restitution.size() != n || scene.initial.position.size() != n ||
      scene.initial.velocity.size() != n || (!world.volume.empty() && world.volume.size() != n) ||
      (!world.impulse.empty() && world.impulse.size() != n))
    throw Finding("arrays by body differ in length");

  const auto positive = [](double x) { return x > 0 && isfinite(x); };
  if (!all_of(world.mass, positive)) throw Finding("a mass is not above 0");
  if (!all_of(world.radius, positive)) throw Finding("a radius is not above 0");
  if (!all_finite(scene.initial.position) || !all_finite(scene.initial.velocity) || !all_finite(world.impulse))
    throw Finding("a body starts nowhere");
  if (!(scene.simulate.duration >= 0) || !isfinite(scene.simulate.duration)) throw Finding("no duration");
}

/// The resolved text loads, and resolves to itself.
void hold_resolved(const Scene& scene) {
  hold(scene);
  const MemoryFile again(scene.resolved);
  string text;
  try {
    text = load_scene(again.path(), options()).resolved;
  } catch (const SceneError& error) {
    throw Finding("the resolved scene does not load: " + string(error.what()) + "\n" + scene.resolved);
  }
  if (text != scene.resolved) throw Finding("the resolved scene is another:\n" + scene.resolved + "---\n" + text);
}

/// Texts in quotes R"( )" in the tests' sources that have this word.
void add_texts_of_tests(const string& word, vector<string>& seeds) {
  for (const string& path : files_below(SOURCE_DIR "/tests", ".cpp")) {
    const string source = bytes_of(path);
    for (size_t at = 0; (at = source.find("R\"(", at)) != string::npos;) {
      const size_t end = source.find(")\"", at += 3);
      if (end == string::npos) break;
      string text = source.substr(at, end - at);
      if (text.find(word) != string::npos && text.size() < longest_seed) seeds.push_back(std::move(text));
    }
  }
}

}  // namespace

void load_scene_bytes(string_view bytes) {
  const MemoryFile file(bytes);
  try {
    hold_resolved(load_scene(file.path(), options()));
  } catch (const SceneError& error) {
    hold(error);
  }
}

vector<string> scene_seeds() {
  vector<string> seeds;
  for (const string& path : files_below(SOURCE_DIR "/scenes", ".yaml"))
    if (string text = bytes_of(path); text.size() < longest_seed) seeds.push_back(std::move(text));
  add_texts_of_tests("scene: 1", seeds);

  seeds.emplace_back(R"(scene: 1
let: {n: 3, r: 0.1, gap: '= r / 10'}
defaults: {ball: {mass: = 2 * r, radius: = r, color: red}}
balls:
  row: {repeat: = n, position: ['= i * (2 * r + gap)', '= sin(30) ^ 2', 0], color: none}
  grid: {repeat: {i: 2, j: = n}, position: ['= i', '= 3 + j % 2', '= min(j, 5)'], velocity: [= -r, 0, 0]}
groups: {gas: {repeat: 2, count: 3, in: {min: [= 9 * i, 9, 0], max: [= 9 * i + 3, 12, 3]}, ball: {mass: 1}}}
planes: {sides: {repeat: 2, point: [= 100 - 200 * i, 0, 0], normal: [= 2 * i - 1, 0, 0]}, none: {repeat: 0, point: [= i, 0, 0], normal: [0, 1, 0]}}
forces: [{repeat: = n, spring: {anchor: [= i, 1, 0], stiffness: 1}, on: ['row.{i}']}, {drag: {linear: = gap}, on: [row, gas.1.2]}]
restitution: = 1 / 2
camera: {follow: row}
simulate: {duration: 1}
)");

  return seeds;
}

void load_sweep_bytes(string_view bytes) {
  const MemoryFile file(bytes);
  try {
    const Sweep sweep = load_sweep(file.path());
    if (sweep.size() == 0) throw Finding("a sweep without runs");
    for (const size_t k : {size_t{0}, sweep.size() / 2, sweep.size() - 1})
      if (sweep.run(k).values.size() != sweep.paths.size()) throw Finding("a run has values of other paths");

    const string resolved = sweep.resolved("base.yaml");
    const MemoryFile again(resolved);
    const Sweep same = load_sweep(again.path());
    if (same.size() != sweep.size()) throw Finding("the resolved sweep has other runs:\n" + resolved);
    if (same.resolved("base.yaml") != resolved) throw Finding("the resolved sweep is another:\n" + resolved);
  } catch (const SceneError& error) {
    hold(error);
  }
}

vector<string> sweep_seeds() {
  vector<string> seeds;
  for (const string& path : files_below(SOURCE_DIR "/scenes", ".yaml"))
    if (string text = bytes_of(path); text.find("\nsweep: 1") != string::npos) seeds.push_back(std::move(text));
  add_texts_of_tests("sweep: 1", seeds);
  return seeds;
}

void apply_settings_bytes(string_view bytes) {
  static const MemoryFile base(R"(scene: 1
let: {r: 0.1, n: 2}
bodies: {row: {repeat: = n, mass: 1, radius: = r, position: [= 10 + i, 0, 0]}}
defaults: {ball: {mass: 1, radius: 0.1}}
balls: {red: {position: [0, 1, 0]}, blue: {position: [1, 1, 0], velocity: [-1, 0, 0]}}
groups: {gas: {count: 3, ball: {mass: 1, radius: 0.1}, in: {min: [2, 0, 0], max: [4, 2, 2]}, speed: 1}}
planes: {floor: {point: [0, -1, 0], normal: [0, 1, 0]}}
forces: [{uniform: [1, 0, 0], on: [red]}, {drag: {linear: 0.1}}]
camera: {eye: [0, 1, 5], target: [0, 0, 0]}
lights: {sun: {direction: [0, -1, 0]}}
simulate: {duration: 1}
output: {trajectory: {every: 0.1}, energy: {every: 0.1}}
)");

  static SceneFile scene(base.path(), options());
  vector<Setting> settings;
  for (size_t at = 0; at <= bytes.size() && settings.size() < 4;) {
    const size_t end = std::min(bytes.find('\n', at), bytes.size());
    settings.push_back({string(bytes.substr(at, end - at)), settings.size() % 2 == 0 ? "" : "sweep.yaml:7:3"});
    at = end + 1;
  }

  try {
    hold_resolved(scene.scene(settings));
  } catch (const SceneError& error) {
    hold(error);
  }
}

vector<string> settings_seeds() {
  return {
      "balls.red.mass=2", "defaults.ball.restitution=0.5\nsimulate.duration=2",
      "balls.red.position=[0, 2, 0]\nballs.blue.velocity.x=3", "groups.gas.count=5\ngroups.gas.in.max=[9, 9, 9]",
      "forces.0.uniform.y=2\nforces.1.drag={quadratic: 1}",
      // Of outputs and cameras.
      "output.video={fps: 30, size: [64, 48]}\ncamera.eye.z=9", "camera.fit=motion\ncamera.fov=30",
      "camera={follow: gas.1}\ncamera.eye=[0, 1, 9]",
      "camera.path=[{at: 0, eye: [0, 1, 5], target: [0, 0, 0]}, {at: 1, eye: [5, 1, 0], target: [0, 0, 0], fov: 9}]",
      // Of the whole.
      "balls.red.density=1000", "simulate={duration: 1, engine: stepped, integrator: verlet, step: 0.01}",
      "restitution={combine: minimum}\nrestitution.pairs=[{between: [red, blue], value: 0.5}]",
      "title=\"a = b\"\nlights.sun.color=red", "let.r=0.2\nlet.n== 2 + 3",
      "bodies.row.repeat={i: 2, j: 3}\nbodies.row.position='[= j, = i, 0]'",
      "balls.red.mass== 2 * r\nballs.red.velocity=[= r, 0, 0]"};
}

}  // namespace carom::fuzz
