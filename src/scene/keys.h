#pragma once
// The keys of bodies, groups, fixed things, pairs, forces and the camera, with their defaults. fields.cpp joins each to
// its row. Decoding fills these structs, and makes World, State and Roster from them. An optional member is empty if
// the file gives no value, or a wrong one. A Node is decoded later, with its place for messages about it.

#include "numerics/vec3.h"
#include "physics/attractor.h"
#include "physics/drag.h"
#include "physics/spring.h"
#include "physics/volume.h"
#include "physics/world.h"
#include "scene/colors.h"
#include "scene/look.h"
#include "scene/overlay.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/document.h"

namespace carom {

struct CylinderKeys {
  optional<double> radius;  // m
  optional<double> height;  // m, along y
};

/// A mesh file, and how it is turned and scaled.
struct MeshKeys {
  const Node* file = nullptr;
  double scale = 1;  // m per unit of the file
  optional<UpAxis> up = UpAxis::y;
  Vec3 turn = Vec3(0, 0, 0);  // degrees about x, then y, then z
};

/// A volume is one of the first four. A mesh is drawn in its place, or `fit` is the volume around the mesh.
struct VolumeKeys {
  optional<double> radius;  // m
  optional<CylinderKeys> cylinder;
  optional<Vec3> box;  // m, full edge lengths
  optional<Shape> fit;
  const Node* mesh = nullptr;  // a file, or a map of MeshKeys
};

/// A colour, or the rule that makes one from a quantity.
struct BodyColor {
  Color plain;
  optional<Coloring> by;
};

/// A ball, a body or the ball of a group.
struct BodyKeys : VolumeKeys {
  optional<double> mass;                    // kg
  optional<double> density;                 // kg/m^3
  optional<Vec3> position;                  // m
  optional<Vec3> velocity = Vec3(0, 0, 0);  // m/s; none: a wrong value
  optional<double> restitution;             // none: that of the scene
  Vec3 impulse = Vec3(0, 0, 0);             // N s
  optional<double> appear;                  // s; none: it is there from the start
  optional<BodyColor> color;                // none: by its place in the file
  optional<Finish> finish;
  optional<double> opacity;
};

struct BoxKeys {
  optional<Vec3> min, max;  // m
};

/// Where the balls of a group lie: a box, a ball or a cylinder.
struct SpaceKeys : BoxKeys {
  optional<double> radius;  // m
  optional<CylinderKeys> cylinder;
  Vec3 position = Vec3(0, 0, 0);  // m, of a ball or a cylinder
};

/// The radii of a group's balls, each drawn by the seed.
struct RadiiKeys {
  optional<double> from, to;  // m
};

enum class Arrange : uint8_t { random, lattice, hexagonal };

/// A ball of a group that lists its balls.
struct PlacedKeys {
  optional<Vec3> position;  // m
  optional<Vec3> velocity;  // m/s; none: that of the group's ball
  optional<double> radius;  // m; none: that of the group's ball
  optional<double> mass;    // kg; none: that of the group's ball, or by its density
};

/// The former run from which bodies begin.
struct StartKeys {
  optional<string> run;  // a folder
  optional<double> at;   // s of that run; none: its end
};

/// What happens to balls of a group that overlap at time 0.
enum class OverlapRule : uint8_t { refuse, push };

struct GroupKeys {
  uint64_t count = 0;
  const Node* table = nullptr;  // a file
  SpaceKeys in;
  optional<Arrange> arrange = Arrange::random;
  optional<double> speed;   // m/s, standard deviation of a component
  optional<Vec3> velocity;  // m/s; none: that of the group's ball
  optional<double> appear;  // s; none: the balls are there from the start
  optional<double> rate;    // 1/s; none: all at once
  optional<double> from;    // s, of the first one at this rate; none: 0
  optional<double> until;   // s; none: the run's end
  optional<OverlapRule> overlap;
};

/// An event in place of a time.
struct EventKeys {
  const Node* region = nullptr;     // a name
  const Node* collision = nullptr;  // one or two names
  double after = 0;                 // s
};

/// A window of time in which a fixed thing moves. Either end may be an event: it is then the default here.
struct WindowKeys {
  double from = 0;          // s
  optional<double> until;   // s; none: never, or where the windows repeat
  optional<Vec3> velocity;  // m/s
};

/// The motion of a fixed thing on a sine.
struct SineKeys {
  Vec3 amplitude = Vec3(0, 0, 0);  // m
  double period = 1;               // s
  double phase = 0;                // degrees
};

/// The motion of a fixed thing round an axis.
struct CircleKeys {
  Vec3 center = Vec3(0, 0, 0);  // m
  Vec3 axis = Vec3(0, 1, 0);    // any length
  double period = 1;            // s
};

/// How a fixed thing moves, in one of three ways. Its windows are a list.
struct MotionKeys {
  optional<double> every;  // s; none: the windows do not repeat
  optional<SineKeys> sine;
  optional<CircleKeys> circle;
};

/// What planes, rooms, walls and obstacles have in common.
struct FixedKeys {
  optional<double> restitution;  // none: the moving body's
  optional<Color> color;         // none: that of the look
  optional<Finish> finish;
  optional<double> opacity;
  bool visible = true;
};

struct PlaneKeys : FixedKeys {
  Vec3 point = Vec3(0, 0, 0);   // m
  Vec3 normal = Vec3(0, 1, 0);  // to the free side, any length
};

struct RoomKeys : BoxKeys, FixedKeys {};

struct Rectangle {
  double width = 1;   // m
  double height = 1;  // m
};

struct WallKeys : FixedKeys {
  Vec3 center = Vec3(0, 0, 0);  // m
  Vec3 normal = Vec3(0, 0, 1);  // any length
  Rectangle size;
  optional<Vec3> up;  // any length; none: default_up()
};

/// The ends of a hollow obstacle that are missing.
enum class Opening : uint8_t { none, top, bottom, both };

struct ObstacleKeys : VolumeKeys, FixedKeys {
  Vec3 position = Vec3(0, 0, 0);  // m
  bool inside = false;
  optional<Opening> open = Opening::none;
};

struct StringKeys {
  const Node* from = nullptr;  // a point (m) or a name
  const Node* to = nullptr;    // a name
  optional<double> length;     // m; none: the distance of its ends at time 0
  double restitution = 0;      // of the impact where it goes taut
  bool rod = false;
  double until = infinity;  // s, or an event
  bool visible = true;
};

struct RestitutionKeys {
  double coefficient = 1;  // of a body without one of its own
  Combine combine = Combine::average;
};

struct PairKeys {
  const Node* between = nullptr;  // two names
  const Node* value = nullptr;    // a number, or none
};

/// A spring from a fixed point to each body, or between two ends.
struct SpringKeys {
  optional<Vec3> anchor;         // m
  const Node* from = nullptr;    // a point (m) or a name
  const Node* to = nullptr;      // the same
  double stiffness = 0;          // N/m
  optional<double> rest_length;  // m; none: 0 from an anchor, otherwise the distance at time 0
  double damping = 0;            // kg/s
};

struct GravitationKeys {
  double constant = 6.674e-11;  // m^3/(kg s^2)
  double softening = 0;         // m
};

/// One law, in a window of time.
struct ForceKeys {
  optional<Vec3> uniform;       // N
  optional<Vec3> acceleration;  // m/s^2
  optional<Drag> drag;
  optional<SpringKeys> spring;
  optional<Attractor> attractor;
  optional<GravitationKeys> gravitation;
  const Node* on = nullptr;  // names; null: all bodies
  double from = 0;           // s, or an event
  double until = infinity;   // s, or an event
  bool visible = true;       // whether its springs are drawn
};

/// The side of a plane to which its normal points.
struct SideKeys {
  Vec3 point = Vec3(0, 0, 0);   // m
  Vec3 normal = Vec3(0, 1, 0);  // any length
};

/// What a region does to a body that enters it.
enum class RegionAction : uint8_t { none, remove, stop };

/// One of the first four is its shape.
struct RegionKeys {
  optional<double> radius;  // m
  optional<CylinderKeys> cylinder;
  optional<Vec3> box;  // m, full edge lengths
  optional<SideKeys> plane;
  optional<Vec3> position;   // m; of a plane: none
  const Node* on = nullptr;  // names; null: all bodies
  optional<RegionAction> action = RegionAction::none;
};

/// An entry of `simulate.stop`.
struct StopKeys {
  optional<uint64_t> collisions;
  const Node* region = nullptr;  // a name
};

struct TrailKeys {
  double seconds = 1;
  optional<double> width;    // m; none: half a body's radius
  const Node* on = nullptr;  // names; null: all bodies
};

struct LabelKeys {
  const Node* show = nullptr;  // quantities
  const Node* on = nullptr;    // names; null: all bodies
};

enum class FitTo : uint8_t { motion };

struct FitKeys {
  FitTo to = FitTo::motion;
  const Node* on = nullptr;  // names; null: all
};

struct OrbitKeys {
  double period = 0;  // s
};

/// Eye and target may be missing, depending on the keys here.
struct CameraKeys : Camera {
  optional<FitKeys> fit;
  const Node* follow = nullptr;  // a name
  optional<OrbitKeys> orbit;
  bool orthographic = false;
};

struct KeyframeKeys {
  double at = 0;               // s
  optional<Vec3> eye, target;  // m
  optional<double> fov;        // degrees; none: that of the camera
};

}  // namespace carom
