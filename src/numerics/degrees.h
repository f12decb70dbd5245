#pragma once
// Trigonometry in degrees, with the same bits on every machine.
// Sines and cosines of multiples of 30 degrees are exact where doubles hold them, as are tangents of multiples of 45.
#include "numerics/elementary.h"

namespace carom {

/// Sine and cosine of an angle in degrees, right to 3 units in the last place. The result is NaN for NaN and infinity.
SinCos sin_cos_degrees(double angle);

/// The angle in degrees whose sine is s, in [-90, 90]. NaN beyond [-1, 1].
/// A whole number of degrees comes back as such, as it does from the two below.
double arc_sine_degrees(double s);

/// The angle in degrees whose cosine is c, in [0, 180]. NaN beyond [-1, 1].
double arc_cosine_degrees(double c);

/// The angle in degrees of (x, y) with the x axis, in [-180, 180]. It is 0 at (0, 0).
double arc_tangent_degrees(double y, double x);

}  // namespace carom
