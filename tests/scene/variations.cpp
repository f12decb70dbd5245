#include "scene/variations.h"

#include <fmt/format.h>

#include "scene/fields.h"
#include "std.h"
#include "yaml/value_json.h"

namespace carom {
namespace {

using Json = nlohmann::ordered_json;

/// Values of every type, and those at the edges of ranges; `few`: one of each type.
vector<Json> values_for(const Field& field, bool few) {
  static const Json one_each = json_of_yaml("[~, true, -1, text, [], {}]");
  static const Json many = json_of_yaml(R"([
      ~, true, 0, -0.0, 1, -1, 0.5, 16, 1e300, 18446744073709551615, '', text, '4', Red, '#12g', '#aBc', -a.mp4, "a\nb",
      [], [1], [16, 17], [1, 2, 3], [0, -0.0, 0], [0.1, 0.2, 0.3], [1, 2, x], [1, 2, ~], [1, 2, 3, 4], [-99, 2, 3],
      [0, 3, -5], none, group, [red, floor], [red, red], [fence, floor], [fence], [{}], {}, {zzz: 1}, {mass: 1}, {red: ~}, '= 1', '= x', ['= 1', 2, 3]])");
  vector<Json> values(few ? one_each.begin() : many.begin(), few ? one_each.end() : many.end());
  const bool chosen = field.type == Type::choice || field.type == Type::pixels;
  for (const string_view choice : chosen ? choices(field) : vector<string_view>())
    values.push_back(json_of_yaml(choice));
  if (few) return values;
  values.push_back(json_of_yaml(field.example));
  if (!field.initial.empty()) values.push_back(json_of_yaml(field.initial));

  for (const double edge : {field.range.min, field.range.max}) {
    if (!isfinite(edge)) continue;
    for (const double value : {edge, std::nextafter(edge, -1e9), edge + 1}) values.push_back(number_json(value));
  }
  return values;
}

class Varying {
 public:
  Varying(const string& scene, set<string>& visited) : root_(json_of_yaml(scene)), visited_(visited) {}

  vector<Variation> run() {
    map(root_, kind_named("scene"), "");
    return std::move(found_);
  }

 private:
  void note(const string& what) { found_.push_back({what, root_.dump()}); }

  /// Every change of `value`, undone in the end.
  void replace(Json& value, const Field& field, const string& path, bool few) {
    const Json kept = value;
    for (const Json& other : values_for(field, few)) {
      value = other;
      note(path + " is " + other.dump());
    }
    value = kept;
  }

  void map(Json& node, const Kind& kind, const string& path) {
    const Json kept = node;
    for (const Field& field : kind.fields) {
      const string key(field.key), here = path + key;
      if (kept.contains(key)) {
        const bool is_first = visited_.insert(fmt::format("{}.{}", kind.name, key)).second;
        replace(node[key], field, here, !is_first);
        inside(node[key], field, here);

        // Without it.
        node.erase(key);
        note("no " + here);
        node = kept;
      } else {
        for (const Json& value : {json_of_yaml(field.example), Json(nullptr)}) {
          node[key] = value;
          note(here + " too, " + value.dump());
        }
        node = kept;
      }
    }

    for (const string key : {"zzz", "Mass", "ambient", "mass ", ""}) {
      if (kept.contains(key)) continue;
      node[key] = 1;
      note(path + key + " unknown");
      node = kept;
    }
  }

  void inside(Json& value, const Field& field, const string& path) {
    const Kind* kind = field.held;
    if (kind == nullptr) return;

    const Json kept = value;
    if (field.type == Type::named) {
      for (const auto& [name, entry] : kept.items()) {
        if (kind->also == nullptr || name != kind->also->key) map(value[name], *kind, path + "." + name + ".");

        // By another name, which may be right.
        for (const string wrong : {"7up", "a b", "a.b", "-a", "", "ambient", "really_right-2", "red"}) {
          if (kept.contains(wrong)) continue;
          value.erase(name);
          value[wrong] = entry;
          note(path + ": " + name + " is called '" + wrong + "'");
          value = kept;
        }

        value[name] = nullptr;
        note(path + "." + name + " is null");
        value = kept;
      }
    } else if (field.type == Type::list) {
      for (size_t i = 0; i < kept.size(); ++i)
        if (value[i].is_object()) map(value[i], *kind, fmt::format("{}.{}.", path, i));
    } else if (value.is_object()) {
      map(value, *kind, path + ".");
    }
  }

  Json root_;
  set<string>& visited_;
  vector<Variation> found_;
};

const vector<string> all_right = {
    "{scene: 1, simulate: {duration: 1}, background: gray, output: {video: {file: b.mp4}, tables: csv.gz}}",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}
walls: {fence: {center: [20, 1, 0], normal: [1, 0, 0], size: [1, 1]}}
regions:
  pocket: {radius: 0.3, position: [-6, 0, 0], on: [red], action: remove}
  can: {cylinder: {radius: 0.1, height: 1}, position: [0, 3, 0]}
  crate: {box: [1, 1, 1], position: [3, 3, 0], action: stop}
  below: {plane: {point: [0, -1, 0], normal: [0, -1, 0]}}
simulate: {duration: 1, stop: [rest, {collisions: 100}, {region: pocket}]}
output: {regions: true, trajectory: {every: 0.1, on: [red]}}
)",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.6, position: [0, 9, 0]}}
obstacles: {bowl: {inside: true, radius: 0.9, open: top, position: [50, 0, 0]}}
simulate: {duration: 1, contact: merge}
)",
    R"(
scene: 1
defaults: {string: {restitution: 0.5}}
balls: {text: {mass: 1, radius: 0.1, position: [0, 1, 0]}, fast: {mass: 1, radius: 0.1, position: [2, 8, 0], velocity: [0, 1, 0]}, row: {repeat: 2, mass: 1, radius: 0.1, position: ['= 1 + i', 2, 3]}}
planes: {group: {point: [0, -9, 0], normal: [0, 1, 0]}}
strings:
  bar: {from: text, to: row.0, rod: true}
  moving: {from: [2, 9, 0], to: fast}
  line: {from: [0, 4, 0], to: text, length: 9, restitution: 0.5, visible: false}
  rope: {from: [0, 4, 0], to: text}
  nets: {repeat: 2, from: ['= i', 6, 0], to: 'row.{i}'}
  thread: {from: [2, 9, 0], to: fast, until: {collision: [text, group], after: 0.5}}
  yarn: {from: [2, 9, 0], to: fast, until: 0.5}
  hair: {from: [2, 9, 0], to: fast, until: {collision: fast}}
simulate: {duration: 1}
)",
    R"(
scene: 1
title: Balls
seed: 3
gravity: [0, -1, 0]
let: {r: 0.1, two: 2}
measures: {top: max(balls.red.y_m), twice: "= 2 * top"}
restitution: {default: 0.9, combine: minimum, pairs: [{between: [red, blue], value: 0.5}]}
planes: {floor: {point: [0, -9, 0], normal: [0, 1, 0], motion: [{from: 0.5, until: 1, velocity: [0, 1, 0]}]}}
walls: {fence: {center: [20, 1, 0], normal: [0.1, 0.2, 0.3], up: [0, 1, 0], size: [1, 1], motion: {every: 2, windows: [{from: 0.5, until: 1, velocity: [0, 1, 0]}]}}}
balls:
  red: {mass: 1, radius: 0.1, position: [0, 1, 0], velocity: [1, 0, 0], restitution: 0.5, impulse: [0, 1, 0],
        color: crimson, finish: metal, opacity: 0.5, mesh: {file: box.stl, scale: 0.001, up: z, turn: [30, 0, 0]}}
  blue: {density: 700, radius: 0.1, position: [1, 1, 0], color: {by: speed, min: 1, max: 16, map: magma}}
simulate: {duration: 1, engine: exact, rest_speed: 0.1, max_collisions: 9, contact: {mode: merge, quality: fast}}
look: night
caption: "{title}, {time}, {run}, {collisions}, e = {restitution.default}"
trails: {seconds: 0.5, width: 0.01, on: [red]}
flash: true
arrows: [velocity, force]
labels: {show: [name, speed, momentum], on: [red]}
scale_bar: true
shutter: 0.5
)",
    R"(
scene: 1
defaults: {ball: {mass: 1, radius: 0.1, mesh: box.stl}, body: {density: 2}, obstacle: {color: red}}
balls: {red: {position: [0, 1, 0]}}
bodies:
  can: {cylinder: {radius: 0.1, height: 1}, position: [0, 3, 0], velocity: [0, 1, 0], restitution: 1}
  box: {mass: 1, box: [1, 1, 1], position: [3, 3, 0], impulse: [0, 1, 0], color: tan, finish: glow, opacity: 1}
  bag: {fit: sphere, mesh: box.stl, position: [6, 3, 0]}
  ball: {radius: 0.5, position: [-3, 3, 0]}
obstacles:
  post: {cylinder: {radius: 0.1, height: 1}, position: [0, -3, 0], motion: {windows: [{from: {region: near, after: 0.5}, until: {region: near, after: 1}, velocity: [0, 1, 0]}]}}
  edge: {box: [1, 1, 1], position: [3, -3, 0], visible: false, restitution: 0.5, motion: {sine: {amplitude: [0, 0.1, 0], period: 1, phase: 30}}}
  rock: {fit: box, mesh: box.stl, position: [6, -3, 0], color: tan}
  globe: {radius: 0.5, position: [-3, -3, 0], motion: {circle: {center: [-3, -4, 0], axis: [0, 0, 1], period: 2}}}
regions: {near: {radius: 1, position: [0, 0, 0]}}
simulate: {duration: 1}
)",
    R"(
scene: 1
defaults:
  body: {fit: box, mesh: box.stl, mass: 1}
  plane: {normal: [0, 1, 0]}
  wall: {size: [1, 2], up: [0, 1, 0]}
  obstacle: {radius: 0.1, position: [0, -5, 0]}
  group: {ball: {mass: 1, radius: 0.1}, count: 2}
bodies: {bag: {position: [0, 9, 0]}}
groups:
  gas: {in: {min: [0, 1, 0], max: [2, 2, 2]}, arrange: lattice, speed: 1, count: 3}
  air: {in: {min: [0, 3, 0], max: [2, 4, 2]}, velocity: [1, 0, 0],
        ball: {density: 2, radius: 0.1, velocity: [0, 1, 0], restitution: 1, impulse: [0, 0, 1], color: red, finish: glass, opacity: 0.25, mesh: box.stl}}
  sand: {in: {cylinder: {radius: 1, height: 2}, position: [5, 12, 0]}, ball: {mass: 1, radius: {from: 0.05, to: 0.1}}}
  fog: {in: {radius: 2, position: [12, 12, 0]}}
planes: {floor: {point: [0, 0, 0], restitution: 1, color: tan, finish: plastic, opacity: 1, visible: true}}
walls: {fence: {center: [20, 1, 0], normal: [-1, 0, 0], restitution: 1, color: tan, finish: glass, opacity: 0.5, visible: true}}
obstacles: {post: {color: tan, finish: matte, opacity: 0.5}}
room: {min: [-9, -9, -9], max: [30, 30, 30], restitution: 1, color: tan, finish: matte, opacity: 0.5, visible: false}
simulate: {duration: 1}
)",
    R"(
scene: 1
balls: {former: {mass: 1, radius: 0.1, position: [0, 1, 0]}}
groups:
  gas: {count: 2, ball: {mass: 1, radius: 0.1}, members: [{position: [0, 3, 0], velocity: [1, 0, 0], radius: 0.2, mass: 3}, {position: [1, 3, 0]}]}
  heap: {table: heap.csv, overlap: push, velocity: [1, 0, 0]}
start: {run: first, at: 2}
simulate: {duration: 1}
)",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}
forces:
  - {uniform: [1, 0, 0], on: [red], from: 0.5, until: 0.75}
  - {uniform: [1, 0, 0], on: [red], from: {collision: [red], after: 0.5}, until: {collision: [red, fence], after: 2}}
  - {acceleration: [1, 0, 0]}
  - {drag: {linear: 1, quadratic: 2, wind: [1, 0, 0]}}
  - {spring: {anchor: [0, 2, 0], stiffness: 1, rest_length: 1, damping: 1}, visible: false}
  - {attractor: {center: [0, 2, 0], strength: 1, softening: 1}}
planes: {fence: {point: [0, -9, 0], normal: [0, 1, 0]}}
simulate: {duration: 1, engine: stepped, step: 0.1, integrator: verlet}
)",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}, blue: {mass: 1, radius: 0.1, position: [2, 1, 0]}}
forces:
  - {spring: {from: red, to: blue, stiffness: 1, rest_length: 1, damping: 1}, from: 0.5, until: 0.75, visible: false}
  - {spring: {from: [0, 3, 0], to: blue, stiffness: 1, rest_length: 0}}
  - {gravitation: {constant: 1, softening: 1}, on: [red, blue]}
simulate: {duration: 1}
)",
    R"(
scene: 1
simulate: {duration: 1, tolerance: 0.1, engine: auto, contact: bounce}
defaults: {plane: {color: tan}, wall: {color: tan}, group: {speed: 1}}
planes: {floor: {point: [0, 0, 0], normal: [0, 1, 0]}}
walls: {fence: {center: [20, 1, 0], normal: [-1, 0, 0], size: [1, 1]}}
background: skyblue
camera: {eye: [0, 3, -5], target: [0, 0, 0], up: [0, 1, 0.1], fov: 40, fov_axis: horizontal, near: 1, far: 100}
lights: {sun: {direction: [1, -2, 1], color: white, intensity: 0.5}, lamp: {position: [0, 5, 0]}, ambient: dimgray}
output:
  trajectory: {every: 0.1, layout: wide}
  collisions: true
  energy: {every: 0.1}
  contacts: {every: 0.1}
  frames: {fps: 2, size: [16, 17], samples: 1, from: 0.5, until: 0.75}
  video: {file: b.gif, fps: 4, size: [16, 16], crf: 20, samples: 2, from: 0.25, until: 1, speed: 0.5}
  sheet: {columns: 2, rows: 2, size: [96, 88], from: 0.25, until: 1}
  vtk: {every: 0.1}
  xyz: {every: 0.1}
  gltf: {fps: 2}
  flights: true
  plots: true
  report: true
  tables: {format: xlsx, separator: ";", decimal: ","}
)",
    R"(
scene: 1
balls: {row: {repeat: 2, mass: 1, radius: 0.1, position: ['= i', 0, 0]}}
bodies: {bricks: {repeat: {i: 2, j: 2}, mass: 1, box: [0.2, 0.2, 0.2], position: ['= i', '= 5 + j', 0]}}
groups: {gas: {repeat: 2, count: 2, in: {min: ['= 3 * i', 9, 0], max: ['= 3 * i + 2', 11, 2]}, ball: {mass: 1, radius: 0.1}}}
planes: {sides: {repeat: 2, point: ['= 100 * (1 - 2 * i)', 0, 0], normal: ['= 2 * i - 1', 0, 0]}}
walls: {fences: {repeat: 2, center: ['= -20 - i', 1, 0], normal: [-1, 0, 0], size: [1, 1]}}
obstacles: {posts: {repeat: 2, radius: 0.1, position: ['= i', -5, 0]}}
regions: {holes: {repeat: 2, radius: 0.1, position: ['= i', -8, 0]}}
forces: [{repeat: 2, acceleration: ['= i + 1', 0, 0], on: ['row.{i}']}]
lights: {lamps: {repeat: 2, position: ['= i', 9, 0]}}
simulate: {duration: 1}
)",
    "{scene: 1, simulate: {duration: 1, engine: book, as_printed: true}}",
    "{scene: 1, simulate: {duration: 1}, output: {video: {file: b.mp4, fps: 16, size: square}}}",
    "{scene: 1, title: T, balls: {red: {mass: 1, radius: 1, position: [0, 0, 0]}}, simulate: {duration: 1}, output: "
    "{video: {title: true, beside: x(red), size: 720p}}}",
    "{scene: 1, simulate: {duration: 1}, output: {video: {file: b.mp4, fps: 16, size: square, slow: auto, sound: "
    "true}}}",
    "{scene: 1, simulate: {duration: 1}, camera: {fit: motion, fov: 30}}",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}
planes: {text: {point: [0, 0, 0], normal: [0, 1, 0]}}
simulate: {duration: 1}
camera: {fit: {to: motion, on: [red, text]}, orbit: {period: 2}, projection: orthographic}
)",
    R"(
scene: 1
balls: {red: {mass: 1, radius: 0.1, position: [0, 1, 0]}}
planes: {text: {point: [0, 0, 0], normal: [0, 1, 0]}}
simulate: {duration: 1}
camera: {follow: red, eye: [0, 3, -5], target: [0, 1, 0], near: 0.5}
output: {video: {slow: {around: red}}}
)",
    R"(
scene: 1
simulate: {duration: 1}
camera:
  up: [0, 1, 0.1]
  path: [{at: 0, eye: [0, 3, -5], target: [0, 0, 0]}, {at: 0.5, eye: [5, 3, 0], target: [0, 0, 1], fov: 30}]
)",
    R"(
scene: 1
restitution: {pairs: [{between: [late, late], value: none}]}
balls: {red: {mass: 1, radius: 0.1, position: [0, 9, 0], appear: 0.5}}
bodies: {crate: {mass: 1, box: [1, 1, 1], position: [3, 9, 0], appear: 0.25}}
groups:
  late: {count: 2, appear: 0.5, in: {min: [-9, -9, -9], max: [-5, -5, -5]}, ball: {mass: 1, radius: 0.1}}
  rain: {rate: 3, from: 0.25, until: 0.75, in: {radius: 2, position: [0, -9, 0]}, ball: {mass: 1, radius: 0.1}}
obstacles: {can: {inside: true, box: [1, 1, 1], open: top, position: [50, 0, 0]}}
simulate: {duration: 1}
)"};

}  // namespace

vector<string> right_scenes() {
  return all_right;
}

vector<Variation> vary(const string& scene, set<string>& visited) {
  return Varying(scene, visited).run();
}

}  // namespace carom
