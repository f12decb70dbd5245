#pragma once
// A checked tree to the parts of a Scene.
// Each function adds the errors that the table of fields cannot express.
// These are contradictory values, unknown names and overlaps.
#include <unordered_map>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "scene/forms.h"
#include "scene/load_options.h"
#include "scene/view.h"
#include "std.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

/// One ball, body or group, in the order of the file.
struct BodyEntry {
  const Key* key;
  View view;
  View each;  // the ball of a group; else the same
  bool group;
  Entity first = 0;
  uint64_t count = 1;
};

/// One plane, room, wall or obstacle, in the order of entities.
struct FixedEntry {
  const Key* key;
  View view;
  Entity first = 0;             // its number among the fixed things
  Entity count = 1;             // several for a room and a hollow thing
  vector<string_view> parts{};  // their names, if they have any
};

/// Share of the coordinates: a smaller region, or a shorter string, is lost in the rounding of positions.
inline constexpr double least_share_of_coordinates = 0x1p-40;

/// One string, in the order of the file.
struct StringEntry {
  const Key* key;
  View view;
};

/// The named things of a file, in its order, and their numbers.
struct Inventory {
  vector<BodyEntry> bodies;
  vector<FixedEntry> fixed;
  vector<StringEntry> strings;
  Entity body_count = 0;
  Entity fixed_count = 0;
  // False: over the budget, so nothing may be allocated for bodies.
  bool fits = true;

  struct Range {
    Entity first, count;
  };
  /// Whether it is one of the strings, which are numbered after the fixed things.
  bool is_string(const Range& range) const { return range.first >= body_count + fixed_count && range.count > 0; }
  /// "a fixed thing" or "a string", of what is no body.
  string_view word_for(const Range& range) const { return is_string(range) ? "a string" : "a fixed thing"; }
  // Looked up only, never iterated.
  std::unordered_map<string, Range> names;
  /// Repeated things, whose members have names in `names` too.
  std::unordered_map<string, Range> families;
};

/// Numbers all things. Checks that names are unique and that the number of bodies is within `budget`.
Inventory take_inventory(const Node& root, const Budget& budget, Diagnostics& diagnostics);

void decode_fixed(const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics);
/// Decodes balls, bodies and groups into world, initial state and roster.
/// The fixed things and scene.seed must be decoded before.
void decode_bodies(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics);
/// Decodes gravity, combine, pairs and forces. The regions must be decoded before.
void decode_laws(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// Decodes the strings, all but their lengths. Bodies need not be decoded before.
void decode_strings(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// Decodes the lengths of strings, and checks them against the distances of their ends. Bodies must be decoded before.
void decode_lengths(const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// Decodes the rest lengths of springs that have two ends and give none. Bodies must be decoded before.
void decode_rest_lengths(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// The body of one end of a string or a spring (`what`). None: an error was reported, here or before.
optional<Entity> body_at(const Node& name, const Inventory& inventory, string_view what, Diagnostics& diagnostics);
/// Decodes the regions. Bodies need not be decoded before.
void decode_regions(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// The numbers of a region, of all members of a repeated one, or of none where it has no members. The regions must be
/// decoded before. None: an error was reported.
optional<EntityRange> find_regions(const Node& name, const Scene& scene, Diagnostics& diagnostics);
/// Decodes `simulate.stop`. The regions and `simulate` must be decoded before.
void decode_stops(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// Decodes the camera. Bodies must be decoded before.
void decode_camera(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// Decodes simulate, lights, background and output. Checks that frames and rows are within the budget.
void decode_requests(const Node& root, const Inventory& inventory, const LoadOptions& options, Scene& scene,
                     Diagnostics& diagnostics);

/// Checks the title card of a film, and decodes the chart beside it. `part`: the map of the film. `title`: the scene's.
void decode_film_parts(const View& part, const Inventory& inventory, const string& title, VideoOutput& video,
                       Diagnostics& diagnostics);

/// Decodes caption, trails, flash, arrows, labels, scale_bar and shutter, and checks the colourings of bodies.
/// The bodies and the output must be decoded before.
void decode_overlay(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);

/// Adds an error where places, sizes, speeds or forces exceed what doubles can represent.
/// All but the members of groups must be decoded before, without an error.
void check_reach(const Node& root, const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics);

/// Adds an error where the run takes more time steps than `budget` allows. The whole scene must be decoded before.
void check_steps(const Node& root, const Scene& scene, const Budget& budget, Diagnostics& diagnostics);

/// Adds an error where the engine of the scene lacks something that the scene uses.
/// The whole scene must be decoded before.
void check_engine(const Node& root, const Scene& scene, Diagnostics& diagnostics);

/// What a name may stand for. The message about a name that does not exist lists these things alone.
enum class Sought : uint8_t { bodies, anything };
/// The numbers of a named thing: a body, group, member, fixed thing, string, the room or one of its sides.
/// A fixed thing or a string is found even where bodies are sought. None: an error was reported, here or before.
optional<Inventory::Range> find_range(const Node& name, const Inventory& inventory, Sought sought,
                                      Diagnostics& diagnostics);
/// The bodies in a list of names, in order. An empty list: all bodies. None: no body at all, or an error was reported.
/// `use`: what a fixed thing or a string cannot have, such as "no force acts on it".
optional<vector<Entity>> find_bodies(const Node* names, const Inventory& inventory, string_view use,
                                     Diagnostics& diagnostics);

/// The default direction of a wall's height: y, or z for a level wall.
Vec3 default_up(const Vec3& unit_normal);

/// v / |v|, without overflow or underflow in between. v must not be zero.
Vec3 unit(const Vec3& v);

/// A key of the scene as a View. The view is empty if the key is absent.
View scene_part(const Node& root, string_view key);

/// A thing of this kind as a View, with the scene's defaults beneath, and the ball of a group.
View thing_view(const Node& root, const Key& key, const Node& thing, const Kind& kind);
View member_view(const Node& root, const View& group);

}  // namespace carom
