#include "scene/absent_words.h"

#include <algorithm>
#include <string>

#include "scene/fields.h"

namespace carom {
namespace {

constexpr AbsentWord all_words[] = {
    {"friction|rub|roughness|traction|coefficient of friction|mu|sliding friction|rolling friction",
     "There is none: contact forces stand upright on the surfaces, so bodies slide freely. Drag slows bodies down "
     "everywhere; restitution takes energy at impacts.",
     "drag|restitution"},
    {"rotation|rotate|turning|orientation|angle|euler angles|quaternion|tilt|roll|rolling",
     "Bodies do not turn: they are point particles in bounding volumes that keep their directions. A plane or a wall "
     "can be tilted by its normal.",
     "plane|wall"},
    {"spin|angular velocity|torque|moment of inertia|inertia|angular momentum",
     "Bodies do not turn, so they have no spin, torque or moment of inertia.", "velocity|impulse"},
    {"joint|constraint|ball joint|slider|weld|motor|ragdoll|linkage",
     "There are no joints. A stiff spring ties a body to a point, and `simulate.contact: merge` makes bodies that meet "
     "one.",
     "spring|contact"},
    {"hinge|pivot|pendulum|axle", "There are no hinges. A stiff spring with a rest length holds a body near a circle.",
     "spring"},
    {"rope|string|tether|cable|chain|rod|link|thread",
     "There are no ropes or rods. A stiff spring with a rest length keeps a body at a distance from a point; it pushes "
     "as well as it pulls.",
     "spring"},
    {"timestep|time step|dt|delta time|substeps|step size|tick|iterations",
     "Engine exact needs none: it goes from collision to collision. For engine stepped it is `simulate.step`, or "
     "`simulate.tolerance` finds it. How often tables are written is `every`, pictures `fps`; neither changes the "
     "motion.",
     "simulate.step|simulate.tolerance|engine"},
    {"speed|fast|velocity magnitude",
     "A ball or body has a `velocity`, a vector. `speed` is of groups: the spread of random velocities. How fast a "
     "film "
     "plays is a matter of its `fps`.",
     "velocity|groups.speed|video.fps"},
    {"slow motion|slowmo|slow|slowdown|time lapse|playback speed|time scale|timescale|replay speed|speed up",
     "A film plays as time passes, whatever its `fps`. For slow motion write frames with a high `fps` and put them "
     "together at a lower rate; every instant is exact.",
     "frames.fps|video.fps"},
    {"bounce|bounciness|rebound|bouncy|bouncing",
     "How bodies bounce is their coefficient of restitution: 1 keeps the speed, 0 none of it.",
     "restitution|restitution.combine"},
    {"elasticity|elastic|inelastic|coefficient of restitution|cor|hardness|stiff|damping ratio",
     "Elasticity is the coefficient of restitution: 1 elastic, below 1 inelastic, 0 perfectly inelastic. Bodies that "
     "stick together for good are `simulate.contact: merge`.",
     "restitution|contact"},
    {"camera path|camera motion|fly through|flythrough|follow|tracking shot|keyframe|keyframes|dolly|orbit camera|zoom",
     "The camera stands still: `eye`, `target` and `fov` hold for the whole run. Other views of the same run cost no "
     "simulation: `carom render`.",
     "camera|camera.fov"},
    {"loop|repeat|for|foreach|array|instances|copies|clone|duplicate",
     "A scene has no loops. Many balls made by rule are a group; many runs with other values are a sweep.",
     "group|grid"},
    {"variable|parameter|constant|let|define|macro|expression|formula|function|arithmetic",
     "A scene has no variables. `defaults` holds values that things share, `--set PATH=VALUE` changes one for a run, a "
     "sweep varies it over runs.",
     "defaults|sweep"},
    {"sphere|particle|marble|point mass|circle|disc|disk", "A sphere that moves is a ball.", "ball|balls"},
    {"cube|cuboid|block|brick|crate|rigid body|rigidbody|object|solid|prism|shape|volume|collider",
     "A box along the axes is a body with `box: [x, y, z]`; an upright cylinder one with `cylinder`.",
     "body|box|cylinder"},
    {"capsule|cone|ellipsoid|convex hull|polygon|triangle|terrain|heightfield",
     "Volumes are spheres, upright cylinders and boxes along the axes. A mesh is drawn in place of a volume, or `fit` "
     "finds the volume around it.",
     "mesh|fit|body"},
    {"floor|ground|ramp|slope|incline|ceiling",
     "An unbounded surface is a plane; its normal tilts it. A rectangle is a wall.", "plane|wall|room"},
    {"static|fixed|kinematic|immovable|infinite mass|anchor point",
     "Things that never move are planes, walls, a room and obstacles.", "plane|wall|room|obstacle"},
    {"sensor|trigger|region|goal|zone|pocket|kill zone",
     "There are no regions. collisions.csv has every collision; trajectory.csv has where bodies are.",
     "output.collisions|output.trajectory"},
    {"air|air resistance|resistance|viscosity|damping|friction of air|medium|fluid|buoyancy",
     "A medium acts by drag, linear or quadratic in the velocity against it; it may move as wind.", "drag|drag.wind"},
    {"magnet|magnetism|charge|electric|coulomb|attraction|planet|sun|gravitation|orbit",
     "Attraction to a fixed point by the square of the distance is an attractor. Bodies do not attract one another.",
     "attractor|gravity"},
    {"explosion|kick|push|hit|throw|launch|initial force",
     "A blow at time 0 is an impulse; a force for a while has `from` and `until`.", "impulse|force"},
    {"stick|sticky|glue|merge|coalesce|clump|adhesion",
     "Bodies that meet become one with `simulate.contact: merge`. Restitution 0 stops them without glue.",
     "contact|restitution"},
    {"collision group|layer|mask|filter|ignore collisions|collision mask",
     "All bodies meet all others. A pair can have a coefficient of restitution of its own.", "pair"},
    {"material|texture|opacity|transparency|shininess|roughness map|shader",
     "Things have a colour, or a mesh with its own.", "color|mesh"},
    {"resolution|width|height|image size|picture size", "The size of pictures is `size: [width, height]`, in pixels.",
     "frames.size|video.size"},
    {"frame rate|framerate|frames per second|sample rate|sampling",
     "Pictures come by `fps`, the rows of tables by `every`. Neither changes the motion.",
     "frames.fps|trajectory.every"},
    {"gif|webp|mp4|movie|film|animation", "A film is `output.video`, H.264 in an .mp4 file.", "video"},
    {"csv|table|spreadsheet|excel|xlsx|data",
     "Tables are `output.trajectory`, `collisions`, `energy` and `contacts`; `carom compare` puts runs into a "
     "workbook.",
     "output"},
    {"solver|physics engine|method|algorithm",
     "The engine is chosen by `simulate.engine`, the method of its steps by `integrator`.", "engine|integrator"},
    {"time|length of run|end time|stop|end|run time", "A run lasts `simulate.duration`.", "duration"},
    {"unit|units|metre|meter|inch|feet|gram|degree",
     "Units are SI: m, kg, s, N; angles are in degrees. Numbers stand without a unit.", "scene"},
    {"sleep|sleeping|rest|resting|deactivation",
     "Bodies that rest cost nothing until something strikes them. `rest_speed` says which impacts end in rest.",
     "rest_speed"},
    {"comment|include|import|extends|inherit",
     "A scene is one YAML file; `#` begins a comment. `defaults` holds shared values.", "defaults"},
};

}  // namespace

std::span<const AbsentWord> absent_words() {
  return all_words;
}

const AbsentWord* find_absent_word(std::string_view word) {
  std::string plain;
  for (const char c : word) plain += c == '_' || c == '-' ? ' ' : c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  for (const AbsentWord& row : all_words) {
    const std::vector<std::string_view> words = parts_of(row.words);
    if (std::find(words.begin(), words.end(), plain) != words.end()) return &row;
  }
  return nullptr;
}

}  // namespace carom
