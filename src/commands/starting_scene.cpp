// The scene is a text in the program, so that `carom new` needs no installed files.
#include "commands/starting_scene.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

string_view starting_scene() {
  return R"(# yaml-language-server: $schema=scene.schema.json
# A red ball is thrown over a floor, bounces, and lands on a blue one. Change any of it: `carom check` shows what a run
# would do, and `carom explain KEY` explains a key. By the first line an editor with a YAML language server completes
# and checks keys.
#
# Expect the red ball to strike the floor first: it falls 1.2 - 0.2 = 1 m in sqrt(2 * 1 / 9.80665) = 0.4516 s.
# Units: m, kg, s, N, J; angles in degrees. Positions are [x, y, z], y is up.
scene: 1
title: A thrown ball meets another
# seed: 7                         # of groups made at random
# gravity: [0, 0, 0]              # without this line [0, -9.80665, 0]

# Values for every ball that has none of its own. restitution: 0 does not bounce, 1 loses nothing.
defaults:
  ball: {mass: 1, radius: 0.2, restitution: 0.8}

balls:
  red:  {position: [-1.5, 1.2, 0], velocity: [1.5, 0, 0], color: crimson}
  blue: {position: [1, 0.2, 0], color: royalblue}

# Many balls at once:
# groups:
#   marbles: {count: 20, in: {min: [-2, 2, -1], max: [2, 4, 1]}, ball: {radius: 0.1}}

# A normal points to the free side of a plane.
planes:
  floor: {point: [0, 0, 0], normal: [0, 1, 0]}

# walls:
#   end: {center: [2.5, 0.5, 0], normal: [-1, 0, 0], size: [2, 1]}

simulate: {duration: 3}

# From the +z side +x is on the right of the picture.
camera: {eye: [0.5, 1.6, 6], target: [0.5, 0.6, 0], fov: 40}

output:
  trajectory: {every: 0.01}       # trajectory.csv: position and velocity
  collisions: true                # collisions.csv: every collision
  energy: {every: 0.01}           # energy.csv
  # tables: {separator: ";", decimal: ","}   # for spreadsheets with decimal commas
  frames: {fps: 10, size: [640, 360]}
  # video: {fps: 30, size: [1280, 720]}
)";
}

}  // namespace carom
