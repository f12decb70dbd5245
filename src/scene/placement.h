#pragma once
// Where the balls of a group go.
#include <cstdint>
#include <vector>

#include "physics/entity.h"
#include "scene/grid.h"
#include "scene/random.h"

namespace carom {

struct World;

enum class Arrange : std::uint8_t { random, lattice, hexagonal };

struct Placing {
  std::uint64_t count = 0;
  Entity first = 0;   // the group's first ball; all are alike
  double radius = 0;  // m
  Vec3 min, max;      // m, the box that holds every ball wholly
  Arrange arrange = Arrange::random;
};

struct Placed {
  std::vector<Vec3> centers;  // m; as many as asked for, or none
  std::uint64_t fit = 0;      // if none: how many would fit
};

/// Places balls clear of one another, of `others` (bodies and obstacles) and of the world's planes and walls.
/// lattice: cubic, the box cut into equal cells. hexagonal: close-packed layers (ABAB along y) of the widest spacing
/// that holds the count, centred. Where there are more sites than balls, sites are left out evenly. random: one ball
/// after the other anywhere that is free; where that finds no more room (above about a third of the volume) a random
/// choice of hexagonal sites, each ball moved at random as far as its site allows.
Placed place(const Placing& placing, const World& world, const BodyGrid& others, Random& random);

}  // namespace carom
