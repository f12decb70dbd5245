// A table of terms with a text and keys of the format. Similar spelling would not find these keys, since the words
// differ.
#include "scene/absent_words.h"

#include <fmt/format.h>

#include "scene/field.h"
#include "std.h"

namespace carom {
namespace {

constexpr AbsentWord all_words[] = {
    {"friction|rub|roughness|traction|coefficient of friction|mu|sliding friction|rolling friction",
     "There is none: contact forces are perpendicular to the surfaces, so bodies slide freely. Drag slows bodies down "
     "everywhere; restitution takes energy at impacts.",
     "drag|restitution"},
    {"rotation|rotate|turning|orientation|angle|euler angles|quaternion|tilt|roll|rolling",
     "Bodies do not turn, on purpose: they are point particles in bounding volumes of fixed orientation. A plane or a "
     "wall can be tilted by its normal, and a mesh has a fixed `turn`.",
     "plane|wall|mesh.turn"},
    {"spin|angular velocity|torque|moment of inertia|inertia|angular momentum",
     "Bodies do not turn, on purpose, so they have no spin, torque or moment of inertia.", "velocity|impulse"},
    {"joint|constraint|ball joint|slider|weld|motor|ragdoll|linkage",
     "Joints are `strings` between bodies, or from a point to a body, and rods, which are strings with `rod: true`. "
     "`simulate.contact: merge` merges bodies that meet.",
     "strings|string.rod|contact"},
    {"hinge|pivot|pendulum|axle",
     "A body on a string is a pendulum; with `rod: true` it may stand above its pivot, too.", "strings|string.rod"},
    {"rope|tether|cable|chain|link|thread|leash|wire|strut|bar|stick constraint|distance constraint",
     "`strings` do not stretch and have no mass. A chain is bodies with strings between neighbours; `rod: true` keeps "
     "them apart, too.",
     "strings|string|string.rod"},
    {"timestep|time step|dt|delta time|substeps|step size|tick|iterations",
     "Engine exact needs none: it goes from collision to collision. Engine stepped takes `simulate.step`, or finds "
     "a step for `simulate.tolerance`. `every` spaces the rows of tables and `fps` the pictures; neither changes the "
     "motion.",
     "simulate.step|simulate.tolerance|engine"},
    {"restart|resume|continue|continuation|checkpoint|initial state|final state|previous run|warm start",
     "`start` begins with the bodies of a finished run at one of its times. A run that was interrupted is repeated.",
     "start|start.at"},
    {"speed|fast|velocity magnitude",
     "A ball or body has a `velocity`, a vector. `speed` belongs to groups, the spread of random velocities, and to "
     "videos.",
     "velocity|groups.speed|video.speed"},
    {"slow motion|slowmo|slowdown|bullet time|speed ramp|ramping",
     "`video.slow` slows a film down around a collision, and `video.speed` all of it: 0.125 is eightfold slow motion.",
     "video.slow|video.speed"},
    {"audio|noise of impacts|click|clicks|tone|volume of sound|loudness|soundtrack|music|voice",
     "`video.sound` is the sound of a film's collisions. There is no other sound.", "video.sound"},
    {"time lapse|playback speed|time scale|timescale|replay speed|speed up",
     "`video.speed` is the seconds of motion a second of film: 0.125 is eightfold slow motion, 10 a time lapse. Every "
     "instant is exact. `fps` alone does not change how fast a film plays.",
     "video.speed|video.fps"},
    {"bounce|bounciness|rebound|bouncy|bouncing",
     "The coefficient of restitution sets how bodies bounce: 1 keeps the speed, 0 none of it.",
     "restitution|restitution.combine"},
    {"elasticity|elastic|inelastic|coefficient of restitution|cor|hardness|stiff|damping ratio",
     "Elasticity is the coefficient of restitution: 1 elastic, below 1 inelastic, 0 perfectly inelastic. "
     "`simulate.contact: merge` makes bodies stick together for good.",
     "restitution|contact"},
    {"velocity dependent restitution|speed dependent restitution|restitution curve|restitution of speed|viscoelastic|"
     "viscoelasticity|hertz|impact law",
     "The coefficient of restitution does not depend on the speed, on purpose: impacts take no time, and each pair has "
     "one number. Slow impacts under load end in rest, by `rest_speed`.",
     "restitution|pair|rest_speed"},
    {"camera path|camera motion|fly through|flythrough|tracking shot|keyframes|dolly|orbit camera|turntable|zoom",
     "`camera.path` moves the camera through keyframes, `camera.follow` takes it along with a body, and `camera.orbit` "
     "goes round. `carom render` draws other views of a run without simulating again.",
     "camera.path|camera.follow|camera.orbit"},
    {"auto camera|autofit|framing|bounding view|zoom to fit|default camera",
     "Without a camera, or with `fit: motion`, the camera frames what happens, and moves along if need be.",
     "camera.fit"},
    {"loop|for|foreach|array|instances|copies|clone|duplicate|grid of bodies|row of bodies",
     "A thing with `repeat` stands for many: `repeat: 7` makes seven, and expressions place each by its index i. Many "
     "balls placed by rule are a group; many runs with other values are a sweep.",
     "ball.repeat|group|sweep"},
    {"variable|parameter|constant|define|macro|expression|formula|function|arithmetic|calculation",
     "`let` gives names to numbers, and a text that begins with = is an expression of them. `--set let.NAME=VALUE` "
     "changes one for a run, a sweep varies it over runs.",
     "let|sweep"},
    {"sphere|particle|marble|point mass|circle|disc|disk", "A sphere that moves is a ball.", "ball|balls"},
    {"cube|cuboid|block|brick|crate|rigid body|rigidbody|object|solid|prism|shape|volume|collider",
     "An axis-aligned box is a body with `box: [x, y, z]`; an upright cylinder is one with `cylinder`.",
     "body|box|cylinder"},
    {"capsule|cone|ellipsoid|convex hull|polygon|triangle|terrain|heightfield",
     "Volumes are spheres, upright cylinders and axis-aligned boxes. A mesh is drawn in place of a volume, or `fit` "
     "finds the volume around it.",
     "mesh|fit|body"},
    {"floor|ground|ramp|slope|incline|ceiling",
     "An unbounded surface is a plane; its normal tilts it. A rectangle is a wall.", "plane|wall|room"},
    {"static|fixed|kinematic|immovable|infinite mass|anchor point",
     "Things that no impact moves are planes, walls, a room and obstacles. `motion` moves them at given velocities.",
     "plane|wall|room|obstacle|plane.motion"},
    {"piston|paddle|bat|racket|conveyor|elevator|lift|moving wall|moving floor|moving platform|plunger|flipper",
     "A plane, a wall or an obstacle with `motion` moves at constant velocities in windows of time.",
     "plane.motion|obstacle.motion"},
    {"shake|shaking|shaker|vibrate|vibration|vibrating|oscillate|oscillating|swinging|moving on a circle|circling",
     "`motion` of a plane, a wall or an obstacle has `sine` and `circle`, and `every` for windows that repeat.",
     "motion.sine|motion.circle|motion.every"},
    {"sensor|trigger|goal|zone|pocket|kill zone|finish line|drain|sink",
     "`regions` are entered and left by the centres of bodies: `output.regions` writes when, and an `action` removes "
     "the "
     "body or stops the run.",
     "regions|region.action|output.regions"},
    {"air|air resistance|resistance|viscosity|damping|friction of air|medium|fluid|buoyancy",
     "A medium acts by drag, linear or quadratic in the relative velocity; it may move as wind.", "drag|drag.wind"},
    {"magnet|magnetism|charge|electric|coulomb|attraction|planet|sun|gravitation|orbit",
     "An attractor attracts to a fixed point by the inverse square of the distance. Bodies do not attract one another.",
     "attractor|gravity"},
    {"explosion|kick|push|hit|throw|launch|initial force",
     "A blow at time 0 is an impulse; a force for a while has `from` and `until`.", "impulse|force"},
    {"stick|sticky|glue|merge|coalesce|clump|adhesion",
     "Bodies that meet become one with `simulate.contact: merge`. Restitution 0 stops them without glue.",
     "contact|restitution"},
    {"collision group|layer|mask|filter|ignore collisions|collision mask",
     "All bodies meet all others. A pair can have a coefficient of restitution of its own.", "pair"},
    {"material|transparency|transparent|see through|shininess|reflection|shiny|translucent|emissive",
     "Things have a `color`, a `finish` and an `opacity`. `background: none` leaves out the background of pictures.",
     "color|finish|opacity|background"},
    {"texture|texture map|normal map|shader", "A mesh has the textures of its file.", "mesh"},
    {"theme|style|palette|dark mode|studio lighting|chalk",
     "`look` gives floor, backdrop, lights, colours and outlines.", "look"},
    {"subtitle|annotation|watermark|timestamp|clock|overlay",
     "A `caption` is a text in each picture: the title, the time, values of the scene. `labels` are values beside "
     "bodies.",
     "caption|labels"},
    {"label|tag|name tag|readout", "`labels` are values beside bodies: their name, speed or momentum.", "labels"},
    {"ruler|scalebar|scale bar|length bar|measuring stick",
     "`scale_bar` is a bar of round length in the corner of pictures.", "scale_bar"},
    {"title card|intro|opening|opening title|splash", "`title: true` of `video` shows the scene's title for 2 s.",
     "video.title"},
    {"graph|chart|live chart|plot beside|inset|side by side",
     "`video.beside` is a chart that grows with the film. `output.plots` are charts of the whole run.",
     "video.beside|output.plots"},
    {"legend|colormap|colour map|color map|colorbar|colour scale|color scale|heat map|gradient",
     "`color: {by: speed}` colours bodies by a quantity, and pictures have a legend.", "coloring|coloring.by"},
    {"trail|trace|tracer|path line|streak|tail", "`trails` are the paths of bodies during the last seconds.", "trails"},
    {"vector|arrow|glyph", "`arrows` show velocities, momenta and forces at the bodies.", "arrows"},
    {"blink|glow|highlight|spark", "Bodies that collide flash with `flash: true`.", "flash"},
    {"blur|motion blur|exposure|exposure time|shutter speed",
     "Motion blur is `shutter`: the part of the interval between pictures in which a picture gathers light.",
     "shutter"},
    {"resolution|width|height|image size|picture size",
     "The size of pictures is `size: [width, height]`, in pixels, or a name such as `1080p`.",
     "frames.size|video.size"},
    {"frame rate|framerate|frames per second|sample rate|sampling",
     "`fps` spaces the pictures, `every` the rows of tables. Neither changes the motion.",
     "frames.fps|trajectory.every"},
    {"gif|webp|mp4|movie|film|animation",
     "A film is `output.video`. The ending of `video.file` chooses H.264, GIF or WebP.", "video|video.file"},
    {"csv|table|spreadsheet|excel|xlsx|data",
     "Tables are `output.trajectory`, `collisions`, `energy`, `contacts` and `regions`. `output.tables` chooses how "
     "they "
     "are written: CSV, compressed, or also a workbook. `carom compare` puts runs into a workbook. A group may begin "
     "with the `table` of its balls.",
     "output|output.tables|groups.table"},
    {"parquet|arrow table|feather|hdf5|netcdf|binary table|compact table|compression|compress|gzip|gz|zip|file format|"
     "table format",
     "There is no Parquet. `tables: csv.gz` in `output` is compact, and pandas and R read it as it is.",
     "output.tables|tables.format"},
    {"delimiter|semicolon|decimal comma|decimal point|decimal separator|locale|german|german excel|semicolon separated",
     "`output.tables: {separator: \";\", decimal: \",\"}` writes CSV for spreadsheets with decimal commas.",
     "output.tables|tables.separator|tables.decimal"},
    {"solver|physics engine|method|algorithm",
     "`simulate.engine` chooses the engine, `integrator` the method of its steps.", "engine|integrator"},
    {"time|length of run|end time|end|run time",
     "A run lasts `simulate.duration`, unless one of `simulate.stop` ends it before.", "duration|simulate.stop"},
    {"unit|units|metre|meter|inch|feet|gram|degree",
     "Units are SI: m, kg, s, N; angles are in degrees. Numbers carry no unit.", "scene"},
    {"sleep|sleeping|rest|resting|deactivation",
     "Bodies that rest cost nothing until something strikes them. `rest_speed` sets which impacts end in rest.",
     "rest_speed"},
    {"scale|scaling|scale factor|resize",
     "A mesh is drawn scaled into its volume, which has the size; with `fit` it keeps its own size, in units of its "
     "`scale`. Lengths may be expressions of one number of `let`.",
     "mesh.scale|fit|let"},
    {"millimetre|millimeter|mm|stl|obj|cad|z up|up axis",
     "A mesh in millimetres has the `scale` 0.001, and one that is drawn with z upwards has `up: z`.",
     "mesh.scale|mesh.up|fit"},
    {"polydisperse|polydispersity|size distribution|radius distribution|radii|sizes",
     "The balls of a group have one radius each by the seed with `radius: {from: 0.02, to: 0.05}`, or the radii of a "
     "`table`.",
     "groups.ball.radius|groups.table"},
    {"packing|positions|coordinates|placement file|initial positions|load positions",
     "A group begins with the places of a CSV file by `table`. `overlap: push` moves apart what overlaps a little.",
     "groups.table|groups.overlap|groups.in"},
    {"periodic|periodic boundary|periodic boundaries|boundary condition|wrap around|boundary|domain",
     "There are no periodic boundaries, on purpose. A `room` has six planes, and a region with `action: remove` takes "
     "away what "
     "leaves or arrives.",
     "room|region.action"},
    {"emitter|emit|source|spawn|pour|pouring|insert|insertion|inject|injection|inflow|feed|hopper|nozzle|generator",
     "A group with a `rate` pours its balls, and a body with `appear` comes later.", "groups.rate|appear"},
    {"delay|postpone|wait|start time|lag|schedule",
     "Forces and motions begin at their `from` and end at `until`, times or events with a delay `after`. Bodies come "
     "at "
     "their `appear`.",
     "force.from|window.from|event.after|appear"},
    {"event|happening|switch|cut|release|when",
     "The first entry into a region or the first collision of two sets in or ends a force or a motion, or cuts a "
     "string: "
     "`from: {region: gate}`, `until: {collision: [red, crate]}`.",
     "force.from|window.from|string.until|event.region|event.collision"},
    {"momentum|linear momentum|px|py|pz|conservation of momentum",
     "`output.energy` lists the momentum of all bodies, and `arrows` show that of each. An `impulse` gives a body "
     "momentum at time 0.",
     "output.energy|arrows|impulse"},
    {"orthographic|orthographic projection|orthogonal|parallel projection|isometric|projection|perspective|ortho",
     "`projection: orthographic` in `camera` is a parallel projection.", "camera.eye|camera.fov"},
    {"python|script|scripting|lua|javascript|plugin|api|library|code|callback|hook",
     "A scene is data and runs no code. `let`, expressions and `repeat` make its numbers, a sweep varies them, and "
     "tables are CSV for any program.",
     "let|ball.repeat|sweep"},
    {"random|randomness|random position|random velocity|noise|rng|monte carlo|stochastic|jitter|distribution",
     "`seed` decides all that is random: the places of a group with `arrange: random`, its velocities with `speed`, "
     "its radii, and rand(i) in expressions. A sweep may draw its values.",
     "seed|groups.arrange|groups.speed|groups.ball.radius|let"},
    {"pressure|stress|load|weight|normal force|reaction|reaction force|contact force",
     "`output.contacts` lists the forces of lasting contact, and `output.collisions` the impulses of impacts. Of "
     "`measures` impulse(wall) sums both; pressure is that over the area and the time.",
     "output.contacts|output.collisions|measures"},
    {"comment|include|import|extends|inherit",
     "A scene is one YAML file; `#` begins a comment. `defaults` holds shared values.", "defaults"},
};

}  // namespace

span<const AbsentWord> absent_words() {
  return all_words;
}

const AbsentWord* find_absent_word(string_view word) {
  string plain;
  for (const char c : word) plain += c == '_' || c == '-' ? ' ' : c >= 'A' && c <= 'Z' ? char(c + 32) : c;
  const string single = plain.ends_with('s') ? plain.substr(0, plain.size() - 1) : plain;
  for (const string& form : {plain, single})
    for (const AbsentWord& row : all_words) {
      const vector<string_view> words = parts_of(row.words);
      if (contains(words, form)) return &row;
    }
  return nullptr;
}

string commands_of(const AbsentWord& word) {
  string text;
  for (const string_view key : parts_of(word.see))
    text += fmt::format("{}carom explain {}", text.empty() ? "" : ", ", key);
  return text;
}

}  // namespace carom
