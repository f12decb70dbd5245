#pragma once
// The whole request of a scene file, checked and constant from here on. Types only; load.h reads files into them.

#include "numerics/vec3.h"
#include "physics/state.h"
#include "physics/world.h"
#include "scene/colors.h"
#include "scene/film_clock.h"
#include "scene/former_state.h"
#include "scene/look.h"
#include "scene/mesh_turn.h"
#include "scene/output.h"
#include "scene/overlay.h"
#include "scene/simulate_settings.h"
#include "std.h"
#include "yaml/source.h"

namespace carom {

/// A mesh drawn in place of a volume. A vertex p of the file is drawn at position + scale * (turn * p - center).
struct MeshUse {
  string file;                 // relative to the working folder
  Vec3 center = Vec3::Zero();  // of the turned mesh, in the file's own units
  double scale = 1;            // m per unit of the file
  bool own_colors = false;     // the scene gives no colour: those of the file, where it has any
  MeshTurn turn = no_turn;
  double reach = 0;        // m, of the volume that `scale` is for; 0: of any
  bool is_volume = false;  // the volume is the one around it (`fit`)

  /// The scale for a ball of a group whose balls have radii of their own (m).
  double scale_for(double radius) const { return reach > 0 ? scale * (radius / reach) : scale; }
  friend bool operator==(const MeshUse&, const MeshUse&) = default;
};

/// A mesh file of the scene. The run's folder keeps a copy that the resolved text names.
/// The folder then runs by itself.
struct MeshFile {
  string file;  // as in MeshUse
  /// A plain file name, distinct from every other output's.
  /// Empty: a .gltf, or an .obj with materials, which is not copied because it refers to further files.
  string copy;
  /// Where a thing without a colour of its own names it, for errors of its textures. None: all have a colour.
  optional<Place> uncolored = nullopt;
};

/// The name of the repeated thing that a member belongs to: `bricks` of `bricks.3`. Empty: it is no member.
string_view family_of(string_view name);

/// A name of the scene file and its bodies: one ball or body, or a group's members name.0, name.1, ...
struct BodyRange {
  string name;
  Entity first = 0;
  Entity count = 1;
  bool group = false;
  Color color;
  optional<MeshUse> mesh = nullopt;
  optional<Coloring> coloring = nullopt;  // takes the place of `color` in pictures
  Surface surface = {};

  /// The name in the file: that of the repeated thing of which this is a member, or its own.
  string_view thing() const;
};

struct FixedLook {
  /// room.x_min etc. for the planes of a room.
  string name;
  Color color;
  bool visible = true;
  optional<MeshUse> mesh = nullopt;  // only of an obstacle
  // Of a flat part of a hollow obstacle: unit, to the inside, from where alone it is drawn.
  Vec3 inward = Vec3::Zero();
  Surface surface = {};
};

/// A thing with `repeat: 0`.
struct EmptyFamily {
  string_view of;  // the key of the scene: "balls", "strings"
  string name;
};

/// The names of bodies, fixed things and strings, in the order of the file. Every output has this order.
struct Roster {
  vector<BodyRange> bodies;  // ordered by first body
  /// By entity: the planes, the walls, the obstacles.
  vector<FixedLook> fixed;
  vector<string> strings;                        // by number in World::strings
  vector<string> regions;                        // by number in World::regions
  vector<string> events;                         // by number in World::triggers: "{region: gate}"
  vector<EmptyFamily> empty;                     // in no particular order
  string name(Entity e) const;                   // "red", "gas.17", "lane", "s1"
  const BodyRange& range_of(Entity body) const;  // the range that holds this body
};

/// The view of one picture.
struct Camera {
  Vec3 eye = Vec3::Zero();     // m
  Vec3 target = Vec3::Zero();  // m
  Vec3 up = Vec3(0, 1, 0);
  double fov = 45;  // degrees, along fov_horizontal's axis
  bool fov_horizontal = false;
  double near = 0.1;  // m
  double far = 1000;  // m

  void keep(auto& archive) { archive(eye, target, up, fov, fov_horizontal, near, far); }
  friend bool operator==(const Camera&, const Camera&) = default;
};

/// A view at a time. The camera moves smoothly from one to the next (render/camera_path.h).
struct Keyframe {
  double at = 0;               // s
  Vec3 eye = Vec3::Zero();     // m
  Vec3 target = Vec3::Zero();  // m
  double fov = 45;             // degrees, along fov_horizontal's axis
};

/// The bodies whose centre of mass a camera goes with.
struct Followed {
  Entity first = 0;
  Entity count = 1;
  bool has_eye = false;  // otherwise the eye, near and far follow from the bodies' size
};

/// The camera of all pictures. At most one of `fit`, `follow` and `path` is set. Without them it stands still.
struct CameraPlan : Camera {
  CameraPlan() = default;
  CameraPlan(const Camera& still) : Camera(still) {}

  /// It frames the motion. Eye, target, near and far come from that.
  bool fit = false;
  /// Of a camera that frames the motion: these bodies and fixed things alone, ascending. Empty: all.
  vector<Entity> fit_on;
  /// s: it goes round its target once in this time, about `up`, counterclockwise from above. 0: it does not.
  double orbit = 0;
  /// A parallel projection, as from far away. The picture is as high as in perspective at the target.
  bool orthographic = false;
  /// Eye and target are those of time 0, and go with these bodies.
  optional<Followed> follow;
  /// Eye, target and fov come from these. Ascending in time.
  vector<Keyframe> path;
};

struct Light {
  string name;
  /// The direction in which the light travels. Exactly one of `direction` and `position` is set.
  optional<Vec3> direction;
  optional<Vec3> position;  // m
  Color color;
  double intensity = 1;
};

/// A measure that the scene defines: a column of its summary.csv.
struct OwnMeasure {
  string name;
  string text;  // a measure, or '=' and an expression of measures (run/measure.h)
};

/// What the scene measures, and the numbers that measures may name.
struct Measures {
  vector<OwnMeasure> own;       // in the order of the file
  map<string, double> numbers;  // of `let`
};

/// Where values of the scene come from, if not from its file as numbers.
struct MadeFrom {
  /// The texts of expressions in the file, by their paths (expand.h).
  map<string, string> expressions{};
  optional<StartedFrom> start{};
  /// The files of `table`, relative to the working folder.
  vector<string> tables{};
  /// Sentences on the start that the author may not expect.
  vector<string> notes{};
};

/// What the motion tells of a scene. The loader does not know it.
struct KnownMotion {
  optional<double> ends_at{};     // s: where the run ends, if that is before its duration
  optional<Slowdown> slows_at{};  // the collision around which the film slows down
};

struct Background {
  optional<Color> color;     // none: that of the look
  bool transparent = false;  // there is none
};

struct Scene {
  string file;  // as given on the command line
  string title;
  uint64_t seed = 0;
  World world;
  State initial;  // at time 0, before impulses
  Roster roster;
  Simulate simulate;
  optional<CameraPlan> camera;  // none: one that frames the motion
  SceneLook look = SceneLook::studio;
  vector<Light> lights;  // empty: those of the look
  optional<Color> ambient;
  Background background;
  Overlay overlay;
  Output output;
  Measures measures;
  /// The outputs of the file, whichever of them --only leaves in `output`.
  Output requested;
  KnownMotion known{};
  vector<MeshFile> meshes;  // each file once
  MadeFrom made_from;
  /// YAML text: this scene with defaults and --set applied. Running it gives the same bytes.
  string resolved;
};

/// The end of the run as far as it is known (s).
inline double end_of(const Scene& scene) {
  return scene.known.ends_at.value_or(scene.simulate.duration);
}

/// Whether the run may end before its duration.
bool may_stop(const Scene& scene);

/// Whether the camera frames the whole motion.
inline bool frames_motion(const Scene& scene) {
  return !scene.camera || scene.camera->fit;
}

/// Whether a film of the scene slows down around a collision, whichever outputs --only leaves.
inline bool slows_down(const Scene& scene) {
  return (scene.output.video && scene.output.video->slow) || (scene.requested.video && scene.requested.video->slow);
}
/// The same for a film that has the sound of collisions.
inline bool sounds(const Scene& scene) {
  return (scene.output.video && scene.output.video->sound) || (scene.requested.video && scene.requested.video->sound);
}
/// The clock of a film of the scene.
inline FilmClock clock_of(const Scene& scene, const VideoOutput& video) {
  return {video.speed, video.from, video.slow ? scene.known.slows_at : nullopt};
}

/// Whether bodies are coloured by the number of their collisions.
bool colors_by_collisions(const Scene& scene);
/// Whether drawings of the motion depend on collisions and not only on paths: any picture of the scene, its camera, or
/// charts of a run that may end early.
bool drawings_show_collisions(const Scene& scene);

}  // namespace carom
