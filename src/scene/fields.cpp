#include "scene/fields.h"

#include <fmt/format.h>

#include <cstdlib>

namespace carom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_0{0, infinity, true, false};
constexpr Range from_0{0, infinity, false, false};
constexpr Range from_1{1, infinity, false, false};

// clang-format off
constexpr Field scene_fields[] = {
    {.key = "scene", .type = Type::whole, .range = {1, 1}, .needed = true, .doc = "Kind of file and version of the format."},
    {.key = "title", .type = Type::text, .initial = "\"\"", .doc = "What the scene is, in one line."},
    {.key = "seed", .type = Type::whole, .range = from_0, .initial = "0", .doc = "The only source of randomness."},
    {.key = "gravity", .type = Type::vector, .unit = "m/s^2", .initial = "[0, -9.80665, 0]", .doc = "Acceleration of every body; y is up."},
    {.key = "restitution", .type = Type::part, .of = "restitution", .doc = "How bodies bounce off one another."},
    {.key = "defaults", .type = Type::part, .of = "defaults", .doc = "Values that things of a kind take where they name none themselves."},
    {.key = "balls", .type = Type::named, .of = "ball", .doc = "Single balls by name."},
    {.key = "bodies", .type = Type::named, .of = "body", .doc = "Movable bodies with any bounding volume."},
    {.key = "groups", .type = Type::named, .of = "group", .doc = "Many balls made by rule, by name."},
    {.key = "planes", .type = Type::named, .of = "plane", .doc = "Unbounded fixed surfaces, free on one side."},
    {.key = "walls", .type = Type::named, .of = "wall", .doc = "Fixed rectangles that can be struck from both sides."},
    {.key = "room", .type = Type::part, .of = "room", .doc = "Six planes that look inward: room.x_min to room.z_max."},
    {.key = "obstacles", .type = Type::named, .of = "obstacle", .doc = "Bodies that never move."},
    {.key = "forces", .type = Type::list, .of = "force", .doc = "Forces on bodies, beside gravity."},
    {.key = "simulate", .type = Type::part, .of = "simulate", .needed = true, .doc = "For how long and how."},
    {.key = "camera", .type = Type::part, .of = "camera", .doc = "Where the pictures are taken from; without it a view of all bodies at time 0 is chosen."},
    {.key = "lights", .type = Type::named, .of = "light", .doc = "Lights by name, and `ambient`, the colour of the light that comes from everywhere."},
    {.key = "background", .type = Type::color, .doc = "Colour behind everything."},
    {.key = "output", .type = Type::part, .of = "output", .doc = "What the run writes; without it trajectory, collisions and energy, no pictures."},
};

constexpr Field restitution_fields[] = {
    {.key = "default", .type = Type::number, .range = from_0, .initial = "1", .doc = "Coefficient of a body that names none."},
    {.key = "combine", .type = Type::choice, .initial = "average", .of = "average|minimum|maximum|product|geometric_mean|mass_weighted|book",
     .doc = "How two bodies' coefficients make the pair's; book is e1 e2 / 2."},
    {.key = "pairs", .type = Type::list, .of = "pair", .doc = "Pairs with a coefficient of their own; the last that fits wins."},
};

constexpr Field pair_fields[] = {
    {.key = "between", .type = Type::two_names, .needed = true,
     .doc = "Two names: balls, bodies, groups, members (gas.3), planes, walls, obstacles, room, room.y_min."},
    {.key = "value", .type = Type::number, .range = from_0, .needed = true, .doc = "The pair's coefficient of restitution."},
};

constexpr Field defaults_fields[] = {
    {.key = "ball", .type = Type::part, .of = "ball", .doc = "For every ball, and every group's ball."},
    {.key = "body", .type = Type::part, .of = "body", .doc = "For every body."},
    {.key = "plane", .type = Type::part, .of = "plane", .doc = "For every plane."},
    {.key = "wall", .type = Type::part, .of = "wall", .doc = "For every wall."},
    {.key = "obstacle", .type = Type::part, .of = "obstacle", .doc = "For every obstacle."},
    {.key = "group", .type = Type::part, .of = "group", .doc = "For every group."},
};

constexpr Field mass{.key = "mass", .type = Type::number, .unit = "kg", .range = above_0, .one_of = "mass|density", .needed = true, .doc = "Mass."};
constexpr Field density{.key = "density", .type = Type::number, .unit = "kg/m^3", .range = above_0, .one_of = "mass|density", .doc = "Mass by volume, instead of mass."};
constexpr Field radius{.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Radius."};
constexpr Field ball_velocity{.key = "velocity", .type = Type::vector, .unit = "m/s", .initial = "[0, 0, 0]", .doc = "Velocity at time 0."};
constexpr Field ball_restitution{.key = "restitution", .type = Type::number, .range = from_0, .doc = "Coefficient of restitution; above 1 makes energy. Default: restitution.default."};
constexpr Field impulse{.key = "impulse", .type = Type::vector, .unit = "N s", .doc = "Impulse given at time 0."};
constexpr Field color{.key = "color", .type = Type::color, .doc = "Colour in pictures; without it one is chosen."};
constexpr Field mesh{.key = "mesh", .type = Type::file, .doc = "A file, drawn scaled to the ball."};
constexpr Field ball_position{.key = "position", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre at time 0."};

constexpr Field ball_fields[] = {
    mass, density, radius,
    ball_position, ball_velocity, ball_restitution, impulse, color, mesh,
};

constexpr std::string_view volumes = "radius|cylinder|box|fit";

// A body's volume: one of four. A mesh with `fit` is the volume; beside one of the other three it is drawn in its place.
constexpr Field radius_of{.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .one_of = volumes, .needed = true, .doc = "Of a sphere."};
constexpr Field cylinder{.key = "cylinder", .type = Type::part, .of = "cylinder", .one_of = volumes, .doc = "An upright cylinder, its axis along y."};
constexpr Field box{.key = "box", .type = Type::vector, .unit = "m", .range = above_0, .one_of = volumes, .doc = "A box along the axes: its full edges."};
constexpr Field fit{.key = "fit", .type = Type::choice, .of = "sphere|cylinder|box", .one_of = volumes, .doc = "The tightest such volume around the mesh; position is its centre."};
constexpr Field mesh_of{.key = "mesh", .type = Type::file, .doc = "A file: with `fit` in its own size, else drawn scaled into the volume."};

constexpr Field body_fields[] = {
    mass, density, radius_of, cylinder, box, mesh_of, fit,
    ball_position, ball_velocity, ball_restitution, impulse, color,
};

constexpr Field cylinder_fields[] = {
    {.key = "radius", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Radius."},
    {.key = "height", .type = Type::number, .unit = "m", .range = above_0, .needed = true, .doc = "Height, along y."},
};

constexpr Field member_fields[] = {mass, density, radius, ball_velocity, ball_restitution, impulse, color, mesh};

constexpr Field group_fields[] = {
    {.key = "count", .type = Type::whole, .range = from_0, .needed = true, .doc = "How many balls: name.0, name.1, ..."},
    {.key = "ball", .type = Type::part, .of = "member", .needed = true, .doc = "What each is like: a ball without position."},
    {.key = "in", .type = Type::part, .of = "in", .needed = true, .doc = "The box that holds every ball wholly."},
    {.key = "arrange", .type = Type::choice, .initial = "random", .of = "random|lattice|hexagonal",
     .doc = "random; lattice: cubic, spread evenly over the box; hexagonal: close-packed layers, spread as far as they go."},
    {.key = "speed", .type = Type::number, .unit = "m/s", .range = from_0, .one_of = "speed|velocity", .doc = "Standard deviation of each component of a ball's velocity."},
    {.key = "velocity", .type = Type::vector, .unit = "m/s", .one_of = "speed|velocity", .doc = "Velocity of every ball at time 0."},
};

constexpr Field in_fields[] = {
    {.key = "min", .type = Type::vector, .unit = "m", .needed = true, .doc = "Lowest corner."},
    {.key = "max", .type = Type::vector, .unit = "m", .needed = true, .doc = "Highest corner."},
};

constexpr Field fixed_restitution{.key = "restitution", .type = Type::number, .range = from_0, .doc = "Coefficient of restitution. Default: the moving body's."};
constexpr Field visible{.key = "visible", .type = Type::flag, .initial = "true", .doc = "Whether it is drawn."};

constexpr Field plane_fields[] = {
    {.key = "point", .type = Type::vector, .unit = "m", .needed = true, .doc = "Any point of the plane."},
    {.key = "normal", .type = Type::direction, .needed = true, .doc = "Points to the free side; any length."},
    fixed_restitution, color, visible,
};

constexpr Field wall_fields[] = {
    {.key = "center", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre of the rectangle."},
    {.key = "normal", .type = Type::direction, .needed = true, .doc = "Stands upright on the rectangle; any length."},
    {.key = "size", .type = Type::extent, .unit = "m", .range = above_0, .needed = true, .doc = "Width and height."},
    {.key = "up", .type = Type::direction, .doc = "The way the height runs; made upright to the normal. Default: y, for a level wall z."},
    fixed_restitution, color, visible,
};

constexpr Field room_fields[] = {
    {.key = "min", .type = Type::vector, .unit = "m", .needed = true, .doc = "Lowest corner."},
    {.key = "max", .type = Type::vector, .unit = "m", .needed = true, .doc = "Highest corner."},
    fixed_restitution, color, visible,
};

constexpr Field obstacle_fields[] = {
    radius_of, cylinder, box, mesh_of, fit,
    {.key = "position", .type = Type::vector, .unit = "m", .needed = true, .doc = "Centre."},
    fixed_restitution, color, visible,
};

constexpr std::string_view forces = "uniform|acceleration|drag|spring|attractor";

constexpr Field force_fields[] = {
    {.key = "uniform", .type = Type::vector, .unit = "N", .one_of = forces, .needed = true, .doc = "The same force on each body."},
    {.key = "acceleration", .type = Type::vector, .unit = "m/s^2", .one_of = forces, .doc = "The same acceleration of each body."},
    {.key = "drag", .type = Type::part, .of = "drag", .one_of = forces, .doc = "Drag of the air, or of another medium."},
    {.key = "spring", .type = Type::part, .of = "spring", .one_of = forces, .doc = "A spring from a fixed point to each body."},
    {.key = "attractor", .type = Type::part, .of = "attractor", .one_of = forces, .doc = "Attraction to a fixed point, as by gravity."},
    {.key = "on", .type = Type::names, .doc = "Balls, bodies, groups and members that it acts on. Default: all."},
    {.key = "from", .type = Type::number, .unit = "s", .range = from_0, .initial = "0", .doc = "When it sets in."},
    {.key = "until", .type = Type::number, .unit = "s", .range = above_0, .doc = "When it ceases. Default: never."},
};

constexpr Field drag_fields[] = {
    {.key = "linear", .type = Type::number, .unit = "kg/s", .range = from_0, .doc = "Force for each m/s against the medium."},
    {.key = "quadratic", .type = Type::number, .unit = "kg/m", .range = from_0, .doc = "Force for each (m/s)^2; half of density, drag coefficient and cross-section."},
    {.key = "wind", .type = Type::vector, .unit = "m/s", .initial = "[0, 0, 0]", .doc = "Velocity of the medium."},
};

constexpr Field spring_fields[] = {
    {.key = "anchor", .type = Type::vector, .unit = "m", .needed = true, .doc = "Its fixed end; the other is a body's centre."},
    {.key = "stiffness", .type = Type::number, .unit = "N/m", .range = from_0, .needed = true, .doc = "Force for each m that it is stretched."},
    {.key = "rest_length", .type = Type::number, .unit = "m", .range = from_0, .initial = "0", .doc = "Length at which it neither pulls nor pushes."},
    {.key = "damping", .type = Type::number, .unit = "kg/s", .range = from_0, .initial = "0", .doc = "Force for each m/s along it."},
};

constexpr Field attractor_fields[] = {
    {.key = "center", .type = Type::vector, .unit = "m", .needed = true, .doc = "Where it attracts to."},
    {.key = "strength", .type = Type::number, .unit = "m^3/s^2", .needed = true, .doc = "Acceleration at 1 m; G M of a mass M. Negative: it repels."},
    {.key = "softening", .type = Type::number, .unit = "m", .range = from_0, .initial = "0", .doc = "Added to the distance as sides of a right angle: near the centre the attraction stays finite."},
};

constexpr Field simulate_fields[] = {
    {.key = "duration", .type = Type::number, .unit = "s", .range = from_0, .needed = true, .doc = "How much time passes in the scene."},
    {.key = "engine", .type = Type::choice, .initial = "auto", .of = "auto|exact|stepped|book",
     .doc = "exact: from collision to collision; stepped: in time steps, for any force; book: the source chapter's frame loop; auto: exact where the forces allow it, else stepped."},
    {.key = "step", .type = Type::number, .unit = "s", .range = above_0, .doc = "Time step of engines that step. Default of stepped: 1/1000, or shorter where forces change faster; of book: 1/60."},
    {.key = "as_printed", .type = Type::flag, .initial = "false", .doc = "book only: the chapter's listings with their slips."},
    {.key = "rest_speed", .type = Type::number, .unit = "m/s", .range = from_0, .doc = "Slower impacts under load end in resting contact. Default: on a flat surface as slow as the clock resolves, among bodies in contact 0.03 sqrt(p L)."},
    {.key = "max_collisions", .type = Type::whole, .range = from_1, .doc = "A run with more stops with an error."},
    {.key = "integrator", .type = Type::choice, .of = "euler|verlet|rk4", .doc = "Of engine stepped: semi-implicit Euler, velocity Verlet or Runge-Kutta, of order 1, 2 and 4. Default: rk4."},
    {.key = "contact", .type = Type::choice, .initial = "bounce", .of = "bounce|merge", .doc = "Whether bodies that meet bounce or become one; merge is engine exact's."},
    {.key = "tolerance", .type = Type::number, .unit = "m", .range = above_0, .doc = "stepped only, instead of step: the step is halved until positions change by less than this."},
};

constexpr Field camera_fields[] = {
    {.key = "eye", .type = Type::vector, .unit = "m", .needed = true, .doc = "Where it stands."},
    {.key = "target", .type = Type::vector, .unit = "m", .needed = true, .doc = "What it looks at."},
    {.key = "up", .type = Type::direction, .initial = "[0, 1, 0]", .doc = "What is up in the picture."},
    {.key = "fov", .type = Type::number, .unit = "degrees", .range = {0, 180, true, true}, .initial = "45", .doc = "Field of view, the full angle along fov_axis."},
    {.key = "fov_axis", .type = Type::choice, .initial = "vertical", .of = "vertical|horizontal", .doc = "The way fov is measured."},
    {.key = "near", .type = Type::number, .unit = "m", .range = above_0, .initial = "0.1", .doc = "Nothing nearer is drawn."},
    {.key = "far", .type = Type::number, .unit = "m", .range = above_0, .initial = "1000", .doc = "Nothing farther is drawn."},
};

constexpr Field light_fields[] = {
    {.key = "direction", .type = Type::direction, .one_of = "direction|position", .needed = true, .doc = "The way the light travels, from infinitely far."},
    {.key = "position", .type = Type::vector, .unit = "m", .one_of = "direction|position", .doc = "Where a lamp stands, instead of direction."},
    {.key = "color", .type = Type::color, .initial = "white", .doc = "Its colour."},
    {.key = "intensity", .type = Type::number, .range = from_0, .initial = "1", .doc = "How bright; 1 is usual."},
};

constexpr Field output_fields[] = {
    {.key = "trajectory", .type = Type::part_or_flag, .of = "trajectory", .doc = "trajectory.csv: where every body is."},
    {.key = "collisions", .type = Type::flag, .initial = "false", .doc = "collisions.csv: every collision."},
    {.key = "energy", .type = Type::part_or_flag, .of = "energy", .doc = "energy.csv: energy and momentum of all bodies."},
    {.key = "contacts", .type = Type::part_or_flag, .of = "contacts", .doc = "contacts.csv: the forces of lasting contact."},
    {.key = "frames", .type = Type::part_or_flag, .of = "frames", .doc = "frames/frame_00000.png and on."},
    {.key = "video", .type = Type::part_or_flag, .of = "video", .doc = "A film, H.264."},
    {.key = "sheet", .type = Type::part_or_flag, .of = "sheet", .doc = "sheet.png: pictures from start to end side by side."},
    {.key = "flights", .type = Type::flag, .doc = "flights.bin: the paths, from which carom render draws other pictures; where the engine goes along parabolas. Default: true with pictures."},
};

constexpr std::string_view thirtieth = "0.03333333333333333";  // 1/30, to the last bit
constexpr Range image_side{16, 16384};

constexpr Field trajectory_fields[] = {
    {.key = "every", .type = Type::number, .unit = "s", .range = above_0, .initial = thirtieth, .doc = "Time between rows."},
    {.key = "layout", .type = Type::choice, .initial = "long", .of = "long|wide", .doc = "long: a row for each body and time; wide: a row for each time."},
};

constexpr Field energy_fields[] = {
    {.key = "every", .type = Type::number, .unit = "s", .range = above_0, .initial = thirtieth, .doc = "Time between rows."},
};

constexpr Field contacts_fields[] = {
    {.key = "every", .type = Type::number, .unit = "s", .range = above_0, .initial = thirtieth, .doc = "Time between rows."},
};

constexpr Field fps{.key = "fps", .type = Type::number, .unit = "1/s", .range = above_0, .initial = "30", .doc = "Pictures a second."};
constexpr Field size{.key = "size", .type = Type::pixels, .unit = "pixels", .range = image_side, .initial = "[1280, 720]", .doc = "Width and height of a picture."};
constexpr Field samples{.key = "samples", .type = Type::choice, .initial = "4", .of = "1|2|4|8", .doc = "Samples a pixel, against jagged edges."};
constexpr Field from{.key = "from", .type = Type::number, .unit = "s", .range = from_0, .initial = "0", .doc = "No picture before."};
constexpr Field until{.key = "until", .type = Type::number, .unit = "s", .range = from_0, .doc = "No picture after. Default: the duration."};

constexpr Field frames_fields[] = {fps, size, samples, from, until};

constexpr Field video_fields[] = {
    {.key = "file", .type = Type::text, .initial = "animation.mp4", .doc = "Name of the file, ending in .mp4."},
    fps, size,
    {.key = "crf", .type = Type::whole, .range = {0, 51}, .initial = "18", .doc = "0: largest and best, 51: smallest and worst."},
    samples, from, until,
};

constexpr Field sheet_fields[] = {
    {.key = "columns", .type = Type::whole, .range = {1, 100}, .initial = "4", .doc = "Pictures side by side."},
    {.key = "rows", .type = Type::whole, .range = {1, 100}, .initial = "3", .doc = "Pictures one below another."},
};
// clang-format on

constexpr Kind all_kinds[] = {
    {"scene", "the", "One scene: what there is, what happens, what is wanted of it.", scene_fields},
    {"restitution", "", "How bodies bounce off one another.", restitution_fields},
    {"pair", "a", "A coefficient of restitution for two bodies, whatever theirs are.", pair_fields},
    {"defaults", "", "Values that things of a kind take where they name none themselves.", defaults_fields},
    {"ball", "a", "A sphere that moves without turning.", ball_fields},
    {"body", "a", "A body with any bounding volume that moves without turning.", body_fields},
    {"cylinder", "a", "An upright cylinder.", cylinder_fields},
    {"member", "a", "The ball of a group.", member_fields},
    {"group", "a", "Many balls made by rule, without overlap, the same on every machine.", group_fields},
    {"in", "", "A box along the axes.", in_fields},
    {"plane", "a", "An unbounded fixed surface, free on one side.", plane_fields},
    {"wall", "a", "A fixed rectangle that can be struck from both sides.", wall_fields},
    {"room", "", "Six planes that look inward.", room_fields},
    {"obstacle", "an", "A body that never moves.", obstacle_fields},
    {"force", "a", "A force on bodies, in a window of time if it says so.", force_fields},
    {"drag", "", "Drag of a medium: against a body's velocity relative to it.", drag_fields},
    {"spring", "", "A spring from a fixed point, with a damper beside it.", spring_fields},
    {"attractor", "", "Attraction to a fixed point by the square of the distance.", attractor_fields},
    {"simulate", "", "For how long and how.", simulate_fields},
    {"camera", "", "Where the pictures are taken from.", camera_fields},
    {"light", "a", "A light.", light_fields, "ambient"},
    {"output", "", "What the run writes; absent parts are not made.", output_fields},
    {"trajectory", "", "trajectory.csv.", trajectory_fields},
    {"energy", "", "energy.csv.", energy_fields},
    {"contacts", "", "contacts.csv.", contacts_fields},
    {"frames", "", "One PNG a picture.", frames_fields},
    {"video", "", "A film; what it does not say itself is taken from frames.", video_fields},
    {"sheet", "", "A contact sheet.", sheet_fields},
};

}  // namespace

std::span<const Kind> kinds() {
  return all_kinds;
}

const Kind& kind_named(std::string_view name) {
  for (const std::span<const Kind> family : {kinds(), sweep_kinds()}) {
    for (const Kind& kind : family)
      if (kind.name == name) return kind;
  }
  std::abort();  // a row of the table names a kind that it does not have
}

const Field* find_field(const Kind& kind, std::string_view key) {
  for (const Field& field : kind.fields) {
    if (field.key == key) return &field;
  }
  return nullptr;
}

bool contains(const Range& range, double value) {
  return (range.above_min ? value > range.min : value >= range.min) &&
         (range.below_max ? value < range.max : value <= range.max);
}

std::string describe(const Range& range) {
  if (range.min == range.max) return fmt::format("{}", range.min);
  const bool low = range.min > -infinity, high = range.max < infinity;
  if (low && high) {
    return range.above_min || range.below_max ? fmt::format("between {} and {}", range.min, range.max)
                                              : fmt::format("from {} to {}", range.min, range.max);
  }
  if (low) return range.above_min ? fmt::format("above {}", range.min) : fmt::format("of at least {}", range.min);
  if (high) return fmt::format("of at most {}", range.max);
  return {};
}

std::vector<std::string_view> parts_of(std::string_view text) {
  std::vector<std::string_view> out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('|', i), text.size());
    out.push_back(text.substr(i, end - i));
    i = end + 1;
  }
  return out;
}

std::vector<std::string_view> rivals(const Field& field) {
  std::vector<std::string_view> out = parts_of(field.one_of);
  std::erase(out, field.key);
  return out;
}

std::vector<std::string_view> choices(const Field& field) {
  return parts_of(field.of);
}

std::string listed(const std::vector<std::string_view>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) out += i + 1 == words.size() ? " or " : ", ";
    out += words[i];
  }
  return out;
}

std::string expected(const Field& field) {
  const std::string range = describe(field.range);
  const std::string limits = range.empty() ? "" : " " + range;
  const std::string unit = field.unit.empty() ? "" : fmt::format(" in {}", field.unit);
  switch (field.type) {
    case Type::number:
      return fmt::format("a number{}{}", limits, unit);
    case Type::whole:
      return field.range.min == field.range.max ? range : fmt::format("a whole number{}", limits);
    case Type::flag:
      return "true or false";
    case Type::text:
      return "a text";
    case Type::choice:
      return listed(choices(field));
    case Type::vector:
      return fmt::format("[x, y, z], three numbers{}{}", limits, unit);
    case Type::direction:
      return "[x, y, z], three numbers, not all zero";
    case Type::extent:
      return fmt::format("[width, height], two numbers{}{}", limits, unit);
    case Type::pixels:
      return fmt::format("[width, height], two whole numbers{}{}", limits, unit);
    case Type::color:
      return "a colour: a CSS name, '#rgb', '#rrggbb' or [r, g, b], each 0 to 1";
    case Type::file:
      return "the path of a file, from the folder of the scene";
    case Type::two_names:
      return "[name, name]";
    case Type::names:
      return "a list of names, such as [red, gas.3]";
    case Type::part:
      return "a map of keys";
    case Type::part_or_flag:
      return "true, false or a map of keys";
    case Type::named:
      return "a map from names to what they are";
    case Type::list:
      return "a list";
    case Type::settings:
      return "a map from paths to values, such as {balls.red.mass: 2}";
    case Type::axes:
      return "a map from paths to lists or ranges, such as {balls.red.mass: [1, 2]} or {balls.red.mass: {from: 1, to: "
             "2, count: 3}}";
    case Type::cases:
      return "a list of maps from paths to values, such as [{balls.red.mass: 2}]";
  }
  return {};
}

}  // namespace carom
