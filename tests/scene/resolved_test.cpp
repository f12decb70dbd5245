// Scene::resolved: a complete scene with the same meaning.
#include "physics/world.h"
#include "scene/scene.h"
#include "scene/scenes_in_text.h"
#include "std.h"

namespace carom {
namespace {

void expect_same_things(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.world.mass, b.world.mass);
  EXPECT_EQ(a.world.radius, b.world.radius);
  EXPECT_EQ(a.world.restitution, b.world.restitution);
  EXPECT_EQ(a.world.impulse, b.world.impulse);
  EXPECT_EQ(a.world.gravity, b.world.gravity);
  EXPECT_EQ(a.world.combine, b.world.combine);

  ASSERT_EQ(a.world.planes.size(), b.world.planes.size());
  for (size_t i = 0; i < a.world.planes.size(); ++i) {
    EXPECT_EQ(a.world.planes[i].point, b.world.planes[i].point);
    EXPECT_EQ(a.world.planes[i].normal, b.world.planes[i].normal);
    EXPECT_EQ(a.world.planes[i].restitution, b.world.planes[i].restitution);
  }

  ASSERT_EQ(a.world.walls.size(), b.world.walls.size());
  for (size_t i = 0; i < a.world.walls.size(); ++i) {
    const Wall &v = a.world.walls[i], &w = b.world.walls[i];
    EXPECT_EQ(v.center, w.center);
    EXPECT_EQ(v.normal, w.normal);
    EXPECT_EQ(v.right, w.right);
    EXPECT_EQ(v.up, w.up);
    EXPECT_EQ(v.half_width, w.half_width);
    EXPECT_EQ(v.half_height, w.half_height);
    EXPECT_EQ(v.restitution, w.restitution);
  }

  ASSERT_EQ(a.world.pairs.size(), b.world.pairs.size());
  for (size_t i = 0; i < a.world.pairs.size(); ++i) {
    EXPECT_EQ(a.world.pairs[i].a_first, b.world.pairs[i].a_first);
    EXPECT_EQ(a.world.pairs[i].a_count, b.world.pairs[i].a_count);
    EXPECT_EQ(a.world.pairs[i].b_first, b.world.pairs[i].b_first);
    EXPECT_EQ(a.world.pairs[i].b_count, b.world.pairs[i].b_count);
    EXPECT_EQ(a.world.pairs[i].value, b.world.pairs[i].value);
  }

  const auto same_volume = [](const Volume& v, const Volume& w) { return v.shape == w.shape && v.half == w.half; };
  ASSERT_EQ(a.world.volume.size(), b.world.volume.size());
  for (size_t i = 0; i < a.world.volume.size(); ++i) {
    EXPECT_TRUE(same_volume(a.world.volume[i], b.world.volume[i]));
  }

  ASSERT_EQ(a.world.obstacles.size(), b.world.obstacles.size());
  for (size_t i = 0; i < a.world.obstacles.size(); ++i) {
    EXPECT_EQ(a.world.obstacles[i].center, b.world.obstacles[i].center);
    EXPECT_TRUE(same_volume(a.world.obstacles[i].volume, b.world.obstacles[i].volume));
    EXPECT_EQ(a.world.obstacles[i].restitution, b.world.obstacles[i].restitution);
  }

  ASSERT_EQ(a.world.forces.size(), b.world.forces.size());
  for (size_t i = 0; i < a.world.forces.size(); ++i) {
    EXPECT_TRUE(a.world.forces[i].law == b.world.forces[i].law);
    EXPECT_EQ(a.world.forces[i].from, b.world.forces[i].from);
    EXPECT_EQ(a.world.forces[i].until, b.world.forces[i].until);
    EXPECT_EQ(a.world.forces[i].on, b.world.forces[i].on);
  }

  EXPECT_EQ(a.initial.position, b.initial.position);
  EXPECT_EQ(a.initial.velocity, b.initial.velocity);
}

bool same_color(const Color& x, const Color& y) {
  return x.r == y.r && x.g == y.g && x.b == y.b;
}

void expect_same_looks(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.roster.bodies.size(), b.roster.bodies.size());
  for (size_t i = 0; i < a.roster.bodies.size(); ++i) {
    EXPECT_EQ(a.roster.bodies[i].name, b.roster.bodies[i].name);
    EXPECT_EQ(a.roster.bodies[i].first, b.roster.bodies[i].first);
    EXPECT_EQ(a.roster.bodies[i].count, b.roster.bodies[i].count);
    EXPECT_EQ(a.roster.bodies[i].group, b.roster.bodies[i].group);
    EXPECT_TRUE(same_color(a.roster.bodies[i].color, b.roster.bodies[i].color));
  }

  ASSERT_EQ(a.roster.fixed.size(), b.roster.fixed.size());
  for (size_t i = 0; i < a.roster.fixed.size(); ++i) {
    EXPECT_EQ(a.roster.fixed[i].name, b.roster.fixed[i].name);
    EXPECT_EQ(a.roster.fixed[i].visible, b.roster.fixed[i].visible);
    EXPECT_TRUE(same_color(a.roster.fixed[i].color, b.roster.fixed[i].color));
  }

  ASSERT_EQ(a.camera.has_value(), b.camera.has_value());
  if (a.camera) {
    EXPECT_EQ(a.camera->eye, b.camera->eye);
    EXPECT_EQ(a.camera->up, b.camera->up);
    EXPECT_EQ(a.camera->fov, b.camera->fov);
    EXPECT_EQ(a.camera->fov_horizontal, b.camera->fov_horizontal);
    EXPECT_EQ(a.camera->far, b.camera->far);
  }

  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (size_t i = 0; i < a.lights.size(); ++i) {
    EXPECT_EQ(a.lights[i].name, b.lights[i].name);
    EXPECT_EQ(a.lights[i].direction, b.lights[i].direction);
    EXPECT_EQ(a.lights[i].position, b.lights[i].position);
    EXPECT_EQ(a.lights[i].intensity, b.lights[i].intensity);
  }

  EXPECT_EQ(a.ambient.has_value(), b.ambient.has_value());
  EXPECT_EQ(a.background.color.has_value(), b.background.color.has_value());
}

void expect_same_requests(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.simulate.duration, b.simulate.duration);
  EXPECT_EQ(a.simulate.engine, b.simulate.engine);
  EXPECT_EQ(a.simulate.step, b.simulate.step);
  EXPECT_EQ(a.simulate.rest_speed, b.simulate.rest_speed);
  EXPECT_EQ(a.simulate.max_collisions, b.simulate.max_collisions);
  EXPECT_EQ(a.simulate.as_printed, b.simulate.as_printed);
  EXPECT_EQ(a.simulate.contact.merge, b.simulate.contact.merge);

  EXPECT_EQ(a.output.contacts.has_value(), b.output.contacts.has_value());

  ASSERT_EQ(a.output.trajectory.has_value(), b.output.trajectory.has_value());
  if (a.output.trajectory) {
    EXPECT_EQ(a.output.trajectory->every, b.output.trajectory->every);
    EXPECT_EQ(a.output.trajectory->wide, b.output.trajectory->wide);
  }

  EXPECT_EQ(a.output.collisions, b.output.collisions);
  ASSERT_EQ(a.output.energy.has_value(), b.output.energy.has_value());
  if (a.output.energy) {
    EXPECT_EQ(a.output.energy->every, b.output.energy->every);
  }

  ASSERT_EQ(a.output.frames.has_value(), b.output.frames.has_value());
  ASSERT_EQ(a.output.video.has_value(), b.output.video.has_value());
  if (a.output.video) {
    EXPECT_EQ(a.output.video->file, b.output.video->file);
    EXPECT_EQ(a.output.video->fps, b.output.video->fps);
    EXPECT_EQ(a.output.video->size.width, b.output.video->size.width);
    EXPECT_EQ(a.output.video->samples, b.output.video->samples);
    EXPECT_EQ(a.output.video->crf, b.output.video->crf);
    EXPECT_EQ(a.output.video->from, b.output.video->from);
    EXPECT_EQ(a.output.video->until, b.output.video->until);
    EXPECT_EQ(a.output.video->speed, b.output.video->speed);
  }

  ASSERT_EQ(a.output.sheet.has_value(), b.output.sheet.has_value());
  if (a.output.sheet) {
    EXPECT_EQ(a.output.sheet->size, b.output.sheet->size);
    EXPECT_EQ(a.output.sheet->from, b.output.sheet->from);
    EXPECT_EQ(a.output.sheet->until, b.output.sheet->until);
  }
}

void expect_same(const Scene& a, const Scene& b) {
  expect_same_things(a, b);
  expect_same_looks(a, b);
  expect_same_requests(a, b);
}

void expect_stable(const string& text, const LoadOptions& options = {}) {
  const Scene scene = load_text(text, options);
  const Scene again = load_text(scene.resolved);
  expect_same(scene, again);
  EXPECT_EQ(scene.resolved, again.resolved);
}

const string brief =
    "scene: 1\n"
    "defaults: {ball: {mass: 10, radius: 0.11}}\n"
    "balls:\n"
    "  a: {position: [-1, 0, 0.025]}\n"
    "  b: {density: 1.0e+3, position: [1, 0, 0], color: tan}\n"
    "walls: {w: {center: [0, 2, 0], normal: [0, -1, 0], size: [1, 1]}}\n"
    "simulate: {duration: 2, engine: book}\n"
    "output: {video: true}\n";

const string brief_resolved =
    "scene: 1\n"
    "title: \"\"\n"
    "seed: 0\n"
    "gravity: [0, -9.80665, 0]\n"
    "restitution: {default: 1, combine: average}\n"
    "balls:\n"
    "  a: {mass: 10, radius: 0.11, position: [-1, 0, 0.025], velocity: [0, 0, 0], restitution: 1, color: "
    "\"#c8413f\"}\n"
    "  b: {density: 1.0e+3, radius: 0.11, position: [1, 0, 0], velocity: [0, 0, 0], restitution: 1, color: tan}\n"
    "walls:\n"
    "  w: {center: [0, 2, 0], normal: [0, -1, 0], size: [1, 1], up: [0, 0, 1], color: \"#8d98a5\", visible: true}\n"
    "simulate: {duration: 2, engine: book, step: 0.016666666666666666, as_printed: false, contact: {mode: bounce, "
    "quality: normal}}\n"
    "output:\n"
    "  collisions: false\n"
    "  video: {file: \"animation.mp4\", fps: 30, size: [1280, 720], crf: 18, samples: 4, from: 0, speed: 1, title: "
    "false, sound: "
    "false}\n";

TEST(ResolvedScene, HasEveryDefaultWrittenOut) {
  EXPECT_EQ(load_text(brief).resolved, brief_resolved);
}

const string with_everything = R"(scene: 1
title: "quotes \" and \\ and \u00e9: all"
seed: 18446744073709551615
gravity: [0, -9.8, 1e-3]
restitution: {default: 0.9, combine: geometric_mean, pairs: [{between: [red, gas.1], value: 0.5}, {between: [gas, room], value: 1}]}
defaults:
  ball: {mass: 1, radius: 0.1, velocity: [0, 0, 3]}
  group: {arrange: lattice, ball: {mass: 4}}
  plane: {restitution: 0.25, color: red}
  body: {mass: 3, cylinder: {radius: 0.1, height: 0.2}}
  obstacle: {box: [0.1, 0.2, 0.3]}
  wall: {up: [1, 1, 0]}
groups:
  gas: {count: 4, ball: {color: '#abc'}, in: {min: [1, 1, 1], max: [2, 2, 2]}, speed: 2}
  dust: {count: 1e1, in: {min: [-2, -2, -2], max: [-1, -1, -1]}, arrange: random}
  ice: {count: 10, ball: {impulse: [1, 2, 3]}, in: {min: [-2, 1, -2], max: [-1, 2, -1]}, arrange: hexagonal, velocity: [1, 0, 0]}
walls:
  net: {center: [0, 0, 2.5], normal: [0.1, 0.2, 1], size: [1, 0.5]}
bodies:
  can: {position: [2.5, 0, 0]}
  crate: {box: [0.2, 0.2, 0.2], position: [2.5, 1, 0], density: 10}
  marble: {radius: 0.1, position: [2.5, 2, 0], color: tan}
obstacles:
  block: {position: [-2.5, 0, 0], restitution: 0}
  post: {cylinder: {radius: 0.1, height: 1}, position: [-2.5, 2, 0], visible: false}
forces:
  - {uniform: [1, 0, 0], on: [gas, gas.1, red], from: 0.5}
  - {acceleration: [0, 0, 1e-1], until: 2}
room: {min: [-3, -3, -3], max: [3, 3, 3]}
planes:
  floor: {point: [0, -4, 0], normal: [0.1, 1, 0], visible: false}
balls:
  red: {position: [0, 0, 0], velocity: [1, 0, 0], color: crimson, impulse: [0, 0, 1]}
  blue: {density: 100, position: [0, 1, 0], restitution: 0.5, color: [0, 0.5, 1]}
simulate: {duration: 2.5, max_collisions: 1000, rest_speed: 1e-3, contact: merge}
camera: {eye: [0, 3, -5], target: [0, 0, 0], fov_axis: horizontal, far: 1e2}
lights: {sun: {direction: [0, -1, 0.5], intensity: 2}, ambient: dimgray}
background: '#112233'
output: {trajectory: {layout: wide}, energy: true, contacts: true, frames: {fps: 10, size: [64, 48], until: 1}, video: {file: "b c.mp4", from: 0.25, speed: 0.5, size: 720p}, sheet: {size: square, from: 0.5, until: 1}}
)";

TEST(ResolvedScene, OfASceneWithEverythingMeansTheSame) {
  expect_stable(with_everything);
}

TEST(ResolvedScene, HoldsWithoutOutputAndWithEmptyParts) {
  expect_stable("scene: 1\nsimulate: {duration: 0}\n");
  expect_stable(
      "scene: 1\nballs: {}\nplanes: {}\nbodies: {}\nobstacles: {}\nforces: []\nlights: {}\noutput: {}\nsimulate: "
      "{duration: 1}\n");
}

TEST(ResolvedScene, HasTheRateThatAGifGets) {
  EXPECT_NE(load_text(start + "output: {video: {file: x.gif}}\n").resolved.find("fps: 25,"), string::npos);
}

TEST(ResolvedScene, SaysHowTablesAreWrittenWhereThatIsNotCsv) {
  const auto tables = [](const string& value) {
    const string text = load_text(start + "output: {tables: " + value + "}\n").resolved;
    const size_t at = text.find("  tables: ");
    return at == string::npos ? "" : text.substr(at + 10, text.find('\n', at) - at - 10);
  };
  EXPECT_EQ(tables("csv"), "");
  EXPECT_EQ(tables("{separator: \",\"}"), "");
  EXPECT_EQ(tables("csv.gz"), "{format: \"csv.gz\", separator: \",\", decimal: \".\"}");
  EXPECT_EQ(tables("{separator: tab}"), "{format: csv, separator: tab, decimal: \".\"}");
  EXPECT_EQ(tables("{separator: ;, decimal: \",\", format: xlsx}"), "{format: xlsx, separator: \";\", decimal: \",\"}");
  expect_stable(start + "output: {energy: true, tables: {separator: \";\", decimal: \",\"}}\n");
}

TEST(ResolvedScene, HoldsSettingsAndSeed) {
  LoadOptions options;
  options.set = {"balls.a.position.z=0.1", "balls.a.color=#fff", "output.video.fps=25"};
  options.seed = 3;
  expect_stable("scene: 1\nballs: {a: {mass: 1, radius: 1, position: [0, 0, 0]}}\nsimulate: {duration: 1}\n", options);
}

}  // namespace
}  // namespace carom
