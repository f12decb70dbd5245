// The rows of the scene format, and the table that gives access to them.
// Defaults come from the structs that the keys fill, so that a default is written once.
// The table is completed at first use, because texts of defaults cannot be made at compile time.
#include "scene/fields.h"

#include <cstdlib>
#include <deque>

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

constexpr Range above_0{0, infinity, true, false};
constexpr Range from_0{0, infinity, false, false};
constexpr Range from_1{1, infinity, false, false};

// clang-format off
constexpr Field scene_fields[] = {
    row("scene", "Kind of file and version of the format.", "1", {.type = Type::whole, .range = {1, 1}, .needed = true, .title = "Format"}),
    row("title", "Title of the scene, one line.", "Two bowling balls meet near the origin", {.type = Type::text, .initial = "\"\""}),
    row("seed", "The only source of randomness.", "7", {.type = Type::whole, .range = from_0, .initial = "0"}),
    row("let", "Numbers with names. Wherever a number may stand, a text that begins with = is an expression of them.", "{r: 0.05, gap: '= r / 10'}", {.type = Type::values, .title = "Numbers with names"}),
    row("gravity", "Acceleration of every body; y is up.", "[0, 0, 0]", {.type = Type::vector, .unit = "m/s^2", .initial = "[0, -9.80665, 0]"}),
    row("restitution", "How bodies bounce off one another. A number alone is `default`.", "{default: 0.9, combine: minimum}", {.type = Type::part, .of = "restitution", .plain = "default"}),
    row("defaults", "Default values for things of each kind.", "{ball: {mass: 10, radius: 0.11, restitution: 0.9}}", {.type = Type::part, .of = "defaults"}),
    row("balls", "Single balls by name.", "{red: {mass: 10, radius: 0.11, position: [3, 1, 0], velocity: [-2, 0, 0], color: crimson}}", {.type = Type::named, .of = "ball"}),
    row("bodies", "Movable bodies with any bounding volume.", "{crate: {mass: 2, box: [0.4, 0.3, 0.4], position: [-1, 1, 0]}}", {.type = Type::named, .of = "body"}),
    row("groups", "Many balls made by rule, by name.", "{gas: {count: 20, in: {min: [-2, 2, -2], max: [2, 4, 2]}, speed: 1, ball: {mass: 1, radius: 0.1}}}", {.type = Type::named, .of = "group"}),
    row("planes", "Unbounded fixed surfaces, free on one side.", "{floor: {point: [0, 0, 0], normal: [0, 1, 0], color: tan}}", {.type = Type::named, .of = "plane"}),
    row("walls", "Two-sided fixed rectangles.", "{fence: {center: [5, 1, 0], normal: [-1, 0, 0], size: [2, 2]}}", {.type = Type::named, .of = "wall"}),
    row("room", "Six planes that face inward: room.x_min to room.z_max.", "{min: [-9, -1, -9], max: [9, 9, 9]}", {.type = Type::part, .of = "room"}),
    row("obstacles", "Bodies that no impact moves.", "{post: {cylinder: {radius: 0.1, height: 1}, position: [-3, 1, 0]}}", {.type = Type::named, .of = "obstacle"}),
    row("strings", "Strings and rods without mass, between bodies, or from a point to a body.", "{s1: {from: [-1, 2, 0], to: crate, length: 1.5}}", {.type = Type::named, .of = "string"}),
    row("regions", "Regions of space that the centres of bodies enter and leave. They touch nothing, and pictures do not show them.", "{pocket: {radius: 0.3, position: [-6, 0, 0], action: remove}}", {.type = Type::named, .of = "region"}),
    row("forces", "Forces on bodies, in addition to gravity.", "[{drag: {linear: 0.1}}]", {.type = Type::list, .of = "force"}),
    row("start", "Begins with the bodies of a finished run: each body of this scene that the run has, by name, has its position and velocity there, and no impulse. All else is as this scene gives it, and time starts at 0.", "{run: ../output/first, at: 2}", {.type = Type::part, .of = "start"}),
    row("simulate", "Duration, engine and accuracy.", "{duration: 2}", {.type = Type::part, .of = "simulate", .needed = true}),
    row("camera", "Camera of the pictures. Default: {fit: motion}.", "{eye: [0, 3, -5], target: [0, 0, 0]}", {.type = Type::part, .of = "camera", .drawn = true}),
    row("look", "Floor, backdrop, lights, colours and outlines in one word. Each part may be given by keys of its own: background, lights, color, finish.", "night", {.type = Type::choice, .initial = "studio", .of = look_names, .drawn = true}),
    row("lights", "Lights by name, and `ambient`, the colour of the ambient light.", "{sun: {direction: [1, -2, 1]}, ambient: dimgray}", {.type = Type::named, .of = "light", .drawn = true}),
    row("background", "Background colour; none: transparent, in PNG, GIF and WebP.", "skyblue", {.type = Type::color_or_none, .drawn = true}),
    row("caption", "A text in each picture. Names in braces become values: {title}, {time} in s, {run} (the name of the run's folder), {collisions} (so far), and paths into the scene, such as {restitution.default}. Two braces are one. A text that begins with a brace needs quotes. true: the title and the time.", "\"{title}, t = {time} s\"", {.type = Type::text_or_flag, .title = "Text in the pictures", .drawn = true}),
    row("trails", "The paths of bodies during the last seconds, which fade with age.", "{seconds: 0.5}", {.type = Type::part_or_flag, .of = "trails", .drawn = true}),
    row("flash", "Whether bodies glow white for 0.1 s of film after a collision, and fade to their colour.", "true", {.type = Type::flag, .title = "Flash of collisions", .drawn = true}),
    row("arrows", "Arrows at the bodies. velocity; momentum: mass times velocity, and in a corner the sum over all bodies; force: gravity and `forces`, without contact. The legend has their scale.", "[velocity]", {.type = Type::names, .of = "velocity|momentum|force", .drawn = true}),
    row("labels", "Values beside each body that is seen. momentum: mass times speed. A list alone is `show`.", "[speed]", {.type = Type::part, .of = "labels", .title = "Values beside bodies", .plain = "show", .drawn = true}),
    row("scale_bar", "A bar of round length in the lower right corner, with its length. It is exact at the depth of the camera's target.", "true", {.type = Type::flag, .drawn = true}),
    row("shutter", "Motion blur: a picture is the mean of the light during this part of the interval between pictures, until its time. At most 32 instants make a picture.", "0.5", {.range = {0, 1}, .title = "Open part of the interval between pictures", .drawn = true}),
    row("measures", "Measures of the run by name, columns of summary.csv: a number of summary.csv, a quantity at the end (balls.red.y_m), max, min, time_of_max, time_of_min or mean of one over the run, first(a, b) in s, hits(a, b), impulse(a, b) in N s, of these over a part of the run with from and until such as max(balls.red.y_m, from: 1, until: 2), regions.NAME.entries, inside, first_s or first, count(y_m < 0). Or an expression of these that begins with =.", "{height_m: max(balls.red.y_m), share: '= hits(red, blue) / collisions'}", {.type = Type::texts, .title = "Measures of the run"}),
    row("output", "What the run writes. Default: trajectory, collisions and energy, no pictures.", "{trajectory: {every: 0.01}, collisions: true, energy: true}", {.type = Type::part, .of = "output"}),
};

constexpr Field restitution_fields[] = {
    row<RestitutionKeys, &RestitutionKeys::coefficient>("default", "Coefficient of a body without one of its own.", "0.9", {.range = from_0, .title = "Default coefficient of restitution"}),
    row<RestitutionKeys, &RestitutionKeys::combine>("combine", "How two bodies' coefficients combine into the pair's; book is e1 e2 / 2.", "minimum", {.of = "average|minimum|maximum|product|geometric_mean|mass_weighted|book", .title = "Rule for two coefficients"}),
    row("pairs", "Pairs with a coefficient of their own; the last match wins.", "[{between: [red, floor], value: 0.5}]", {.type = Type::list, .of = "pair"}),
};

constexpr Field pair_fields[] = {
    row<PairKeys, &PairKeys::between>("between", "Two names: balls, bodies, groups, members (gas.3), planes, walls, obstacles, room, room.y_min.", "[red, floor]", {.type = Type::two_names, .needed = true, .title = "Two names", .pattern = reference}),
    row<PairKeys, &PairKeys::value>("value", "The pair's coefficient of restitution. none: the two pass through each other.", "0.5", {.type = Type::number_or_none, .range = from_0, .needed = true, .title = "Coefficient of restitution"}),
};

constexpr Field defaults_fields[] = {
    row("ball", "For every ball, and every group's ball.", "{mass: 10, radius: 0.11}", {.type = Type::part, .of = "ball"}),
    row("body", "For every body.", "{density: 700}", {.type = Type::part, .of = "body"}),
    row("plane", "For every plane.", "{restitution: 1}", {.type = Type::part, .of = "plane"}),
    row("wall", "For every wall.", "{size: [2, 1]}", {.type = Type::part, .of = "wall"}),
    row("obstacle", "For every obstacle.", "{radius: 0.1}", {.type = Type::part, .of = "obstacle"}),
    row("group", "For every group.", "{speed: 1}", {.type = Type::part, .of = "group"}),
    row("string", "For every string.", "{restitution: 0.2}", {.type = Type::part, .of = "string"}),
};

constexpr Field mass = row<BodyKeys, &BodyKeys::mass>("mass", "Mass.", "10", {.unit = "kg", .range = above_0, .one_of = "mass|density", .needed = true});
constexpr Field density = row<BodyKeys, &BodyKeys::density>("density", "Mass per volume, instead of mass.", "700", {.unit = "kg/m^3", .range = above_0, .one_of = "mass|density"});
constexpr Field radius = row<BodyKeys, &BodyKeys::radius>("radius", "Radius.", "0.11", {.unit = "m", .range = above_0, .needed = true});
constexpr Field ball_velocity = row<BodyKeys, &BodyKeys::velocity>("velocity", "Velocity at time 0.", "[2, 0, 0]", {.unit = "m/s"});
constexpr Field ball_restitution = row<BodyKeys, &BodyKeys::restitution>("restitution", "Coefficient of restitution; above 1 adds energy. Default: restitution.default.", "0.9", {.range = from_0});
constexpr Field impulse = row_if_given<BodyKeys, &BodyKeys::impulse>("impulse", "Impulse at time 0.", "[-20, 0, 0]", {.unit = "N s"});
constexpr Field body_color_field = row_if_given<BodyKeys, &BodyKeys::color>("color", "Colour in pictures, or colours by a quantity. Default: those of the mesh file, or one is chosen.", "crimson", {.of = "coloring", .drawn = true});
template <typename Keys> constexpr Field color = row_if_given<Keys, &Keys::color>("color", "Colour in pictures. Default: that of the look.", "crimson", {.drawn = true});
template <typename Keys> constexpr Field finish = row_if_given<Keys, &Keys::finish>("finish", "How its surface reflects light. glow: it sends out light of its colour. Default: plastic; of a plane matte; of a room glass, and its floor matte.", "metal", {.of = finish_names, .drawn = true});
template <typename Keys> constexpr Field opacity = row_if_given<Keys, &Keys::opacity>("opacity", "Part of what is behind it that it hides. Default: 1; of glass 0.2.", "0.4", {.range = {0, 1}, .drawn = true});
constexpr Field mesh = row<BodyKeys, &BodyKeys::mesh>("mesh", "Mesh file, drawn scaled to the ball. Without `color` it has the colours and textures of the file.", "meshes/duck.obj", {.type = Type::file_or_part, .of = "mesh", .drawn = true});
constexpr Field ball_position = row<BodyKeys, &BodyKeys::position>("position", "Centre at time 0.", "[3, 1, 0]", {.unit = "m", .needed = true});

// The members of a repeated thing replace it before its map is checked and decoded (expand.h).
constexpr Field repeat = row("repeat", "Makes members name.0, name.1, ... of this map. Its expressions may contain the index i, or the indices named here; the last one varies fastest.", "{i: 6, j: 4}", {.type = Type::repeat, .title = "Number of members", .own = true});

constexpr string_view appear_doc = "When it comes into the world; without it, it is there from the start. What is in its place then must leave first. Its position, velocity and impulse are those of this instant.";
constexpr Field appear = row_if_given<BodyKeys, &BodyKeys::appear>("appear", appear_doc, "1.5", {.unit = "s", .range = from_0});

constexpr Field ball_fields[] = {
    mass, density, radius,
    ball_position, ball_velocity, ball_restitution, impulse, appear, body_color_field, finish<BodyKeys>, opacity<BodyKeys>, mesh, repeat,
};

constexpr string_view volumes = "radius|cylinder|box|fit";

// A body's volume is one of these four keys. A mesh with `fit` is the volume itself.
// A mesh beside one of the other three is drawn in its place.
template <typename Keys> constexpr Field radius_of = row<Keys, &Keys::radius>("radius", "Radius of a sphere.", "0.11", {.unit = "m", .range = above_0, .one_of = volumes, .needed = true});
template <typename Keys> constexpr Field cylinder = row<Keys, &Keys::cylinder>("cylinder", "An upright cylinder, its axis along y.", "{radius: 0.1, height: 1}", {.of = "cylinder", .one_of = volumes});
template <typename Keys> constexpr Field box = row<Keys, &Keys::box>("box", "An axis-aligned box: its full edge lengths.", "[0.4, 0.3, 0.4]", {.unit = "m", .range = above_0, .one_of = volumes});
template <typename Keys> constexpr Field fit = row<Keys, &Keys::fit>("fit", "The tightest such volume around the mesh; position is its centre.", "box", {.of = "sphere|cylinder|box", .one_of = volumes, .with = "mesh"});
template <typename Keys> constexpr Field mesh_of = row<Keys, &Keys::mesh>("mesh", "Mesh file: in its own size with `fit`, else drawn scaled into the volume. Without `color` it has the colours and textures of the file.", "meshes/pin.obj", {.type = Type::file_or_part, .of = "mesh", .drawn = true});

constexpr Field mesh_fields[] = {
    row<MeshKeys, &MeshKeys::file>("file", "Mesh file.", "meshes/part.stl", {.type = Type::file, .needed = true}),
    row<MeshKeys, &MeshKeys::scale>("scale", "Size of the file's unit with `fit`: 0.001 for mm. A volume that is given has its own size.", "0.001", {.unit = "m", .range = above_0, .title = "Size of the file's unit"}),
    row<MeshKeys, &MeshKeys::up>("up", "The axis of the file that is up in the world.", "z", {.of = "x|y|z", .title = "Axis that is up"}),
    row<MeshKeys, &MeshKeys::turn>("turn", "Angles by which the mesh is turned about x, then y, then z of the world, after `up`.", "[30, 0, 0]", {.unit = "degrees", .range = {-360, 360}, .title = "Turn"}),
};

constexpr Field body_fields[] = {
    mass, density, radius_of<BodyKeys>, cylinder<BodyKeys>, box<BodyKeys>, mesh_of<BodyKeys>, fit<BodyKeys>,
    ball_position, ball_velocity, ball_restitution, impulse, appear, body_color_field, finish<BodyKeys>, opacity<BodyKeys>, repeat,
};

constexpr Field cylinder_fields[] = {
    row<CylinderKeys, &CylinderKeys::radius>("radius", "Radius.", "0.1", {.unit = "m", .range = above_0, .needed = true}),
    row<CylinderKeys, &CylinderKeys::height>("height", "Height, along y.", "1", {.unit = "m", .range = above_0, .needed = true}),
};

constexpr Field radius_or_radii = row<BodyKeys, &BodyKeys::radius>("radius", "Radius. A map: each ball has its own, uniform by the seed; with `density` also its own mass.", "{from: 0.02, to: 0.05}", {.type = Type::number_or_part, .unit = "m", .range = above_0, .of = "radii", .needed = true});

constexpr Field radii_fields[] = {
    row<RadiiKeys, &RadiiKeys::from>("from", "The least radius.", "0.02", {.unit = "m", .range = above_0, .needed = true, .title = "Least radius"}),
    row<RadiiKeys, &RadiiKeys::to>("to", "The greatest radius, which none reaches.", "0.05", {.unit = "m", .range = above_0, .needed = true, .title = "Greatest radius"}),
};

constexpr Field member_fields[] = {mass, density, radius_or_radii, ball_velocity, ball_restitution, impulse, body_color_field, finish<BodyKeys>, opacity<BodyKeys>, mesh};

constexpr Field placed_fields[] = {
    row<PlacedKeys, &PlacedKeys::position>("position", "Centre at time 0.", "[3, 1, 0]", {.unit = "m", .needed = true}),
    row_if_given<PlacedKeys, &PlacedKeys::velocity>("velocity", "Velocity at time 0. Default: that of the group's ball.", "[2, 0, 0]", {.unit = "m/s"}),
    row<PlacedKeys, &PlacedKeys::radius>("radius", "Radius. Default: that of the group's ball.", "0.11", {.unit = "m", .range = above_0}),
    row<PlacedKeys, &PlacedKeys::mass>("mass", "Mass. Default: that of the group's ball, or by its density.", "10", {.unit = "kg", .range = above_0}),
};

constexpr Field start_fields[] = {
    row<StartKeys, &StartKeys::run>("run", "The folder of a finished run, from the scene file's folder.", "../output/first", {.needed = true, .title = "Folder of the run"}),
    row_if_given<StartKeys, &StartKeys::at>("at", "Time of the run. Default: its end. Of a run without flights: a time of its trajectory.csv.", "2", {.unit = "s", .range = from_0, .title = "Time of the run"}),
};

constexpr Field group_fields[] = {
    row<GroupKeys, &GroupKeys::count>("count", "Number of balls: name.0, name.1, ...", "20", {.range = from_0, .one_of = "count|rate|table", .needed = true}),
    row("ball", "A ball of the group, without position. Not needed where defaults.ball has all of it.", "{mass: 1, radius: 0.1}", {.type = Type::part, .of = "member", .needed = true, .spared_by = "table"}),
    row<GroupKeys, &GroupKeys::table>("table", "A CSV file with a line for each ball, in place of `count` and `in`. Columns x_m, y_m, z_m, and where present vx_m_per_s, vy_m_per_s, vz_m_per_s, radius_m, mass_kg, which override the ball's; other columns are ignored.", "packing.csv", {.type = Type::file, .one_of = "table|count|rate|in|arrange|speed|members", .title = "Table of the balls"}),
    row_if_given<GroupKeys, &GroupKeys::overlap>("overlap", "What happens to balls that overlap something at time 0. push: they are moved apart, if by less than 1/1000 of the smaller radius. Default: refuse.", "push", {.of = "refuse|push", .title = "Overlap at time 0"}),
    row<GroupKeys, &GroupKeys::in>("in", "The box, ball or cylinder that every ball lies wholly inside.", "{min: [-2, 2, -2], max: [2, 4, 2]}", {.of = "in", .one_of = "in|members|table", .needed = true, .title = "Space of the balls"}),
    row_if_given<GroupKeys, &GroupKeys::appear>("appear", "When the balls come into the world, each where its place is free. Default: they are there from the start.", "1.5", {.unit = "s", .range = from_0, .one_of = "appear|rate"}),
    row_if_given<GroupKeys, &GroupKeys::rate>("rate", "Balls that come one after the other, so many in a second, in place of `count`. Each comes at a place in `in` where there is room, by the seed; where there is none, it tries again after 1/rate.", "50", {.unit = "1/s", .range = above_0, .one_of = "rate|count|table|members|arrange|appear", .title = "Balls in a second"}),
    row_if_given<GroupKeys, &GroupKeys::from>("from", "When the first ball of `rate` comes. Default: 0.", "0", {.unit = "s", .range = from_0, .with = "rate"}),
    row_if_given<GroupKeys, &GroupKeys::until>("until", "The balls of `rate` come before this time. Default: the run's end.", "4", {.unit = "s", .range = from_0, .with = "rate"}),
    row<GroupKeys, &GroupKeys::arrange>("arrange", "random; lattice: cubic, spread evenly over the space; hexagonal: close-packed layers, spread as far as the space allows.", "hexagonal", {.of = "random|lattice|hexagonal", .one_of = "arrange|members|rate|table"}),
    row<GroupKeys, &GroupKeys::speed>("speed", "Standard deviation of each component of a ball's velocity.", "1", {.unit = "m/s", .range = from_0, .one_of = "speed|velocity|members|table"}),
    row<GroupKeys, &GroupKeys::velocity>("velocity", "Velocity of every ball at time 0.", "[0, -1, 0]", {.unit = "m/s", .one_of = "speed|velocity|members"}),
    row("members", "Each ball's position, and what it has for itself, as many as `count`.", "[{position: [0, 2, 0], velocity: [1, 0, 0]}]", {.type = Type::list, .of = "placed", .one_of = "members|in|arrange|speed|velocity|rate|table", .title = "Balls one by one"}),
    repeat,
};

constexpr Field in_fields[] = {
    row<SpaceKeys, &SpaceKeys::min>("min", "Lowest corner of a box.", "[-2, 2, -2]", {.unit = "m", .one_of = "min|radius|cylinder|position", .needed = true, .title = "Lowest corner", .with = "max"}),
    row<SpaceKeys, &SpaceKeys::max>("max", "Highest corner of a box.", "[2, 4, 2]", {.unit = "m", .one_of = "max|radius|cylinder|position", .title = "Highest corner", .with = "min"}),
    row<SpaceKeys, &SpaceKeys::radius>("radius", "Radius of a ball of space.", "2", {.unit = "m", .range = above_0, .one_of = "radius|cylinder|min|max"}),
    row<SpaceKeys, &SpaceKeys::cylinder>("cylinder", "An upright cylinder, its axis along y.", "{radius: 1, height: 3}", {.of = "cylinder", .one_of = "cylinder|radius|min|max"}),
    row<SpaceKeys, &SpaceKeys::position>("position", "Centre of the ball or the cylinder.", "[0, 3, 0]", {.unit = "m", .one_of = "position|min|max", .spared_by = "cylinder", .with = "radius"}),
};

template <typename Keys> constexpr Field fixed_restitution = row<Keys, &Keys::restitution>("restitution", "Coefficient of restitution. Default: the moving body's.", "0.5", {.range = from_0});
template <typename Keys> constexpr Field visible = row<Keys, &Keys::visible>("visible", "Whether it is drawn.", "false", {.drawn = true});

constexpr Field motion = row("motion", "How it moves: in windows of time, which may repeat, on a sine or on a circle. A list alone is `windows`. Of a plane only the part along the normal counts.", "[{from: 0, until: 2, velocity: [0, 0.5, 0]}]", {.type = Type::part, .of = "motion", .plain = "windows"});

constexpr Field motion_fields[] = {
    row("windows", "Windows of time in which it moves at a constant velocity, in order; outside them it stands where it has arrived.", "[{from: 0, until: 2, velocity: [0, 0.5, 0]}]", {.type = Type::list, .of = "window", .one_of = "windows|sine|circle", .needed = true}),
    row_if_given<MotionKeys, &MotionKeys::every>("every", "Time after which the windows repeat. It goes on from where it has arrived. Default: they do not.", "2", {.unit = "s", .range = above_0, .title = "Period", .with = "windows"}),
    row_if_given<MotionKeys, &MotionKeys::sine>("sine", "Back and forth for the whole run, about its place in the file.", "{amplitude: [0, 0.02, 0], period: 0.1}", {.of = "sine", .one_of = "windows|sine|circle"}),
    row_if_given<MotionKeys, &MotionKeys::circle>("circle", "Round an axis for the whole run, from its place in the file on. It does not turn.", "{center: [0, 1, 0], axis: [0, 0, 1], period: 4}", {.of = "circle", .one_of = "windows|sine|circle"}),
};

constexpr Field window_fields[] = {
    row<WindowKeys, &WindowKeys::from>("from", "When the motion starts. A map: at an event.", "0.5", {.type = Type::number_or_part, .unit = "s", .range = from_0, .of = "event", .title = "Start"}),
    row_if_given<WindowKeys, &WindowKeys::until>("until", "When the motion ends. A map: at an event. Default: never; of windows that repeat, with their period.", "{region: gate, after: 0.2}", {.type = Type::number_or_part, .unit = "s", .range = above_0, .of = "event", .title = "End"}),
    row<WindowKeys, &WindowKeys::velocity>("velocity", "Its velocity in this window.", "[0, 0.5, 0]", {.unit = "m/s", .needed = true}),
};

constexpr Field event_fields[] = {
    row<EventKeys, &EventKeys::region>("region", "The first entry of a body into this region.", "gate", {.type = Type::name, .one_of = "region|collision", .needed = true, .pattern = reference}),
    row<EventKeys, &EventKeys::collision>("collision", "The first collision of these two; of one name: with anything. A string collides where it goes taut.", "[red, crate]", {.type = Type::name_or_two, .one_of = "region|collision", .pattern = reference}),
    row<EventKeys, &EventKeys::after>("after", "Time from the event on.", "0.2", {.unit = "s", .range = from_0, .title = "Delay"}),
};

constexpr Field sine_fields[] = {
    row<SineKeys, &SineKeys::amplitude>("amplitude", "Its place is amplitude sin(360 t / period + phase) away from that in the file.", "[0, 0.02, 0]", {.unit = "m", .needed = true}),
    row<SineKeys, &SineKeys::period>("period", "Time of one swing back and forth.", "0.1", {.unit = "s", .range = above_0, .needed = true}),
    row<SineKeys, &SineKeys::phase>("phase", "Angle at time 0. At -90 it starts at rest, at the lowest place of an upward amplitude.", "-90", {.unit = "degrees", .range = {-3600, 3600}}),
};

constexpr Field circle_fields[] = {
    row<CircleKeys, &CircleKeys::center>("center", "Point of the axis.", "[0, 1, 0]", {.unit = "m", .needed = true}),
    row<CircleKeys, &CircleKeys::axis>("axis", "Direction of the axis, any length. Seen against it, the thing goes round to the left.", "[0, 0, 1]", {.type = Type::direction, .needed = true}),
    row<CircleKeys, &CircleKeys::period>("period", "Time of one turn.", "4", {.unit = "s", .range = above_0, .needed = true}),
};

constexpr Field plane_fields[] = {
    row<PlaneKeys, &PlaneKeys::point>("point", "Any point of the plane.", "[0, 0, 0]", {.unit = "m", .needed = true, .title = "A point of the plane"}),
    row<PlaneKeys, &PlaneKeys::normal>("normal", "Points to the free side; any length.", "[0, 1, 0]", {.type = Type::direction, .needed = true}),
    motion, fixed_restitution<PlaneKeys>, color<PlaneKeys>, finish<PlaneKeys>, opacity<PlaneKeys>, visible<PlaneKeys>, repeat,
};

constexpr Field wall_fields[] = {
    row<WallKeys, &WallKeys::center>("center", "Centre of the rectangle.", "[5, 1, 0]", {.unit = "m", .needed = true}),
    row<WallKeys, &WallKeys::normal>("normal", "Perpendicular to the rectangle; any length.", "[-1, 0, 0]", {.type = Type::direction, .needed = true}),
    row<WallKeys, &WallKeys::size>("size", "Width and height.", "[2, 2]", {.unit = "m", .range = above_0, .needed = true, .title = "Width and height"}),
    row<WallKeys, &WallKeys::up>("up", "Direction of the height, made perpendicular to the normal. Default: y; z for a level wall.", "[0, 1, 0.5]", {.type = Type::direction, .title = "Direction of the height"}),
    motion, fixed_restitution<WallKeys>, color<WallKeys>, finish<WallKeys>, opacity<WallKeys>, visible<WallKeys>, repeat,
};

constexpr Field room_fields[] = {
    row<RoomKeys, &RoomKeys::min>("min", "Lowest corner.", "[-9, -1, -9]", {.unit = "m", .needed = true, .title = "Lowest corner"}),
    row<RoomKeys, &RoomKeys::max>("max", "Highest corner.", "[9, 9, 9]", {.unit = "m", .needed = true, .title = "Highest corner"}),
    fixed_restitution<RoomKeys>, color<RoomKeys>, finish<RoomKeys>, opacity<RoomKeys>, visible<RoomKeys>,
};

constexpr Field obstacle_color = row_if_given<ObstacleKeys, &ObstacleKeys::color>("color", "Colour in pictures. Default: those of the mesh file, or that of the look.", "crimson", {.drawn = true});

constexpr Field obstacle_fields[] = {
    radius_of<ObstacleKeys>, cylinder<ObstacleKeys>, box<ObstacleKeys>, mesh_of<ObstacleKeys>, fit<ObstacleKeys>,
    row<ObstacleKeys, &ObstacleKeys::position>("position", "Centre.", "[-3, 1, 0]", {.unit = "m", .needed = true}),
    row_if_given<ObstacleKeys, &ObstacleKeys::inside>("inside", "Hollow: its surface alone, without thickness, for bodies inside; a tube's is tube.side, tube.bottom and tube.top, a box's box.x_min to box.z_max. Balls alone meet round ones.", "true", {.title = "Hollow"}),
    row_if_given<ObstacleKeys, &ObstacleKeys::open>("open", "Which ends a hollow one lacks. Default: none; a sphere open at the top is its lower half.", "top", {.of = "none|top|bottom|both", .title = "Open ends"}),
    motion, fixed_restitution<ObstacleKeys>, obstacle_color, finish<ObstacleKeys>, opacity<ObstacleKeys>, visible<ObstacleKeys>, repeat,
};

constexpr Field string_fields[] = {
    row<StringKeys, &StringKeys::from>("from", "One end: a fixed point, or the centre of a ball, body or member (gas.3).", "[-1, 2, 0]", {.type = Type::point_or_name, .unit = "m", .needed = true, .title = "One end", .pattern = reference}),
    row<StringKeys, &StringKeys::to>("to", "The other end: the centre of a ball, body or member (gas.3).", "crate", {.type = Type::name, .needed = true, .title = "The other end", .pattern = reference}),
    row<StringKeys, &StringKeys::length>("length", "Greatest distance of its ends; of a rod the distance. Default: the distance at time 0.", "1.5", {.unit = "m", .range = above_0}),
    row<StringKeys, &StringKeys::restitution>("restitution", "Coefficient of restitution where the string goes taut.", "0.2", {.range = from_0}),
    row<StringKeys, &StringKeys::rod>("rod", "Whether it keeps its ends apart, too.", "true", {.title = "Rod"}),
    row_if_given<StringKeys, &StringKeys::until>("until", "When it is cut. A map: at an event. Default: never.", "{region: gate}", {.type = Type::number_or_part, .unit = "s", .range = above_0, .of = "event", .title = "Cut"}),
    visible<StringKeys>, repeat,
};

constexpr string_view region_shapes = "radius|cylinder|box|plane";

constexpr Field region_fields[] = {
    row<RegionKeys, &RegionKeys::radius>("radius", "Radius of a sphere.", "0.3", {.unit = "m", .range = above_0, .one_of = region_shapes, .needed = true}),
    row<RegionKeys, &RegionKeys::cylinder>("cylinder", "An upright cylinder, its axis along y.", "{radius: 0.1, height: 1}", {.of = "cylinder", .one_of = region_shapes}),
    row<RegionKeys, &RegionKeys::box>("box", "An axis-aligned box: its full edge lengths.", "[0.4, 0.3, 0.4]", {.unit = "m", .range = above_0, .one_of = region_shapes}),
    row<RegionKeys, &RegionKeys::plane>("plane", "One side of a plane.", "{point: [0, -1, 0], normal: [0, -1, 0]}", {.of = "side", .one_of = "radius|cylinder|box|plane|position"}),
    row<RegionKeys, &RegionKeys::position>("position", "Centre.", "[-6, 0, 0]", {.unit = "m", .one_of = "position|plane", .needed = true}),
    row<RegionKeys, &RegionKeys::on>("on", "Balls, bodies, groups and members that enter and leave it. Default: all.", "[red, gas.3]", {.type = Type::names, .title = "Bodies that enter and leave it", .pattern = reference}),
    row<RegionKeys, &RegionKeys::action>("action", "What happens when a body's centre enters. remove: the body leaves the world; stop: the run ends.", "remove", {.of = "none|remove|stop"}),
    repeat,
};

constexpr Field side_fields[] = {
    row<SideKeys, &SideKeys::point>("point", "Any point of the plane.", "[0, -1, 0]", {.unit = "m", .needed = true, .title = "A point of the plane"}),
    row<SideKeys, &SideKeys::normal>("normal", "Points to the side that is the region; any length.", "[0, -1, 0]", {.type = Type::direction, .needed = true}),
};

constexpr string_view forces = "uniform|acceleration|drag|spring|attractor|gravitation";

constexpr Field force_fields[] = {
    row<ForceKeys, &ForceKeys::uniform>("uniform", "The same force on each body.", "[2, 0, 0]", {.unit = "N", .one_of = forces, .needed = true}),
    row<ForceKeys, &ForceKeys::acceleration>("acceleration", "The same acceleration of each body.", "[3, 0, 0]", {.unit = "m/s^2", .one_of = forces}),
    row<ForceKeys, &ForceKeys::drag>("drag", "Drag of air or another medium.", "{linear: 0.1, wind: [5, 0, 0]}", {.of = "drag", .one_of = forces}),
    row<ForceKeys, &ForceKeys::spring>("spring", "A spring from a fixed point to each body of `on`, or between two bodies.", "{anchor: [0, 3, 0], stiffness: 40, rest_length: 0.5}", {.of = "spring", .one_of = forces}),
    row<ForceKeys, &ForceKeys::attractor>("attractor", "Attraction to a fixed point, as by gravity.", "{center: [0, 0, 0], strength: 10}", {.of = "attractor", .one_of = forces}),
    row<ForceKeys, &ForceKeys::gravitation>("gravitation", "Mutual attraction of all bodies of `on`.", "{constant: 6.674e-11, softening: 0.01}", {.of = "gravitation", .one_of = forces}),
    row<ForceKeys, &ForceKeys::on>("on", "Balls, bodies, groups and members that it acts on. Default: all.", "[red, gas.3]", {.type = Type::names, .title = "Bodies that it acts on", .pattern = reference}),
    row<ForceKeys, &ForceKeys::from>("from", "When the force starts. A map: at an event.", "0.5", {.type = Type::number_or_part, .unit = "s", .range = from_0, .of = "event", .title = "Start"}),
    row_if_given<ForceKeys, &ForceKeys::until>("until", "When the force ends. A map: at an event. Default: never.", "{collision: [red, crate]}", {.type = Type::number_or_part, .unit = "s", .range = above_0, .of = "event", .title = "End"}),
    row_if_given<ForceKeys, &ForceKeys::visible>("visible", "Whether the spring is drawn. Default: true.", "false", {.with = "spring", .drawn = true}),
    repeat,
};

constexpr Field drag_fields[] = {
    row_if_given<Drag, &Drag::linear>("linear", "Force per m/s of speed relative to the medium.", "0.1", {.unit = "kg/s", .range = from_0}),
    row_if_given<Drag, &Drag::quadratic>("quadratic", "Force per (m/s)^2: half the product of density, drag coefficient and cross-section.", "0.02", {.unit = "kg/m", .range = from_0}),
    row<Drag, &Drag::wind>("wind", "Velocity of the medium.", "[5, 0, 0]", {.unit = "m/s"}),
};

constexpr Field spring_fields[] = {
    row<SpringKeys, &SpringKeys::anchor>("anchor", "Fixed end; the other end is a body's centre, of each body of `on`.", "[0, 3, 0]", {.unit = "m", .one_of = "anchor|from", .needed = true}),
    row<SpringKeys, &SpringKeys::from>("from", "One end: a fixed point, or the centre of a ball, body or member (gas.3).", "red", {.type = Type::point_or_name, .unit = "m", .one_of = "anchor|from", .title = "One end", .with = "to", .pattern = reference}),
    row<SpringKeys, &SpringKeys::to>("to", "The other end: the same, but not two points.", "gas.3", {.type = Type::point_or_name, .unit = "m", .title = "The other end", .with = "from", .pattern = reference}),
    row<SpringKeys, &SpringKeys::stiffness>("stiffness", "Force per m of stretch.", "40", {.unit = "N/m", .range = from_0, .needed = true}),
    row_if_given<SpringKeys, &SpringKeys::rest_length>("rest_length", "Length at which the spring neither pulls nor pushes. Default: 0 from an `anchor`; between `from` and `to` their distance at time 0.", "0.5", {.unit = "m", .range = from_0, .title = "Rest length"}),
    row<SpringKeys, &SpringKeys::damping>("damping", "Force per m/s along the spring.", "0.2", {.unit = "kg/s", .range = from_0}),
};

constexpr Field attractor_fields[] = {
    row<Attractor, &Attractor::center>("center", "Centre of attraction.", "[0, 0, 0]", {.unit = "m", .needed = true}),
    row<Attractor, &Attractor::strength>("strength", "Acceleration at 1 m; G M of a mass M. Negative: repulsion.", "10", {.unit = "m^3/s^2", .needed = true}),
    row<Attractor, &Attractor::softening>("softening", "Length s: sqrt(d^2 + s^2) takes the place of the distance d, so that the attraction stays finite.", "0.05", {.unit = "m", .range = from_0}),
};

constexpr Field gravitation_fields[] = {
    row<GravitationKeys, &GravitationKeys::constant>("constant", "Acceleration of one body by another one is this times the mass of that over the square of the distance. Negative: repulsion.", "1", {.unit = "m^3/(kg s^2)"}),
    row<GravitationKeys, &GravitationKeys::softening>("softening", "Length s: sqrt(d^2 + s^2) takes the place of the distance d, so that the attraction stays finite.", "0.05", {.unit = "m", .range = from_0}),
};

constexpr Field simulate_fields[] = {
    row<Simulate, &Simulate::duration>("duration", "Simulated time.", "2", {.unit = "s", .range = from_0, .needed = true}),
    row("stop", "What ends the run before its duration, as soon as one of these holds. rest: all bodies are at rest.", "[rest, {collisions: 100}]", {.type = Type::list, .of = "stop", .title = "Ends of the run", .plain = "rest"}),
    row<Simulate, &Simulate::engine>("engine", "exact: from collision to collision; stepped: in time steps, for any force; book: the source chapter's frame loop; auto: exact where the forces allow it, else stepped.", "exact", {.of = engine_names}),
    row<Simulate, &Simulate::step>("step", "Time step of engines stepped and book; with dop853 the longest one. Default of euler, verlet and rk4: 1/1000, or shorter where forces change faster; of book: 1/60.", "0.001", {.unit = "s", .range = above_0, .one_of = "step|tolerance"}),
    row<Simulate, &Simulate::as_printed>("as_printed", "book only: the chapter's listings as printed, errors included.", "true", {.engines = "book"}),
    row<Simulate, &Simulate::rest_speed>("rest_speed", "Slower impacts under load end in lasting contact. Default: on a flat surface the slowest speed that the clock resolves; among bodies 0.03 sqrt(p L), with p the acceleration by gravity and forces and L the diameter of the smaller body, or its radius on a fixed thing.", "0.01", {.unit = "m/s", .range = from_0}),
    row<Simulate, &Simulate::max_collisions>("max_collisions", "A run with more collisions stops with an error.", "1000000", {.range = from_1, .title = "Maximum number of collisions"}),
    row_if_given<Simulate, &Simulate::integrator>("integrator", "Integrator of engine stepped. dop853: Dormand-Prince, order 8, chooses its steps; euler: semi-implicit, order 1; verlet: velocity Verlet, order 2; rk4: Runge-Kutta, order 4. Default: dop853; with a step: rk4.", "verlet", {.of = integrator_names}),
    row_if_given<Simulate, &Simulate::contact>("contact", "What happens where bodies meet. A word alone is `mode`.", "{quality: fast}", {.of = "contact", .plain = "mode"}),
    row<Simulate, &Simulate::tolerance>("tolerance", "Tolerance of positions, instead of step. If it cannot be met, a warning gives the time until which it holds and the error after that. The scene is simulated several times.", "0.000001", {.unit = "m", .range = above_0, .one_of = "step|tolerance", .engines = "auto|exact|stepped"}),
};

constexpr Field contact_fields[] = {
    row<ContactSettings, &ContactSettings::merge>("mode", "Whether bodies that meet bounce or merge into one; merge needs paths in closed form or by dop853, and excludes strings, quadratic drag and springs from fixed points.", "merge", {.type = Type::choice, .of = "bounce|merge", .engines = "auto|exact|stepped"}),
    row<ContactSettings, &ContactSettings::quality>("quality", "How finely pours, piles and heaps are computed: bodies with contacts that change too often to be followed one by one. Each level has a length of steps, an accuracy of forces and a gap that contacts keep, 1/1000 of the least radius at normal. preview may overlap by a twentieth of a radius.", "fast", {.of = quality_names}),
};

constexpr Field stop_fields[] = {
    row<StopKeys, &StopKeys::collisions>("collisions", "After so many collisions, and those at the same instant.", "100", {.range = from_1, .one_of = "collisions|region", .needed = true, .title = "Number of collisions"}),
    row<StopKeys, &StopKeys::region>("region", "When a body enters this region.", "pocket", {.type = Type::name, .one_of = "collisions|region", .pattern = R"(^[A-Za-z_][A-Za-z0-9_-]*(\.[0-9]+)?$)"}),
};

constexpr Field camera_fields[] = {
    row<CameraKeys, &CameraKeys::eye>("eye", "Position of the camera; with follow at time 0.", "[0, 3, -5]", {.unit = "m", .one_of = "eye|fit|path", .needed = true, .spared_by = "follow|orbit|projection", .title = "Position of the camera", .with = "target"}),
    row_if_given<CameraKeys, &CameraKeys::target>("target", "Point that the camera looks at; with follow at time 0.", "[0, 0, 0]", {.unit = "m", .one_of = "target|fit|path", .spared_by = "follow", .with = "eye"}),
    row<CameraKeys, &CameraKeys::up>("up", "Direction that is up in the picture.", "[0, 0, 1]", {.type = Type::direction, .title = "Up in the picture"}),
    row<CameraKeys, &CameraKeys::fov>("fov", "Field of view, the full angle along fov_axis.", "30", {.unit = "degrees", .range = {0, 180, true, true}, .title = "Field of view"}),
    row<CameraKeys, &CameraKeys::fov_horizontal>("fov_axis", "Axis along which fov is measured.", "horizontal", {.type = Type::choice, .of = "vertical|horizontal", .title = "Axis of the field of view"}),
    row<CameraKeys, &CameraKeys::near>("near", "Nothing nearer is drawn.", "1", {.unit = "m", .range = above_0, .one_of = "near|fit", .spared_by = "path", .title = "Near limit", .with = "eye"}),
    row<CameraKeys, &CameraKeys::far>("far", "Nothing farther is drawn.", "100", {.unit = "m", .range = above_0, .one_of = "far|fit", .spared_by = "path", .title = "Far limit", .with = "eye"}),
    row_if_given<CameraKeys, &CameraKeys::fit>("fit", "Frames what happens: the collisions, what goes into them and comes out of them, and the points that strings and springs hang from. `motion`, or the bodies to frame.", "motion", {.of = "fit", .one_of = "fit|follow|path|eye|target|near|far", .plain = "to"}),
    row<CameraKeys, &CameraKeys::follow>("follow", "A ball, body, group or member (gas.3): eye and target go with its centre of mass. Default of target: that centre; of eye: a view from the front, slightly from above.", "red", {.type = Type::name, .one_of = "follow|fit|path", .title = "Followed bodies", .pattern = reference}),
    row("path", "Views at times in order; the camera moves smoothly from one to the next.", "[{at: 0, eye: [0, 3, -5], target: [0, 0, 0]}, {at: 2, eye: [5, 3, 0], target: [0, 0, 0]}]", {.type = Type::list, .of = "keyframe", .one_of = "path|fit|follow|eye|target|orbit"}),
    row_if_given<CameraKeys, &CameraKeys::orbit>("orbit", "Goes round its target, about `up`, counterclockwise as seen from above. Without `eye`: round what happens.", "{period: 20}", {.of = "orbit", .one_of = "orbit|path"}),
    row<CameraKeys, &CameraKeys::orthographic>("projection", "A parallel projection has no vanishing points. Its picture is as high as in perspective at the target.", "orthographic", {.type = Type::choice, .of = "perspective|orthographic", .title = "Projection"}),
};

constexpr Field fit_fields[] = {
    row<FitKeys, &FitKeys::to>("to", "The motion of all bodies, or of those of `on`.", "motion", {.of = "motion", .title = "Framed motion"}),
    row<FitKeys, &FitKeys::on>("on", "Names of balls, bodies, groups, members (gas.3) or fixed things: the picture frames these alone. Default: all bodies.", "[red, blue]", {.type = Type::names, .title = "Framed things", .pattern = reference}),
};

constexpr Field orbit_fields[] = {
    row<OrbitKeys, &OrbitKeys::period>("period", "Time of one round.", "20", {.unit = "s", .range = above_0, .needed = true, .title = "Period"}),
};

constexpr Field keyframe_fields[] = {
    row<KeyframeKeys, &KeyframeKeys::at>("at", "Time of the view, later than that of the entry before.", "1.5", {.unit = "s", .range = from_0, .needed = true, .title = "Time"}),
    row<KeyframeKeys, &KeyframeKeys::eye>("eye", "Position of the camera.", "[0, 3, -5]", {.unit = "m", .needed = true, .title = "Position of the camera"}),
    row<KeyframeKeys, &KeyframeKeys::target>("target", "Point that the camera looks at.", "[0, 0, 0]", {.unit = "m", .needed = true}),
    row<KeyframeKeys, &KeyframeKeys::fov>("fov", "Field of view. Default: that of the camera.", "30", {.unit = "degrees", .range = {0, 180, true, true}, .title = "Field of view"}),
};

constexpr Field coloring_fields[] = {
    row<Coloring, &Coloring::by>("by", "The quantity. speed in m/s; kinetic: the kinetic energy in J; collisions: their number so far; mass in kg; radius in m, of a box or cylinder that of the ball around it; group: a colour for each ball, body or group.", "speed", {.of = quantity_names, .needed = true, .title = "Quantity"}),
    row<Coloring, &Coloring::min>("min", "The quantity at the start of the map; smaller values have the same colour. Default: 0; of mass and radius the least, rounded down to two digits.", "0", {.title = "Start of the scale"}),
    row<Coloring, &Coloring::max>("max", "The quantity at the end of the map; greater values have the same colour. Default of speed and kinetic: what a body has at time 0 or reaches by falling from there, rounded up; of collisions 10; of mass and radius the greatest, rounded up to two digits.", "5", {.title = "End of the scale"}),
    row<Coloring, &Coloring::map>("map", "Colours from the start to the end of the scale.", "cividis", {.of = color_map_names, .title = "Colour map"}),
};

constexpr Field trails_fields[] = {
    row<TrailKeys, &TrailKeys::seconds>("seconds", "Length of a trail in time.", "0.5", {.unit = "s", .range = above_0, .title = "Length in time"}),
    row<TrailKeys, &TrailKeys::width>("width", "Width of a trail. Default: half the radius of its body.", "0.02", {.unit = "m", .range = above_0}),
    row<TrailKeys, &TrailKeys::on>("on", "Balls, bodies, groups and members that have a trail. Default: all.", "[red, gas.3]", {.type = Type::names, .title = "Bodies that have a trail", .pattern = reference}),
};

constexpr Field labels_fields[] = {
    row<LabelKeys, &LabelKeys::show>("show", "The values, in the order name, speed, momentum.", "[speed, momentum]", {.type = Type::names, .of = "name|speed|momentum", .needed = true, .title = "Values"}),
    row<LabelKeys, &LabelKeys::on>("on", "Balls, bodies, groups and members that have labels. Default: all.", "[red, gas.3]", {.type = Type::names, .title = "Bodies that have labels", .pattern = reference}),
};

constexpr Field ambient = row("ambient", "Colour of the ambient light, which comes from all directions.", "dimgray", {.type = Type::color});

constexpr Field light_fields[] = {
    row<Light, &Light::direction>("direction", "Direction in which the light travels, from infinitely far.", "[1, -2, 1]", {.type = Type::direction, .one_of = "direction|position", .needed = true}),
    row<Light, &Light::position>("position", "Position of a lamp, instead of direction.", "[0, 5, 0]", {.unit = "m", .one_of = "direction|position"}),
    row<Light, &Light::color>("color", "Its colour.", "lightyellow"),
    row<Light, &Light::intensity>("intensity", "Brightness; 1 is usual.", "0.8", {.range = from_0}),
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
    {"in", "", "An axis-aligned box, a ball or an upright cylinder.", in_fields},
    {"radii", "", "A range of radii.", radii_fields},
    {"mesh", "", "A mesh file with units and axes of its own.", mesh_fields},
    {"placed", "a", "One of a group's balls: its position, and what it has for itself.", placed_fields},
    {"plane", "a", "An unbounded fixed surface, free on one side.", plane_fields, nullptr, "plane"},
    {"wall", "a", "A two-sided fixed rectangle.", wall_fields, nullptr, "wall"},
    {"room", "", "Six planes that face inward.", room_fields},
    {"obstacle", "an", "A body that no impact moves.", obstacle_fields, nullptr, "obstacle"},
    {"motion", "", "How a fixed thing moves.", motion_fields},
    {"window", "a", "A window of time in which a fixed thing moves.", window_fields},
    {"event", "an",
     "The first of its kind in a run, in place of a time. Where it does not happen, what waits for it waits to the "
     "end.",
     event_fields},
    {"sine", "", "A motion back and forth.", sine_fields},
    {"circle", "", "A motion round an axis.", circle_fields},
    {"string", "a", "A string without mass that does not stretch: slack while its ends are nearer than its length.",
     string_fields, nullptr, "string"},
    {"region", "a", "A region of space that the centres of bodies enter and leave.", region_fields},
    {"side", "", "One side of a plane.", side_fields},
    {"force", "a", "A force on bodies, for the whole run or a window of time.", force_fields},
    {"drag", "", "Drag of a medium, against a body's velocity relative to it.", drag_fields, nullptr, "",
     "linear|quadratic"},
    {"spring", "", "A spring with a damper in parallel, from a fixed point or between two bodies.", spring_fields},
    {"attractor", "", "Attraction to a fixed point by the inverse square of the distance.", attractor_fields},
    {"gravitation", "", "Attraction of bodies to each other by the inverse square of the distance.",
     gravitation_fields},
    {"start", "", "The former run from which bodies begin.", start_fields},
    {"simulate", "", "Duration, engine and accuracy.", simulate_fields},
    {"contact", "", "What happens where bodies meet.", contact_fields},
    {"stop", "a", "A condition that ends the run.", stop_fields, nullptr, "", "", "", true},
    {"camera", "", "Camera of the pictures.", camera_fields},
    {"fit", "", "What the camera frames.", fit_fields},
    {"orbit", "", "A round of the camera.", orbit_fields},
    {"keyframe", "a", "A view at a time.", keyframe_fields, nullptr, "", "", "", true},
    {"light", "a", "A light.", light_fields, &ambient},
    {"coloring", "", "Colours of bodies by a quantity, with a legend in the picture.", coloring_fields},
    {"trails", "", "Trails of bodies.", trails_fields},
    {"labels", "", "Values beside bodies.", labels_fields},
};

/// The rows, completed with the defaults of their members, the rows of the outputs, and the kinds that they name.
class FormatTable {
 public:
  FormatTable() {
    for (const Kind& kind : kinds_of_scenes) add(scenes_, kind);
    vector<Field> of_output;
    for (const OutputKind& kind : output_kinds()) of_output.push_back(kind.field());
    of_output.push_back(tables_field());
    add(scenes_, {"output", "", "What the run writes; an output that is absent is not written.", of_output});
    for (const OutputKind& kind : output_kinds()) {
      if (kind.keys.empty()) continue;
      Kind map{kind.name, "", kind.keys_doc, kind.keys};
      map.beneath = kind.beneath;
      add(scenes_, map);
    }
    for (const Kind& kind : kinds_below_outputs()) add(scenes_, kind);
    for (const Kind& kind : sweep_rows()) add(sweeps_, kind);

    for (vector<Field>& fields : fields_)
      for (Field& field : fields) join(field);
  }

  span<const Kind> scenes() const { return scenes_; }
  span<const Kind> sweeps() const { return sweeps_; }

  const Kind* find(string_view name) const {
    for (const vector<Kind>* kinds : {&scenes_, &sweeps_})
      if (const auto kind = ranges::find(*kinds, name, &Kind::name); kind != kinds->end()) return &*kind;
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
    if (inside >= Inside::map && (field.held = find(field.of)) == nullptr) std::abort();  // a row names no kind
    if (!field.initial.empty()) field.member.initial_node = parsed(field.initial);
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
  map<string_view, Node> nodes_;      // by Field::initial
  std::deque<vector<Field>> fields_;  // by kind
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
