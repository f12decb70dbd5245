#pragma once
// A checked tree -> the parts of a Scene. Each function adds what is wrong beyond the reach of the table of fields:
// values that contradict one another, names that mean nothing, things that overlap.
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "numerics/vec3.h"
#include "physics/entity.h"
#include "physics/volume.h"
#include "scene/forms.h"
#include "scene/load.h"
#include "scene/view.h"
#include "yaml/diagnostics.h"
#include "yaml/document.h"

namespace carom {

struct Scene;

/// One ball, body or group, in the order of the file.
struct BodyEntry {
  const Key* key;
  const Node* node;
  const Kind* kind;
  bool group;
  Entity first = 0;
  std::uint64_t count = 1;
};

/// One plane, room, wall or obstacle, in the order of entities.
struct FixedEntry {
  const Key* key;
  const Node* node;
  const Kind* kind;
  Entity first = 0;  // the number among the fixed things
  Entity count = 1;  // a room has six
};

/// What the file names, in its order, and which numbers that gives.
struct Inventory {
  std::vector<BodyEntry> bodies;
  std::vector<FixedEntry> fixed;
  Entity body_count = 0;
  bool fits = true;  // false: over the budget, nothing may be allocated for bodies

  struct Range {
    Entity first, count;
  };
  std::unordered_map<std::string, Range> names;  // looked up only, never walked
};

/// Numbers everything; checks that names are unique and that the bodies are within `budget`.
Inventory take_inventory(const Node& root, const Budget& budget, Diagnostics& diagnostics);

void decode_fixed(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics);
/// Balls, bodies and groups: world, initial state, roster. Wants the fixed things and scene.seed decoded.
void decode_bodies(const Node& root, const Inventory& inventory, Forms& forms, Scene& scene, Diagnostics& diagnostics);
/// gravity, combine, pairs and forces.
void decode_laws(const Node& root, const Inventory& inventory, Scene& scene, Diagnostics& diagnostics);
/// simulate, camera, lights, background, output; and that frames and rows are within `budget`.
void decode_requests(const Node& root, const Inventory& inventory, const Budget& budget, Scene& scene,
                     Diagnostics& diagnostics);

/// Adds an error where places, sizes, speeds or forces are beyond what doubles carry. Wants all decoded but the members
/// of groups, and no error.
void check_reach(const Node& root, const Inventory& inventory, const Scene& scene, Diagnostics& diagnostics);

/// Adds an error where the run takes more steps of time than `budget` has. Wants all decoded.
void check_steps(const Node& root, const Scene& scene, const Budget& budget, Diagnostics& diagnostics);

/// Adds an error where the engine that the scene names cannot serve what stands in it. Wants all decoded.
void check_engine(const Node& root, const Scene& scene, Diagnostics& diagnostics);

/// Whether `output` asks for this part: a map, or true.
bool wanted(const View& output, std::string_view part);
/// The video's keys, with those of frames beneath.
View video_view(const View& output);

/// The way the height of a wall runs that does not say: y, for a level wall z.
Vec3 default_up(const Vec3& unit_normal);

/// v / |v|, without overflow or underflow on the way. v is not zero.
Vec3 unit(const Vec3& v);

/// The mass (kg) of a ball or body, from mass or density.
std::optional<double> mass_of(const View& body, const Volume& volume, Diagnostics& diagnostics);

/// A key of the scene as a View; empty if it is not there.
View scene_part(const Node& root, std::string_view key);

/// Views with the scene's defaults beneath.
View body_view(const Node& root, const BodyEntry& entry);  // of a ball, a body or a group
View member_view(const Node& root, const View& group);
View fixed_view(const Node& root, const FixedEntry& entry);

}  // namespace carom
