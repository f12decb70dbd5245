// The rows of the scene format, and the table that gives access to them.
// Defaults come from the structs that the keys fill, so that a default is written once.
// The table is completed at first use, because texts of defaults cannot be made at compile time.
#include "scene/fields.h"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <map>

#include "scene/engines.h"
#include "scene/keys.h"
#include "scene/member.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_0{0, infinity, true, false};
constexpr Range from_0{0, infinity, false, false};
constexpr Range from_1{1, infinity, false, false};

// clang-format off
constexpr Field scene_fields[] = {
    {.key = "scene", .type = Type::whole, .range = {1, 1}, .needed = true, .doc = "Kind of file and version of the format.", .example = "1", .title = "Format"},
    {.key = "title", .type = Type::text, .initial = "\"\"", .doc = "Title of the scene, one line.", .example = "Two bowling balls meet near the origin"},
    {.key = "seed", .type = Type::whole, .range = from_0, .initial = "0", .doc = "The only source of randomness.", .example = "7"},
    {.key = "let", .type = Type::values, .doc = "Numbers with names. Wherever a number may stand, a text that begins with = is an expression of them.", .example = "{r: 0.05, gap: '= r / 10'}", .title = "Numbers with names"},
    {.key = "gravity", .type = Type::vector, .unit = "m/s^2", .initial = "[0, -9.80665, 0]", .doc = "Acceleration of every body; y is up.", .example = "[0, 0, 0]"},
    {.key = "restitution", .type = Type::part, .of = "restitution", .doc = "How bodies bounce off one another. A number alone is `default`.", .example = "{default: 0.9, combine: minimum}", .plain = "default"},
    {.key = "defaults", .type = Type::part, .of = "defaults", .doc = "Default values for things of each kind.", .example = "{ball: {mass: 10, radius: 0.11, restitution: 0.9}}"},
    {.key = "balls", .type = Type::named, .of = "ball", .doc = "Single balls by name.", .example = "{red: {mass: 10, radius: 0.11, position: [3, 1, 0], velocity: [-2, 0, 0], color: crimson}}"},
    {.key = "bodies", .type = Type::named, .of = "body", .doc = "Movable bodies with any bounding volume.", .example = "{crate: {mass: 2, box: [0.4, 0.3, 0.4], position: [-1, 1, 0]}}"},
    {.key = "groups", .type = Type::named, .of = "group", .doc = "Many balls made by rule, by name.", .example = "{gas: {count: 20, in: {min: [-2, 2, -2], max: [2, 4, 2]}, speed: 1, ball: {mass: 1, radius: 0.1}}}"},
    {.key = "planes", .type = Type::named, .of = "plane", .doc = "Unbounded fixed surfaces, free on one side.", .example = "{floor: {point: [0, 0, 0], normal: [0, 1, 0], color: tan}}"},
    {.key = "walls", .type = Type::named, .of = "wall", .doc = "Two-sided fixed rectangles.", .example = "{fence: {center: [5, 1, 0], normal: [-1, 0, 0], size: [2, 2]}}"},
    {.key = "room", .type = Type::part, .of = "room", .doc = "Six planes that face inward: room.x_min to room.z_max.", .example = "{min: [-9, -1, -9], max: [9, 9, 9]}"},
    {.key = "obstacles", .type = Type::named, .of = "obstacle", .doc = "Bodies that no impact moves.", .example = "{post: {cylinder: {radius: 0.1, height: 1}, position: [-3, 1, 0]}}"},
    {.key = "strings", .type = Type::named, .of = "string", .doc = "Strings and rods without mass, between bodies, or from a point to a body.", .example = "{s1: {from: [-1, 2, 0], to: crate, length: 1.5}}"},
    {.key = "regions", .type = Type::named, .of = "region", .doc = "Regions of space that the centres of bodies enter and leave. They touch nothing, and pictures do not show them.", .example = "{pocket: {radius: 0.3, position: [-6, 0, 0], action: remove}}"},
    {.key = "forces", .type = Type::list, .of = "force", .doc = "Forces on bodies, in addition to gravity.", .example = "[{drag: {linear: 0.1}}]"},
    {.key = "start", .type = Type::part, .of = "start", .doc = "Begins with the bodies of a finished run: each body of this scene that the run has, by name, has its position and velocity there, and no impulse. All else is as this scene gives it, and time starts at 0.", .example = "{run: ../output/first, at: 2}"},
    {.key = "simulate", .type = Type::part, .of = "simulate", .needed = true, .doc = "Duration, engine and accuracy.", .example = "{duration: 2}"},
    {.key = "camera", .type = Type::part, .of = "camera", .doc = "Camera of the pictures. Default: {fit: motion}.", .example = "{eye: [0, 3, -5], target: [0, 0, 0]}", .drawn = true},
    {.key = "lights", .type = Type::named, .of = "light", .doc = "Lights by name, and `ambient`, the colour of the ambient light.", .example = "{sun: {direction: [1, -2, 1]}, ambient: dimgray}", .drawn = true},
    {.key = "background", .type = Type::color_or_none, .doc = "Background colour; none: transparent, in PNG, GIF and WebP.", .example = "skyblue", .drawn = true},
    {.key = "caption", .type = Type::text_or_flag, .doc = "A text in each picture. Names in braces become values: {title}, {time} in s, {run} (the name of the run's folder), {collisions} (so far), and paths into the scene, such as {restitution.default}. Two braces are one. A text that begins with a brace needs quotes. true: the title and the time.", .example = "\"{title}, t = {time} s\"", .title = "Text in the pictures", .drawn = true},
    {.key = "trails", .type = Type::part_or_flag, .of = "trails", .doc = "The paths of bodies during the last seconds, which fade with age.", .example = "{seconds: 0.5}", .drawn = true},
    {.key = "flash", .type = Type::flag, .doc = "Whether bodies glow white for 0.1 s of film after a collision, and fade to their colour.", .example = "true", .title = "Flash of collisions", .drawn = true},
    {.key = "arrows", .type = Type::names, .of = "velocity|force", .doc = "Arrows at the bodies. velocity; force: gravity and `forces`, without contact. The legend has their scale.", .example = "[velocity]", .drawn = true},
    {.key = "shutter", .type = Type::number, .range = {0, 1}, .doc = "Motion blur: a picture is the mean of the light during this part of the interval between pictures, until its time. At most 32 instants make a picture.", .example = "0.5", .title = "Open part of the interval between pictures", .drawn = true},
    {.key = "measures", .type = Type::texts, .doc = "Measures of the run by name, columns of summary.csv: a number of summary.csv, a quantity at the end (balls.red.y_m), max, min, time_of_max or time_of_min of one over the run, first(a, b) in s, hits(a, b), regions.NAME.entries, inside, first_s or first, count(y_m < 0). Or an expression of these that begins with =.", .example = "{height_m: max(balls.red.y_m), share: '= hits(red, blue) / collisions'}", .title = "Measures of the run"},
    {.key = "output", .type = Type::part, .of = "output", .doc = "What the run writes. Default: trajectory, collisions and energy, no pictures.", .example = "{trajectory: {every: 0.01}, collisions: true, energy: true}"},
};

constexpr Field restitution_fields[] = {
    {.key = "default", .type = Type::number, .range = from_0, .doc = "Coefficient of a body without one of its own.", .example = "0.9", .title = "Default coefficient of restitution", .member = fills<RestitutionKeys, &RestitutionKeys::coefficient>},
    {.key = "combine", .type = Type::choice, .of = "average|minimum|maximum|product|geometric_mean|mass_weighted|book",
     .doc = "How two bodies' coefficients combine into the pair's; book is e1 e2 / 2.", .example = "minimum", .title = "Rule for two coefficients", .member = fills<RestitutionKeys, &RestitutionKeys::combine>},
    {.key = "pairs", .type = Type::list, .of = "pair", .doc = "Pairs with a coefficient of their own; the last match wins.", .example = "[{between: [red, floor], value: 0.5}]"},
};

// A name, a group's member, or a side of the room.
constexpr string_view reference = R"(^[A-Za-z_][A-Za-z0-9_-]*(\.([0-9]+|[xyz]_(min|max)|\{.+\})){0,2}$)";

constexpr Field pair_fields[] = {
    {.key = "between", .type = Type::two_names, .needed = true,
     .doc = "Two names: balls, bodies, groups, members (gas.3), planes, walls, obstacles, room, room.y_min.", .example = "[red, floor]", .title = "Two names", .pattern = reference, .member = fills<PairKeys, &PairKeys::between>},
    {.key = "value", .type = Type::number, .range = from_0, .needed = true, .doc = "The pair's coefficient of restitution.", .example = "0.5", .title = "Coefficient of restitution", .member = fills<PairKeys, &PairKeys::value>},
};

constexpr Field defaults_fields[] = {
    {.key = "ball", .type = Type::part, .of = "ball", .doc = "For every ball, and every group's ball.", .example = "{mass: 10, radius: 0.11}"},
    {.key = "body", .type = Type::part, .of = "body", .doc = "For every body.", .example = "{density: 700}"},
    {.key = "plane", .type = Type::part, .of = "plane", .doc = "For every plane.", .example = "{restitution: 1}"},
    {.key = "wall", .type = Type::part, .of = "wall", .doc = "For every wall.", .example = "{size: [2, 1]}"},
    {.key = "obstacle", .type = Type::part, .of = "obstacle", .doc = "For every obstacle.", .example = "{radius: 0.1}"},
    {.key = "group", .type = Type::part, .of = "group", .doc = "For every group.", .example = "{speed: 1}"},
    {.key = "string", .type = Type::part, .of = "string", .doc = "For every string.", .example = "{restitution: 0.2}"},
};

constexpr Field mass{.key = "mass", .type = Type::number, .unit = "kg", .range = above_0, .one_of = "mass|density", .needed = true, .doc = "Mass.", .example = "10", .member = fills<BodyKeys, &BodyKeys::mass>};
constexpr Field density{.key = "density", .type = Type::number, .unit = "kg/m^3", .range = above_0, .one_of = "mass|density", .doc = "Mass per volume, instead of mass.", .example = "700", .member = fills<BodyKeys, &BodyKeys::density>};
constexpr Field radius{.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Radius.", .example = "0.11", .member = fills<BodyKeys, &BodyKeys::radius>};
constexpr Field ball_velocity{.key = "velocity", .type = Type::vector, .unit = "m/s", .doc = "Velocity at time 0.", .example = "[2, 0, 0]", .member = fills<BodyKeys, &BodyKeys::velocity>};
constexpr Field ball_restitution{.key = "restitution", .type = Type::number, .range = from_0, .doc = "Coefficient of restitution; above 1 adds energy. Default: restitution.default.", .example = "0.9", .member = fills<BodyKeys, &BodyKeys::restitution>};
constexpr Field impulse{.key = "impulse", .type = Type::vector, .unit = "N s", .doc = "Impulse at time 0.", .example = "[-20, 0, 0]", .member = fills_if_given<BodyKeys, &BodyKeys::impulse>};
constexpr Field body_color_field{.key = "color", .type = Type::color_or_part, .of = "coloring", .doc = "Colour in pictures, or colours by a quantity. Default: those of the mesh file, or one is chosen.", .example = "crimson", .drawn = true, .member = fills_if_given<BodyKeys, &BodyKeys::color>};
template <typename Keys> constexpr Field color{.key = "color", .type = Type::color, .doc = "Colour in pictures. Default: one is chosen.", .example = "crimson", .drawn = true, .member = fills_if_given<Keys, &Keys::color>};
constexpr Field mesh{.key = "mesh", .type = Type::file, .doc = "Mesh file, drawn scaled to the ball. Without `color` it has the colours and textures of the file.", .example = "meshes/duck.obj", .drawn = true, .member = fills<BodyKeys, &BodyKeys::mesh>};
constexpr Field ball_position{.key = "position", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre at time 0.", .example = "[3, 1, 0]", .member = fills<BodyKeys, &BodyKeys::position>};

// The members of a repeated thing replace it before its map is checked and decoded (repeat.h).
constexpr Field repeat{.key = "repeat", .type = Type::repeat, .doc = "Makes members name.0, name.1, ... of this map. Its expressions may contain the index i, or the indices named here; the last one varies fastest.", .example = "{i: 6, j: 4}", .title = "Number of members", .own = true};

constexpr Field ball_fields[] = {
    mass, density, radius,
    ball_position, ball_velocity, ball_restitution, impulse, body_color_field, mesh, repeat,
};

constexpr string_view volumes = "radius|cylinder|box|fit";

// A body's volume is one of these four keys. A mesh with `fit` is the volume itself.
// A mesh beside one of the other three is drawn in its place.
template <typename Keys> constexpr Field radius_of{.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .one_of = volumes, .needed = true, .doc = "Radius of a sphere.", .example = "0.11", .member = fills<Keys, &Keys::radius>};
template <typename Keys> constexpr Field cylinder{.key = "cylinder", .type = Type::part, .of = "cylinder", .one_of = volumes, .doc = "An upright cylinder, its axis along y.", .example = "{radius: 0.1, height: 1}", .member = fills<Keys, &Keys::cylinder>};
template <typename Keys> constexpr Field box{.key = "box", .type = Type::vector, .unit = "m", .range = above_0, .one_of = volumes, .doc = "An axis-aligned box: its full edge lengths.", .example = "[0.4, 0.3, 0.4]", .member = fills<Keys, &Keys::box>};
template <typename Keys> constexpr Field fit{.key = "fit", .type = Type::choice, .of = "sphere|cylinder|box", .one_of = volumes, .doc = "The tightest such volume around the mesh; position is its centre.", .example = "box", .with = "mesh", .member = fills<Keys, &Keys::fit>};
template <typename Keys> constexpr Field mesh_of{.key = "mesh", .type = Type::file, .doc = "Mesh file: in its own size with `fit`, else drawn scaled into the volume. Without `color` it has the colours and textures of the file.", .example = "meshes/pin.obj", .drawn = true, .member = fills<Keys, &Keys::mesh>};

constexpr Field body_fields[] = {
    mass, density, radius_of<BodyKeys>, cylinder<BodyKeys>, box<BodyKeys>, mesh_of<BodyKeys>, fit<BodyKeys>,
    ball_position, ball_velocity, ball_restitution, impulse, body_color_field, repeat,
};

constexpr Field cylinder_fields[] = {
    {.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Radius.", .example = "0.1", .member = fills<CylinderKeys, &CylinderKeys::radius>},
    {.key = "height", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Height, along y.", .example = "1", .member = fills<CylinderKeys, &CylinderKeys::height>},
};

constexpr Field member_fields[] = {mass, density, radius, ball_velocity, ball_restitution, impulse, body_color_field, mesh};

constexpr Field placed_fields[] = {
    {.key = "position", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre at time 0.", .example = "[3, 1, 0]", .member = fills<PlacedKeys, &PlacedKeys::position>},
    {.key = "velocity", .type = Type::vector, .unit = "m/s", .doc = "Velocity at time 0. Default: that of the group's ball.", .example = "[2, 0, 0]", .member = fills_if_given<PlacedKeys, &PlacedKeys::velocity>},
};

constexpr Field start_fields[] = {
    {.key = "run", .type = Type::text, .needed = true, .doc = "The folder of a finished run, from the scene file's folder.", .example = "../output/first", .title = "Folder of the run", .member = fills<StartKeys, &StartKeys::run>},
    {.key = "at", .type = Type::number, .unit = "s", .range = from_0, .doc = "Time of the run. Default: its end. Of a run without flights: a time of its trajectory.csv.", .example = "2", .title = "Time of the run", .member = fills_if_given<StartKeys, &StartKeys::at>},
};

constexpr Field group_fields[] = {
    {.key = "count", .type = Type::whole, .range = from_0, .needed = true, .doc = "Number of balls: name.0, name.1, ...", .example = "20", .member = fills<GroupKeys, &GroupKeys::count>},
    {.key = "ball", .type = Type::part, .of = "member", .needed = true, .doc = "A ball of the group, without position. Not needed where defaults.ball has all of it.", .example = "{mass: 1, radius: 0.1}"},
    {.key = "in", .type = Type::part, .of = "in", .one_of = "in|members", .needed = true, .doc = "The box that every ball lies wholly inside.", .example = "{min: [-2, 2, -2], max: [2, 4, 2]}", .title = "Box of the balls", .member = fills<GroupKeys, &GroupKeys::in>},
    {.key = "arrange", .type = Type::choice, .of = "random|lattice|hexagonal", .one_of = "arrange|members",
     .doc = "random; lattice: cubic, spread evenly over the box; hexagonal: close-packed layers, spread as far as the box allows.", .example = "hexagonal", .member = fills<GroupKeys, &GroupKeys::arrange>},
    {.key = "speed", .type = Type::number, .unit = "m/s", .range = from_0, .one_of = "speed|velocity|members", .doc = "Standard deviation of each component of a ball's velocity.", .example = "1", .member = fills<GroupKeys, &GroupKeys::speed>},
    {.key = "velocity", .type = Type::vector, .unit = "m/s", .one_of = "speed|velocity|members", .doc = "Velocity of every ball at time 0.", .example = "[0, -1, 0]", .member = fills<GroupKeys, &GroupKeys::velocity>},
    {.key = "members", .type = Type::list, .of = "placed", .one_of = "members|in|arrange|speed|velocity", .doc = "Each ball's position and velocity, as many as `count`.", .example = "[{position: [0, 2, 0], velocity: [1, 0, 0]}]", .title = "Balls one by one"},
    repeat,
};

constexpr Field in_fields[] = {
    {.key = "min", .type = Type::vector, .unit = "m", .needed = true, .doc = "Lowest corner.", .example = "[-2, 2, -2]", .title = "Lowest corner", .member = fills<BoxKeys, &BoxKeys::min>},
    {.key = "max", .type = Type::vector, .unit = "m", .needed = true, .doc = "Highest corner.", .example = "[2, 4, 2]", .title = "Highest corner", .member = fills<BoxKeys, &BoxKeys::max>},
};

template <typename Keys> constexpr Field fixed_restitution{.key = "restitution", .type = Type::number, .range = from_0, .doc = "Coefficient of restitution. Default: the moving body's.", .example = "0.5", .member = fills<Keys, &Keys::restitution>};
template <typename Keys> constexpr Field visible{.key = "visible", .type = Type::flag, .doc = "Whether it is drawn.", .example = "false", .drawn = true, .member = fills<Keys, &Keys::visible>};

constexpr Field motion{.key = "motion", .type = Type::list, .of = "motion", .doc = "Windows of time in which it moves at a constant velocity, in order; outside them it stands where it has arrived. Of a plane only the part along the normal counts.", .example = "[{from: 0, until: 2, velocity: [0, 0.5, 0]}]"};

constexpr Field motion_fields[] = {
    {.key = "from", .type = Type::number, .unit = "s", .range = from_0, .doc = "When the motion starts.", .example = "0.5", .title = "Start", .member = fills<MotionKeys, &MotionKeys::from>},
    {.key = "until", .type = Type::number, .unit = "s", .range = above_0, .doc = "When the motion ends. Default: never.", .example = "1.5", .title = "End", .member = fills_if_given<MotionKeys, &MotionKeys::until>},
    {.key = "velocity", .type = Type::vector, .unit = "m/s", .needed = true, .doc = "Its velocity in this window.", .example = "[0, 0.5, 0]", .member = fills<MotionKeys, &MotionKeys::velocity>},
};

constexpr Field plane_fields[] = {
    {.key = "point", .type = Type::vector, .unit = "m", .needed = true, .doc = "Any point of the plane.", .example = "[0, 0, 0]", .title = "A point of the plane", .member = fills<PlaneKeys, &PlaneKeys::point>},
    {.key = "normal", .type = Type::direction, .needed = true, .doc = "Points to the free side; any length.", .example = "[0, 1, 0]", .member = fills<PlaneKeys, &PlaneKeys::normal>},
    motion, fixed_restitution<PlaneKeys>, color<PlaneKeys>, visible<PlaneKeys>, repeat,
};

constexpr Field wall_fields[] = {
    {.key = "center", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre of the rectangle.", .example = "[5, 1, 0]", .member = fills<WallKeys, &WallKeys::center>},
    {.key = "normal", .type = Type::direction, .needed = true, .doc = "Perpendicular to the rectangle; any length.", .example = "[-1, 0, 0]", .member = fills<WallKeys, &WallKeys::normal>},
    {.key = "size", .type = Type::extent, .unit = "m", .range = above_0, .needed = true, .doc = "Width and height.", .example = "[2, 2]", .title = "Width and height", .member = fills<WallKeys, &WallKeys::size>},
    {.key = "up", .type = Type::direction, .doc = "Direction of the height, made perpendicular to the normal. Default: y; z for a level wall.", .example = "[0, 1, 0.5]", .title = "Direction of the height", .member = fills<WallKeys, &WallKeys::up>},
    motion, fixed_restitution<WallKeys>, color<WallKeys>, visible<WallKeys>, repeat,
};

constexpr Field room_fields[] = {
    {.key = "min", .type = Type::vector, .unit = "m", .needed = true, .doc = "Lowest corner.", .example = "[-9, -1, -9]", .title = "Lowest corner", .member = fills<RoomKeys, &RoomKeys::min>},
    {.key = "max", .type = Type::vector, .unit = "m", .needed = true, .doc = "Highest corner.", .example = "[9, 9, 9]", .title = "Highest corner", .member = fills<RoomKeys, &RoomKeys::max>},
    fixed_restitution<RoomKeys>, color<RoomKeys>, visible<RoomKeys>,
};

constexpr Field obstacle_color{.key = "color", .type = Type::color, .doc = "Colour in pictures. Default: those of the mesh file, or one is chosen.", .example = "crimson", .drawn = true, .member = fills_if_given<ObstacleKeys, &ObstacleKeys::color>};

constexpr Field obstacle_fields[] = {
    radius_of<ObstacleKeys>, cylinder<ObstacleKeys>, box<ObstacleKeys>, mesh_of<ObstacleKeys>, fit<ObstacleKeys>,
    {.key = "position", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre.", .example = "[-3, 1, 0]", .member = fills<ObstacleKeys, &ObstacleKeys::position>},
    motion, fixed_restitution<ObstacleKeys>, obstacle_color, visible<ObstacleKeys>, repeat,
};

constexpr Field string_fields[] = {
    {.key = "from", .type = Type::point_or_name, .unit = "m", .needed = true, .doc = "One end: a fixed point, or the centre of a ball, body or member (gas.3).", .example = "[-1, 2, 0]", .title = "One end", .pattern = reference, .member = fills<StringKeys, &StringKeys::from>},
    {.key = "to", .type = Type::name, .needed = true, .doc = "The other end: the centre of a ball, body or member (gas.3).", .example = "crate", .title = "The other end", .pattern = reference, .member = fills<StringKeys, &StringKeys::to>},
    {.key = "length", .type = Type::number, .unit = "m", .range = above_0, .doc = "Greatest distance of its ends; of a rod the distance. Default: the distance at time 0.", .example = "1.5", .member = fills<StringKeys, &StringKeys::length>},
    {.key = "restitution", .type = Type::number, .range = from_0, .doc = "Coefficient of restitution where the string goes taut.", .example = "0.2", .member = fills<StringKeys, &StringKeys::restitution>},
    {.key = "rod", .type = Type::flag, .doc = "Whether it keeps its ends apart, too.", .example = "true", .title = "Rod", .member = fills<StringKeys, &StringKeys::rod>},
    visible<StringKeys>, repeat,
};

constexpr string_view region_shapes = "radius|cylinder|box|plane";

constexpr Field region_fields[] = {
    {.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .one_of = region_shapes, .needed = true, .doc = "Radius of a sphere.", .example = "0.3", .member = fills<RegionKeys, &RegionKeys::radius>},
    {.key = "cylinder", .type = Type::part, .of = "cylinder", .one_of = region_shapes, .doc = "An upright cylinder, its axis along y.", .example = "{radius: 0.1, height: 1}", .member = fills<RegionKeys, &RegionKeys::cylinder>},
    {.key = "box", .type = Type::vector, .unit = "m", .range = above_0, .one_of = region_shapes, .doc = "An axis-aligned box: its full edge lengths.", .example = "[0.4, 0.3, 0.4]", .member = fills<RegionKeys, &RegionKeys::box>},
    {.key = "plane", .type = Type::part, .of = "side", .one_of = "radius|cylinder|box|plane|position", .doc = "One side of a plane.", .example = "{point: [0, -1, 0], normal: [0, -1, 0]}", .member = fills<RegionKeys, &RegionKeys::plane>},
    {.key = "position", .type = Type::vector, .unit = "m", .one_of = "position|plane", .needed = true, .doc = "Centre.", .example = "[-6, 0, 0]", .member = fills<RegionKeys, &RegionKeys::position>},
    {.key = "on", .type = Type::names, .doc = "Balls, bodies, groups and members that enter and leave it. Default: all.", .example = "[red, gas.3]", .title = "Bodies that enter and leave it", .pattern = reference, .member = fills<RegionKeys, &RegionKeys::on>},
    {.key = "action", .type = Type::choice, .of = "none|remove|stop", .doc = "What happens when a body's centre enters. remove: the body leaves the world; stop: the run ends.", .example = "remove", .member = fills<RegionKeys, &RegionKeys::action>},
    repeat,
};

constexpr Field side_fields[] = {
    {.key = "point", .type = Type::vector, .unit = "m", .needed = true, .doc = "Any point of the plane.", .example = "[0, -1, 0]", .title = "A point of the plane", .member = fills<SideKeys, &SideKeys::point>},
    {.key = "normal", .type = Type::direction, .needed = true, .doc = "Points to the side that is the region; any length.", .example = "[0, -1, 0]", .member = fills<SideKeys, &SideKeys::normal>},
};

constexpr string_view forces = "uniform|acceleration|drag|spring|attractor";

constexpr Field force_fields[] = {
    {.key = "uniform", .type = Type::vector, .unit = "N", .one_of = forces, .needed = true, .doc = "The same force on each body.", .example = "[2, 0, 0]", .member = fills<ForceKeys, &ForceKeys::uniform>},
    {.key = "acceleration", .type = Type::vector, .unit = "m/s^2", .one_of = forces, .doc = "The same acceleration of each body.", .example = "[3, 0, 0]", .member = fills<ForceKeys, &ForceKeys::acceleration>},
    {.key = "drag", .type = Type::part, .of = "drag", .one_of = forces, .doc = "Drag of air or another medium.", .example = "{linear: 0.1, wind: [5, 0, 0]}", .member = fills<ForceKeys, &ForceKeys::drag>},
    {.key = "spring", .type = Type::part, .of = "spring", .one_of = forces, .doc = "A spring from a fixed point to each body.", .example = "{anchor: [0, 3, 0], stiffness: 40, rest_length: 0.5}", .member = fills<ForceKeys, &ForceKeys::spring>},
    {.key = "attractor", .type = Type::part, .of = "attractor", .one_of = forces, .doc = "Attraction to a fixed point, as by gravity.", .example = "{center: [0, 0, 0], strength: 10}", .member = fills<ForceKeys, &ForceKeys::attractor>},
    {.key = "on", .type = Type::names, .doc = "Balls, bodies, groups and members that it acts on. Default: all.", .example = "[red, gas.3]", .title = "Bodies that it acts on", .pattern = reference, .member = fills<ForceKeys, &ForceKeys::on>},
    {.key = "from", .type = Type::number, .unit = "s", .range = from_0, .doc = "When the force starts.", .example = "0.5", .title = "Start", .member = fills<ForceKeys, &ForceKeys::from>},
    {.key = "until", .type = Type::number, .unit = "s", .range = above_0, .doc = "When the force ends. Default: never.", .example = "1.5", .title = "End", .member = fills_if_given<ForceKeys, &ForceKeys::until>},
    {.key = "visible", .type = Type::flag, .doc = "Whether the spring is drawn. Default: true.", .example = "false", .with = "spring", .drawn = true, .member = fills_if_given<ForceKeys, &ForceKeys::visible>},
    repeat,
};

constexpr Field drag_fields[] = {
    {.key = "linear", .type = Type::number, .unit = "kg/s", .range = from_0, .doc = "Force per m/s of speed relative to the medium.", .example = "0.1", .member = fills_if_given<Drag, &Drag::linear>},
    {.key = "quadratic", .type = Type::number, .unit = "kg/m", .range = from_0, .doc = "Force per (m/s)^2: half the product of density, drag coefficient and cross-section.", .example = "0.02", .member = fills_if_given<Drag, &Drag::quadratic>},
    {.key = "wind", .type = Type::vector, .unit = "m/s", .doc = "Velocity of the medium.", .example = "[5, 0, 0]", .member = fills<Drag, &Drag::wind>},
};

constexpr Field spring_fields[] = {
    {.key = "anchor", .type = Type::vector, .unit = "m", .needed = true, .doc = "Fixed end; the other end is a body's centre.", .example = "[0, 3, 0]", .member = fills<Spring, &Spring::anchor>},
    {.key = "stiffness", .type = Type::number, .unit = "N/m", .range = from_0, .needed = true, .doc = "Force per m of stretch.", .example = "40", .member = fills<Spring, &Spring::stiffness>},
    {.key = "rest_length", .type = Type::number, .unit = "m", .range = from_0, .doc = "Length at which the spring neither pulls nor pushes.", .example = "0.5", .title = "Rest length", .member = fills<Spring, &Spring::rest_length>},
    {.key = "damping", .type = Type::number, .unit = "kg/s", .range = from_0, .doc = "Force per m/s along the spring.", .example = "0.2", .member = fills<Spring, &Spring::damping>},
};

constexpr Field attractor_fields[] = {
    {.key = "center", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre of attraction.", .example = "[0, 0, 0]", .member = fills<Attractor, &Attractor::center>},
    {.key = "strength", .type = Type::number, .unit = "m^3/s^2", .needed = true, .doc = "Acceleration at 1 m; G M of a mass M. Negative: repulsion.", .example = "10", .member = fills<Attractor, &Attractor::strength>},
    {.key = "softening", .type = Type::number, .unit = "m", .range = from_0, .doc = "Length s: sqrt(d^2 + s^2) takes the place of the distance d, so that the attraction stays finite.", .example = "0.05", .member = fills<Attractor, &Attractor::softening>},
};

constexpr Field simulate_fields[] = {
    {.key = "duration", .type = Type::number, .unit = "s", .range = from_0, .needed = true, .doc = "Simulated time.", .example = "2", .member = fills<Simulate, &Simulate::duration>},
    {.key = "stop", .type = Type::list, .of = "stop", .doc = "What ends the run before its duration, as soon as one of these holds. rest: all bodies are at rest.", .example = "[rest, {collisions: 100}]", .title = "Ends of the run", .plain = "rest", .needs_entries = true},
    {.key = "engine", .type = Type::choice, .of = engine_names,
     .doc = "exact: from collision to collision; stepped: in time steps, for any force; book: the source chapter's frame loop; auto: exact where the forces allow it, else stepped.", .example = "exact", .member = fills<Simulate, &Simulate::engine>},
    {.key = "step", .type = Type::number, .unit = "s", .range = above_0, .one_of = "step|tolerance", .doc = "Time step of engines stepped and book; with dop853 the longest one. Default of euler, verlet and rk4: 1/1000, or shorter where forces change faster; of book: 1/60.", .example = "0.001", .member = fills<Simulate, &Simulate::step>},
    {.key = "as_printed", .type = Type::flag, .doc = "book only: the chapter's listings as printed, errors included.", .example = "true", .engines = "book", .member = fills<Simulate, &Simulate::as_printed>},
    {.key = "rest_speed", .type = Type::number, .unit = "m/s", .range = from_0, .doc = "Slower impacts under load end in lasting contact. Default: on a flat surface the slowest speed that the clock resolves; among bodies 0.03 sqrt(p L), with p the acceleration by gravity and forces and L the diameter of the smaller body, or its radius on a fixed thing.", .example = "0.01", .member = fills<Simulate, &Simulate::rest_speed>},
    {.key = "max_collisions", .type = Type::whole, .range = from_1, .doc = "A run with more collisions stops with an error.", .example = "1000000", .title = "Maximum number of collisions", .member = fills<Simulate, &Simulate::max_collisions>},
    {.key = "integrator", .type = Type::choice, .of = integrator_names, .doc = "Integrator of engine stepped. dop853: Dormand-Prince, order 8, chooses its steps; euler: semi-implicit, order 1; verlet: velocity Verlet, order 2; rk4: Runge-Kutta, order 4. Default: dop853; with a step: rk4.", .example = "verlet", .member = fills_if_given<Simulate, &Simulate::integrator>},
    {.key = "contact", .type = Type::part, .of = "contact", .doc = "What happens where bodies meet. A word alone is `mode`.", .example = "{quality: fast}", .plain = "mode", .member = fills_if_given<Simulate, &Simulate::contact>},
    {.key = "tolerance", .type = Type::number, .unit = "m", .range = above_0, .one_of = "step|tolerance", .doc = "Tolerance of positions, instead of step. If it cannot be met, a warning gives the time until which it holds and the error after that. The scene is simulated several times.", .example = "0.000001", .engines = "auto|exact|stepped", .member = fills<Simulate, &Simulate::tolerance>},
};

constexpr Field contact_fields[] = {
    {.key = "mode", .type = Type::choice, .of = "bounce|merge", .doc = "Whether bodies that meet bounce or merge into one; merge needs engine exact, which auto may choose.", .example = "merge", .engines = "auto|exact", .member = fills<ContactSettings, &ContactSettings::merge>},
    {.key = "quality", .type = Type::choice, .of = quality_names, .doc = "How finely pours, piles and heaps are computed: bodies with contacts that change too often to be followed one by one. Each level has a length of steps, an accuracy of forces and a gap that contacts keep, 1/1000 of the least radius at normal. preview may overlap by a twentieth of a radius.", .example = "fast", .member = fills<ContactSettings, &ContactSettings::quality>},
};

constexpr Field stop_fields[] = {
    {.key = "collisions", .type = Type::whole, .range = from_1, .one_of = "collisions|region", .needed = true, .doc = "After so many collisions, and those at the same instant.", .example = "100", .title = "Number of collisions", .member = fills<StopKeys, &StopKeys::collisions>},
    {.key = "region", .type = Type::name, .one_of = "collisions|region", .doc = "When a body enters this region.", .example = "pocket", .pattern = R"(^[A-Za-z_][A-Za-z0-9_-]*(\.[0-9]+)?$)", .member = fills<StopKeys, &StopKeys::region>},
};

constexpr Field camera_fields[] = {
    {.key = "eye", .type = Type::vector, .unit = "m", .one_of = "eye|fit|path", .needed = true, .spared_by = "follow", .doc = "Position of the camera; with follow at time 0.", .example = "[0, 3, -5]", .title = "Position of the camera", .with = "target", .member = fills<CameraKeys, &CameraKeys::eye>},
    {.key = "target", .type = Type::vector, .unit = "m", .one_of = "target|fit|path", .doc = "Point that the camera looks at; with follow at time 0.", .example = "[0, 0, 0]", .member = fills_if_given<CameraKeys, &CameraKeys::target>},
    {.key = "up", .type = Type::direction, .doc = "Direction that is up in the picture.", .example = "[0, 0, 1]", .title = "Up in the picture", .member = fills<CameraKeys, &CameraKeys::up>},
    {.key = "fov", .type = Type::number, .unit = "degrees", .range = {0, 180, true, true}, .doc = "Field of view, the full angle along fov_axis.", .example = "30", .title = "Field of view", .member = fills<CameraKeys, &CameraKeys::fov>},
    {.key = "fov_axis", .type = Type::choice, .of = "vertical|horizontal", .doc = "Axis along which fov is measured.", .example = "horizontal", .title = "Axis of the field of view", .member = fills<CameraKeys, &CameraKeys::fov_horizontal>},
    {.key = "near", .type = Type::number, .unit = "m", .range = above_0, .one_of = "near|fit", .spared_by = "path", .doc = "Nothing nearer is drawn.", .example = "1", .title = "Near limit", .with = "eye", .member = fills<CameraKeys, &CameraKeys::near>},
    {.key = "far", .type = Type::number, .unit = "m", .range = above_0, .one_of = "far|fit", .spared_by = "path", .doc = "Nothing farther is drawn.", .example = "100", .title = "Far limit", .with = "eye", .member = fills<CameraKeys, &CameraKeys::far>},
    {.key = "fit", .type = Type::choice, .of = "motion", .one_of = "fit|follow|path|eye|target|near|far", .doc = "Frames where the bodies go during the time shown, with the walls and obstacles that they meet, and the points that strings hang from.", .example = "motion", .title = "Framing", .member = fills<CameraKeys, &CameraKeys::fit>},
    {.key = "follow", .type = Type::name, .one_of = "follow|fit|path", .doc = "A ball, body, group or member (gas.3): eye and target go with its centre of mass. Default of target: that centre; of eye: a view from the front, slightly from above.", .example = "red", .title = "Followed bodies", .pattern = reference, .member = fills<CameraKeys, &CameraKeys::follow>},
    {.key = "path", .type = Type::list, .of = "keyframe", .one_of = "path|fit|follow|eye|target", .doc = "Views at times in order; the camera moves smoothly from one to the next.", .example = "[{at: 0, eye: [0, 3, -5], target: [0, 0, 0]}, {at: 2, eye: [5, 3, 0], target: [0, 0, 0]}]", .needs_entries = true},
};

constexpr Field keyframe_fields[] = {
    {.key = "at", .type = Type::number, .unit = "s", .range = from_0, .needed = true, .doc = "Time of the view, later than that of the entry before.", .example = "1.5", .title = "Time", .member = fills<KeyframeKeys, &KeyframeKeys::at>},
    {.key = "eye", .type = Type::vector, .unit = "m", .needed = true, .doc = "Position of the camera.", .example = "[0, 3, -5]", .title = "Position of the camera", .member = fills<KeyframeKeys, &KeyframeKeys::eye>},
    {.key = "target", .type = Type::vector, .unit = "m", .needed = true, .doc = "Point that the camera looks at.", .example = "[0, 0, 0]", .member = fills<KeyframeKeys, &KeyframeKeys::target>},
    {.key = "fov", .type = Type::number, .unit = "degrees", .range = {0, 180, true, true}, .doc = "Field of view. Default: that of the camera.", .example = "30", .title = "Field of view", .member = fills<KeyframeKeys, &KeyframeKeys::fov>},
};

constexpr Field coloring_fields[] = {
    {.key = "by", .type = Type::choice, .of = quantity_names, .needed = true, .doc = "The quantity. speed in m/s; kinetic: the kinetic energy in J; collisions: their number so far; mass in kg; radius in m, of a box or cylinder that of the ball around it; group: a colour for each ball, body or group.", .example = "speed", .title = "Quantity", .member = fills<Coloring, &Coloring::by>},
    {.key = "min", .type = Type::number, .doc = "The quantity at the start of the map; smaller values have the same colour. Default: 0; of mass and radius the least, rounded down to two digits.", .example = "0", .title = "Start of the scale", .member = fills<Coloring, &Coloring::min>},
    {.key = "max", .type = Type::number, .doc = "The quantity at the end of the map; greater values have the same colour. Default of speed and kinetic: what a body has at time 0 or reaches by falling from there, rounded up; of collisions 10; of mass and radius the greatest, rounded up to two digits.", .example = "5", .title = "End of the scale", .member = fills<Coloring, &Coloring::max>},
    {.key = "map", .type = Type::choice, .of = color_map_names, .doc = "Colours from the start to the end of the scale.", .example = "cividis", .title = "Colour map", .member = fills<Coloring, &Coloring::map>},
};

constexpr Field trails_fields[] = {
    {.key = "seconds", .type = Type::number, .unit = "s", .range = above_0, .doc = "Length of a trail in time.", .example = "0.5", .title = "Length in time", .member = fills<TrailKeys, &TrailKeys::seconds>},
    {.key = "width", .type = Type::number, .unit = "m", .range = above_0, .doc = "Width of a trail. Default: half the radius of its body.", .example = "0.02", .member = fills<TrailKeys, &TrailKeys::width>},
    {.key = "on", .type = Type::names, .doc = "Balls, bodies, groups and members that have a trail. Default: all.", .example = "[red, gas.3]", .title = "Bodies that have a trail", .pattern = reference, .member = fills<TrailKeys, &TrailKeys::on>},
};

constexpr Field ambient{.key = "ambient", .type = Type::color, .doc = "Colour of the ambient light, which comes from all directions.", .example = "dimgray"};

constexpr Field light_fields[] = {
    {.key = "direction", .type = Type::direction, .one_of = "direction|position", .needed = true, .doc = "Direction in which the light travels, from infinitely far.", .example = "[1, -2, 1]", .member = fills<Light, &Light::direction>},
    {.key = "position", .type = Type::vector, .unit = "m", .one_of = "direction|position", .doc = "Position of a lamp, instead of direction.", .example = "[0, 5, 0]", .member = fills<Light, &Light::position>},
    {.key = "color", .type = Type::color, .doc = "Its colour.", .example = "lightyellow", .member = fills<Light, &Light::color>},
    {.key = "intensity", .type = Type::number, .range = from_0, .doc = "Brightness; 1 is usual.", .example = "0.8", .member = fills<Light, &Light::intensity>},
    repeat,
};

// clang-format on

constexpr Kind kinds_of_scenes[] = {
    {"scene", "the", "One scene: its bodies, surfaces, forces and outputs.", scene_fields},
    {"restitution", "", "How bodies bounce off one another.", restitution_fields},
    {"pair", "a", "A coefficient of restitution for two things, which overrides their own.", pair_fields},
    {"defaults", "", "Default values for things of each kind.", defaults_fields},
    {"ball", "a", "A sphere that moves without turning.", ball_fields, nullptr, "ball"},
    {"body", "a", "A body with any bounding volume; it moves without turning.", body_fields, nullptr, "body"},
    {"cylinder", "a", "An upright cylinder.", cylinder_fields},
    {"member", "a", "The ball of a group.", member_fields, nullptr, "ball"},
    {"group", "a", "Many balls made by rule, without overlap, the same on every machine.", group_fields, nullptr,
     "group"},
    {"in", "", "An axis-aligned box.", in_fields},
    {"placed", "a", "The position and velocity of one of a group's balls.", placed_fields},
    {"plane", "a", "An unbounded fixed surface, free on one side.", plane_fields, nullptr, "plane"},
    {"wall", "a", "A two-sided fixed rectangle.", wall_fields, nullptr, "wall"},
    {"room", "", "Six planes that face inward.", room_fields},
    {"obstacle", "an", "A body that no impact moves.", obstacle_fields, nullptr, "obstacle"},
    {"motion", "a", "A window of time in which a fixed thing moves.", motion_fields},
    {"string", "a", "A string without mass that does not stretch: slack while its ends are nearer than its length.",
     string_fields, nullptr, "string"},
    {"region", "a", "A region of space that the centres of bodies enter and leave.", region_fields},
    {"side", "", "One side of a plane.", side_fields},
    {"force", "a", "A force on bodies, for the whole run or a window of time.", force_fields},
    {"drag", "", "Drag of a medium, against a body's velocity relative to it.", drag_fields, nullptr, "",
     "linear|quadratic"},
    {"spring", "", "A spring from a fixed point, with a damper in parallel.", spring_fields},
    {"attractor", "", "Attraction to a fixed point by the inverse square of the distance.", attractor_fields},
    {"start", "", "The former run from which bodies begin.", start_fields},
    {"simulate", "", "Duration, engine and accuracy.", simulate_fields},
    {"contact", "", "What happens where bodies meet.", contact_fields},
    {"stop", "a", "A condition that ends the run.", stop_fields},
    {"camera", "", "Camera of the pictures.", camera_fields},
    {"keyframe", "a", "A view at a time.", keyframe_fields},
    {"light", "a", "A light.", light_fields, &ambient},
    {"coloring", "", "Colours of bodies by a quantity, with a legend in the picture.", coloring_fields},
    {"trails", "", "Trails of bodies.", trails_fields},
};

/// The rows, completed with the defaults of their members, the rows of the outputs, and the kinds that they name.
class FormatTable {
 public:
  FormatTable() {
    for (const Kind& kind : kinds_of_scenes) add(scenes_, kind);
    vector<Field> of_output;
    for (const OutputKind& kind : output_kinds()) of_output.push_back(kind.row());
    add(scenes_, {"output", "", "What the run writes; an output that is absent is not written.", of_output});
    for (const OutputKind& kind : output_kinds()) {
      if (kind.keys.empty()) continue;
      Kind map{kind.name, "", kind.keys_doc, kind.keys};
      map.beneath = kind.beneath;
      add(scenes_, map);
    }
    for (const Kind& kind : sweep_rows()) add(sweeps_, kind);

    for (vector<Field>& fields : fields_)
      for (Field& field : fields) join(field);
  }

  span<const Kind> scenes() const { return scenes_; }
  span<const Kind> sweeps() const { return sweeps_; }

  const Kind* find(string_view name) const {
    for (const vector<Kind>* kinds : {&scenes_, &sweeps_})
      if (const auto kind = std::ranges::find(*kinds, name, &Kind::name); kind != kinds->end()) return &*kind;
    return nullptr;
  }

 private:
  void add(vector<Kind>& kinds, Kind kind) {
    vector<Field>& fields = fields_.emplace_back(kind.fields.begin(), kind.fields.end());
    for (Field& field : fields)
      if (field.member.initial != nullptr) field.initial = texts_.emplace_back(field.member.initial(field));
    kind.fields = fields;
    kinds.push_back(kind);
  }

  void join(Field& field) {
    const Inside inside = facts_of(field.type).inside;
    const bool holds_maps = inside != Inside::nothing && inside != Inside::numbers && inside != Inside::values;
    if (holds_maps && (field.held = find(field.of)) == nullptr) std::abort();  // a row names no kind
    if (!field.initial.empty()) field.initial_node = parsed(field.initial);
  }

  /// The tree of a default. Each text is parsed once.
  const Node* parsed(string_view text) {
    if (const auto known = nodes_.find(text); known != nodes_.end()) return &known->second;
    const vector<Source> sources = {{"", string(text)}};
    Diagnostics diagnostics(sources);
    return &nodes_.emplace(text, parse_document(sources, 0, 0, diagnostics).value()).first->second;
  }

  /// The texts that the rows refer to.
  std::deque<string> texts_;
  std::map<string_view, Node> nodes_;  // by Field::initial
  std::deque<vector<Field>> fields_;   // by kind
  vector<Kind> scenes_, sweeps_;
};

const FormatTable& format_table() {
  static const FormatTable table;
  return table;
}

}  // namespace

span<const Kind> kinds() {
  return format_table().scenes();
}

span<const Kind> sweep_kinds() {
  return format_table().sweeps();
}

vector<span<const Kind>> families() {
  return {kinds(), sweep_kinds()};
}

const Kind* find_kind(string_view name) {
  return format_table().find(name);
}

const Kind& kind_named(string_view name) {
  return *find_kind(name);
}

}  // namespace carom
