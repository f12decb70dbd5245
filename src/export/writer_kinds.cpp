// The table of writers: how each output is opened, and an estimate of its size.
#include "export/writer_kinds.h"

#include "export/flights_file.h"
#include "export/gltf.h"
#include "export/plots_writer.h"
#include "export/report_writer.h"
#include "export/tables.h"
#include "export/vtk.h"
#include "export/xyz.h"
#include "numerics/whole.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

// Typical sizes, in bytes.

// The six numbers of a motion.
constexpr double motion_bytes = 114;
// A time.
constexpr double time_bytes = 6;
// A name.
constexpr double name_bytes = 8;
// A row of energy.csv.
constexpr double energy_bytes = 110;
// A row of collisions.csv.
constexpr double collision_bytes = 260;
// A row of contacts.csv.
constexpr double contact_bytes = 40;
// A row of regions.csv.
constexpr double crossing_bytes = 40;
// A piece of a path in flights.bin: 7 in a gas, 24 to 27 in a pile (tests/run/stored_flights_test.cpp), and 60 for the
// first one of a body.
constexpr double path_bytes = 30;

// The files of plots/: 260 kB for ten_pins, 340 kB for bouncing_ball.
constexpr double plots_bytes = 3e5;
// index.html: 60 kB for ten_pins.
constexpr double report_bytes = 6e4;

uint64_t nearest_count(double x) {
  return uint64_t(max<int64_t>(nearest_whole(x), 0));
}

template <typename Table>
unique_ptr<Writer> open(FolderWriter& folder, const Scene& scene, const ModelMakers&) {
  return make_unique<Table>(folder.place(), scene);
}

double trajectory_bytes(const Scene& scene, double instants) {
  const double bodies = rows_of(*scene.output.trajectory, scene.world.body_count()), rows = instants * bodies;
  return scene.output.trajectory->wide ? rows * motion_bytes + bodies * 6 * (name_bytes + 8) + instants * time_bytes
                                       : rows * (motion_bytes + time_bytes + name_bytes);
}

TableSize trajectory_size(const Scene& scene, double instants) {
  const World& world = scene.world;
  const TrajectoryOutput& output = *scene.output.trajectory;
  const double bodies = rows_of(output, world.body_count());
  if (output.wide) return {"trajectory", nearest_count(instants), 1 + 6 * nearest_count(bodies), may_stop(scene)};

  const bool bodies_vary = scene.simulate.contact.merge || !world.appears.empty() ||
                           any_of(world.regions, [](const WorldRegion& region) { return region.removes; });
  return {"trajectory", nearest_count(instants * bodies), 8, may_stop(scene) || bodies_vary};
}

TableSize energy_size(const Scene& scene, double instants) {
  return {"energy", nearest_count(instants), 7, may_stop(scene)};
}

constexpr WriterKind all_kinds[] = {
    {"trajectory", open<TrajectoryTable>, trajectory_bytes, trajectory_size},
    // The number of collisions is unknown. One for each body is assumed.
    {"collisions", open<CollisionTable>,
     [](const Scene& scene, double) { return collision_bytes * scene.world.body_count(); }},
    {"energy", open<EnergyTable>, [](const Scene&, double instants) { return energy_bytes * instants; }, energy_size},
    // The number of contacts is unknown. Half of the bodies are assumed to be at rest always.
    {"contacts", open<ContactTable>,
     [](const Scene& scene, double instants) { return contact_bytes * instants * scene.world.body_count() / 2; }},
    // The number of crossings is unknown. One for each body is assumed.
    {"regions", open<RegionTable>,
     [](const Scene& scene, double) { return crossing_bytes * scene.world.body_count(); }},
    {"vtk",
     [](FolderWriter& folder, const Scene& scene, const ModelMakers& makers) -> unique_ptr<Writer> {
       return make_unique<VtkWriter>(folder, scene, makers);
     },
     VtkWriter::bytes},
    {"xyz",
     [](FolderWriter& folder, const Scene& scene, const ModelMakers&) -> unique_ptr<Writer> {
       return make_unique<XyzWriter>(folder, scene);
     },
     XyzWriter::bytes},
    {"gltf",
     [](FolderWriter& folder, const Scene& scene, const ModelMakers& makers) -> unique_ptr<Writer> {
       return make_unique<GltfWriter>(folder, scene, makers);
     },
     GltfWriter::bytes, nullptr, nullptr, frames_motion},
    // The number of pieces is unknown. Three for each body are assumed.
    {"flights", open<FlightsFile>,
     [](const Scene& scene, double) { return 3 * path_bytes * scene.world.body_count(); }},
    {"plots",
     [](FolderWriter& folder, const Scene& scene, const ModelMakers&) -> unique_ptr<Writer> {
       return make_unique<PlotsWriter>(folder, scene);
     },
     [](const Scene&, double) { return plots_bytes; }, nullptr, PlotsWriter::ticks, may_stop},
    {"report",
     [](FolderWriter& folder, const Scene& scene, const ModelMakers&) -> unique_ptr<Writer> {
       return make_unique<ReportWriter>(folder, scene);
     },
     [](const Scene&, double) { return report_bytes; }, nullptr, PlotsWriter::ticks, may_stop},
};

}  // namespace

span<const WriterKind> writer_kinds() {
  return all_kinds;
}

const WriterKind* writer_named(string_view name) {
  for (const WriterKind& kind : all_kinds)
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace carom
