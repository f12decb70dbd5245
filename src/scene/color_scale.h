#pragma once
// The ends of the scales of colours, and the greatest speed to expect, from a scene at time 0.
#include "scene/overlay.h"

namespace carom {

struct Scene;

struct ColorScale {
  double min = 0, max = 1;  // in the quantity's SI unit
};

/// The ends of a colouring: its own, else those that follow from the scene's bodies with this colouring.
/// speed, kinetic: 0, and what bodies have at time 0 or reach by falling, rounded up. collisions: 0 and 10.
/// mass, radius: the least and the greatest; 0 and the greatest, if all are equal. group: none.
ColorScale scale_of(const Scene& scene, const Coloring& coloring);

/// The greatest speed (m/s) that a body has after the impulses of time 0, or reaches by a fall from there.
/// A fall ends at the plane below or with a string from a fixed point, else at the height of the lowest wall or
/// obstacle below, else with the run.
double expected_speed(const Scene& scene, Entity body);

/// The next larger number with at most two digits: 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 and powers of ten times these.
/// 0 becomes 1.
double rounded_up(double value);

}  // namespace carom
