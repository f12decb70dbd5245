#pragma once
// What is written onto the picture of an instant besides caption and legends: values beside bodies, a bar of known
// length, and the sum of the momenta. Plain data; mark_painter.h draws it.

#include "overlay/body_bounds.h"
#include "overlay/moment.h"
#include "scene/colors.h"
#include "std.h"

namespace carom {

/// The longest of 1, 2 and 5 times powers of ten metres that is not longer than a fifth of the picture, at the depth of
/// the camera's target.
struct ScaleBar {
  double pixels = 0;  // its length
  string text;        // "20 cm"
  friend bool operator==(const ScaleBar&, const ScaleBar&) = default;
};
ScaleBar scale_bar_of(const Eye& eye);

/// A body that is seen, and the lines beside it.
struct BodyLabel {
  BodyBounds body;
  vector<string> lines;
  friend bool operator==(const BodyLabel&, const BodyLabel&) = default;
};

/// Momenta as the picture has their directions, to the right and up.
struct MomentumSum {
  struct Part {
    double right = 0, up = 0;  // kg m/s
    Color color;
    friend bool operator==(const Part&, const Part&) = default;
  };
  vector<Part> parts;  // those of the bodies; empty where there are too many
  Part total;
  Part at_start;     // the total at time 0, around which the picture of the arrows is centred
  string text;       // its magnitude, in space: "sum: 3.10 kg m/s"
  double reach = 1;  // kg m/s, constant in time: what the longest way of arrows can show
  friend bool operator==(const MomentumSum&, const MomentumSum&) = default;
};
/// With more bodies the sum is shown alone.
inline constexpr size_t most_momenta = 6;

struct Marks {
  vector<BodyLabel> labels;   // of those of `bounds` that have one, in the order of the bodies
  vector<BodyBounds> bounds;  // of all bodies in view, if there are labels
  optional<ScaleBar> scale_bar;
  optional<MomentumSum> momentum;
  friend bool operator==(const Marks&, const Marks&) = default;
};

/// Whether pictures of the scene have any.
bool has_marks(const Scene& scene);

/// What values of a scene are measured by: its greatest speed to expect, and the sum of the bodies' greatest momenta.
struct MarkScales {
  double speed = 0;           // m/s
  double momentum = 0;        // kg m/s
  Vec3 start = Vec3::Zero();  // kg m/s, the momentum of all bodies after the impulses of time 0
};
MarkScales mark_scales(const Scene& scene);

/// Those that the scene requests.
Marks marks_of(const Moment& moment, const MarkScales& scales);

/// Three significant digits: "2.40", "0.0312", "1230", "4.56e-7". Less than a millionth of `scale` is "0".
string three_digits(double value, double scale);
/// "20 cm", "5 mm", "2 km". `length`: m.
string length_text(double length);

}  // namespace carom
