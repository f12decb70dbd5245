// Formats numbers in blocks on a background thread, directly into the buffers of the files.
// Formatting dominates the cost of a long table, so the simulation only copies numbers.
#include "export/tables.h"

#include <numeric>

#include "export/bodies.h"
#include "files/manifest.h"
#include "files/summary_columns.h"
#include "physics/energy.h"
#include "physics/world.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr string_view long_heads = "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";
constexpr array<string_view, 6> motion_columns = {"x_m", "y_m", "z_m", "vx_m_per_s", "vy_m_per_s", "vz_m_per_s"};

/// The maximum number of characters of six numbers, each after a separator.
constexpr size_t motion_size = 6 * (number_size + 1);

/// Rows of a block: enough to make passing it on negligible, and few enough to stay in cache.
constexpr size_t block_rows = 4096;

/// From the second block on, formatting happens on a thread.
constexpr uint64_t blocks_alone = 1;

/// The dialect of most tables, known where their many numbers are formatted.
struct UsualDialect {
  static constexpr char separator = ',';
};

char* put_cell(char* to, double value, UsualDialect) {
  return put_number(to, value);
}
char* put_cell(char* to, double value, CsvDialect dialect) {
  return put_number(to, value, dialect);
}

/// Writes a separator and a number.
template <typename Dialect>
char* put_next(char* to, double value, Dialect dialect) {
  *to++ = dialect.separator;
  return put_cell(to, value, dialect);
}

template <typename Dialect>
char* put_motion(char* to, const Vec3& position, const Vec3& velocity, Dialect dialect) {
  for (int axis = 0; axis < 3; ++axis) to = put_next(to, position[axis], dialect);
  for (int axis = 0; axis < 3; ++axis) to = put_next(to, velocity[axis], dialect);
  return to;
}

/// Writes the first cell of a row.
void write_time(OutputFile& file, double time) {
  file.written(put_number(file.room(number_size), time, file.dialect()));
}

/// The bodies that have rows in trajectory.csv.
vector<Entity> bodies_in_rows(const Scene& scene) {
  if (!scene.output.trajectory->bodies.empty()) return scene.output.trajectory->bodies;
  vector<Entity> all(scene.world.body_count());
  std::iota(all.begin(), all.end(), Entity{0});
  return all;
}

/// Writes a separator and the name of a body, fixed thing or string. The cell of no_entity is empty.
void write_name(OutputFile& file, const Roster& roster, Entity bodies, Entity entity) {
  const char separator = file.dialect().separator;
  file.write({&separator, 1});
  if (entity < bodies) {
    const BodyRange& range = roster.range_of(entity);
    file.written(put_member(file.room(range.name.size() + member_size), range, entity));
  } else if (entity != no_entity) {
    const size_t after_bodies = entity - bodies;
    file.write(after_bodies < roster.fixed.size() ? roster.fixed[after_bodies].name
                                                  : roster.strings[after_bodies - roster.fixed.size()]);
  }
}

}  // namespace

string_view name_of(CollisionKind kind) {
  switch (kind) {
    case CollisionKind::body_body:
      return "body-body";
    case CollisionKind::body_fixed:
      return "body-fixed";
    case CollisionKind::rest:
      return "rest";
    case CollisionKind::merge:
      return "merge";
    case CollisionKind::taut:
      return "string";
  }

  return "";
}

optional<CollisionKind> collision_kind_named(string_view name) {
  for (const CollisionKind kind : {CollisionKind::body_body, CollisionKind::body_fixed, CollisionKind::rest,
                                   CollisionKind::merge, CollisionKind::taut})
    if (name_of(kind) == name) return kind;
  return nullopt;
}

TableWriter::TableWriter(const FilePlace& place, const Scene& scene, string name, string_view heads)
    : name_(std::move(name)),
      columns_(1 + uint64_t(ranges::count(heads, ','))),
      file_(place, table_file(scene.output.tables, name_ + ".csv"), CsvDialect(scene.output.tables)),
      separator_(file_.dialect().separator) {
  string row(heads);
  ranges::replace(row, ',', separator_);
  file_.write(row);
}

void TableWriter::keep(StateWriter& archive) {
  archive(rows_);
  Writer::keep(archive);
}

void TableWriter::keep(StateReader& archive) {
  archive(rows_);
  Writer::keep(archive);
}

TrajectoryTable::TrajectoryTable(const FilePlace& place, const Scene& scene)
    : TableWriter(place, scene, "trajectory", scene.output.trajectory->wide ? "time_s" : long_heads),
      scene_(scene),
      bodies_(bodies_in_rows(scene)),
      blocks_([this](Block& block) { write(block); }, blocks_alone) {
  if (!scene.output.trajectory->wide) return;

  columns_ += bodies_.size() * motion_columns.size();
  for (const Entity body : bodies_) {
    const BodyRange& range = scene.roster.range_of(body);
    for (const string_view column : motion_columns) {
      char* to = file_.room(range.name.size() + member_size + column.size() + 2);
      *to++ = separator_;
      to = put_member(to, range, body);
      *to++ = '.';
      file_.written(put_text(to, column));
    }
  }
  file_.write("\n");
}

void TrajectoryTable::add(double time, const State& state, span<const ContactForce>) {
  constexpr double none = numeric_limits<double>::quiet_NaN();
  const auto bodies = Entity(bodies_.size());
  rows_ += scene_.output.trajectory->wide ? 1 : bodies;

  Entity first = 0;
  do {
    Block& block = blocks_.item();
    const auto room = Entity(block_rows - block.motions.size());
    const Part part{time, first, min(room, bodies - first)};
    block.parts.push_back(part);

    // Of a body that is gone there is no row.
    for (const Entity body : span(bodies_).subspan(first, part.count)) {
      block.motions.push_back({state.position[body], state.velocity[body]});
      if (!is_gone(state, body)) continue;
      block.motions.back().position.x() = none;
      if (!scene_.output.trajectory->wide) --rows_;
    }

    first += part.count;
    if (block.motions.size() == block_rows || block.parts.size() == block_rows) blocks_.send();
  } while (first < bodies);
}

vector<OutputFile*> TrajectoryTable::files() {
  if (!blocks_.item().parts.empty()) blocks_.send();
  blocks_.finish();
  return {&file_};
}

void TrajectoryTable::write(Block& block) {
  if (file_.dialect() == CsvDialect())
    write(block, UsualDialect());
  else
    write(block, file_.dialect());
  block.parts.clear();
  block.motions.clear();
}

template <typename Dialect>
void TrajectoryTable::write(const Block& block, Dialect dialect) {
  const Motion* motion = block.motions.data();
  for (const Part& part : block.parts) {
    if (scene_.output.trajectory->wide)
      write_wide(part, motion, dialect);
    else
      write_long(part, motion, dialect);
    motion += part.count;
  }
}

template <typename Dialect>
void TrajectoryTable::write_long(const Part& part, const Motion* motion, Dialect dialect) {
  if (part.count == 0) return;
  // All bodies share the digits of the time, which are formatted once and copied.
  char time_text[number_size];
  const string_view time_cell(time_text, size_t(put_cell(time_text, part.time, dialect) - time_text));

  const BodyRange* range = &scene_.roster.range_of(bodies_[part.first]);
  for (const Entity body : span(bodies_).subspan(part.first, part.count)) {
    const Motion& at = *motion++;
    while (body >= range->first + range->count) ++range;
    if (!isfinite(at.position.x())) continue;

    char* to = file_.room(number_size + range->name.size() + member_size + motion_size + 2);
    to = put_text(to, time_cell);
    *to++ = dialect.separator;
    to = put_member(to, *range, body);
    to = put_motion(to, at.position, at.velocity, dialect);
    *to++ = '\n';
    file_.written(to);
  }
}

template <typename Dialect>
void TrajectoryTable::write_wide(const Part& part, const Motion* motion, Dialect dialect) {
  const string none(motion_columns.size(), separator_);
  if (part.first == 0) write_time(file_, part.time);
  for (Entity i = 0; i < part.count; ++i, ++motion) {
    if (isfinite(motion->position.x()))
      file_.written(put_motion(file_.room(motion_size), motion->position, motion->velocity, dialect));
    else
      file_.write(none);
  }
  if (part.first + part.count == bodies_.size()) file_.write("\n");
}

CollisionTable::CollisionTable(const FilePlace& place, const Scene& scene)
    : TableWriter(place, scene, "collisions",
                  "time_s,kind,a,b,x_m,y_m,z_m,nx,ny,nz,approach_speed_m_per_s,separation_speed_m_per_s,restitution,"
                  "impulse_N_s,energy_lost_J\n"),
      roster_(scene.roster),
      bodies_(scene.world.body_count()),
      blocks_([this](vector<Collision>& collisions) { write(collisions); }, blocks_alone) {}

void CollisionTable::record(span<const Collision> collisions) {
  rows_ += collisions.size();
  while (!collisions.empty()) {
    vector<Collision>& block = blocks_.item();
    const size_t count = min(block_rows - block.size(), collisions.size());
    block.insert(block.end(), collisions.begin(), collisions.begin() + ptrdiff_t(count));
    collisions = collisions.subspan(count);
    if (block.size() == block_rows) blocks_.send();
  }
}

vector<OutputFile*> CollisionTable::files() {
  if (!blocks_.item().empty()) blocks_.send();
  blocks_.finish();
  return {&file_};
}

void CollisionTable::write(vector<Collision>& collisions) {
  for (const Collision& collision : collisions) {
    write_time(file_, collision.time);
    file_.write({&separator_, 1});
    file_.write(name_of(collision.kind));
    for (const Entity entity : {collision.a, collision.b}) write_name(file_, roster_, bodies_, entity);

    const CsvDialect dialect = file_.dialect();
    char* to =
        put_motion(file_.room(motion_size + 5 * (number_size + 1) + 1), collision.position, collision.normal, dialect);
    for (const double value : {collision.approach_speed, collision.separation_speed, collision.restitution,
                               collision.impulse, collision.energy_lost})
      to = put_next(to, value, dialect);

    *to++ = '\n';
    file_.written(to);
  }
  collisions.clear();
}

ContactTable::ContactTable(const FilePlace& place, const Scene& scene)
    : TableWriter(place, scene, "contacts", "time_s,a,b,force_N\n"),
      roster_(scene.roster),
      bodies_(scene.world.body_count()) {}

void ContactTable::add(double time, const State&, span<const ContactForce> contacts) {
  rows_ += contacts.size();
  for (const ContactForce& contact : contacts) {
    write_time(file_, time);
    for (const Entity entity : {contact.a, contact.b}) write_name(file_, roster_, bodies_, entity);
    file_.written(put_next(file_.room(number_size + 1), contact.force, file_.dialect()));
    file_.write("\n");
  }
}

RegionTable::RegionTable(const FilePlace& place, const Scene& scene)
    : TableWriter(place, scene, "regions", "time_s,region,body,what\n"),
      roster_(scene.roster),
      bodies_(scene.world.body_count()) {}

void RegionTable::record_crossings(span<const RegionCrossing> crossings) {
  rows_ += crossings.size();
  for (const RegionCrossing& crossing : crossings) {
    write_time(file_, crossing.time);
    file_.write({&separator_, 1});
    const bool appears = crossing.region == RegionCrossing::world;
    if (!appears) file_.write(roster_.regions[crossing.region]);
    write_name(file_, roster_, bodies_, crossing.body);
    file_.write({&separator_, 1});
    file_.write(appears ? "appear\n" : crossing.enters ? "enter\n" : "leave\n");
  }
}

EnergyTable::EnergyTable(const FilePlace& place, const Scene& scene)
    : TableWriter(place, scene, "energy",
                  "time_s,kinetic_J,potential_J,total_J,px_kg_m_per_s,py_kg_m_per_s,pz_kg_m_per_s\n"),
      world_(scene.world) {}

void EnergyTable::add(double time, const State& state, span<const ContactForce>) {
  const double kinetic = kinetic_energy(world_, state);
  const double potential = potential_energy(world_, state);
  const Vec3 p = momentum(world_, state);
  ++rows_;
  CsvRow row(file_);
  row.number(time).number(kinetic).number(potential).number(kinetic + potential);
  row.number(p.x()).number(p.y()).number(p.z()).end();
}

void write_summary(OutputFile& file, const Summary& s) {
  CsvRow row(file);
  for (const SummaryColumn& column : summary_columns()) row.text(column.name);
  for (const Measured& measure : s.measures) row.text(measure.name);
  row.end();

  for (const SummaryColumn& column : summary_columns()) {
    const auto value = column.value(s);
    if (const auto* text = std::get_if<string_view>(&value))
      row.text(valid_utf8(string(*text)));
    else if (const auto* count = std::get_if<uint64_t>(&value))
      row.count(*count);
    else
      row.number(std::get<double>(value));
  }
  for (const Measured& measure : s.measures)
    measure.text.empty() ? row.number(measure.value) : row.text(valid_utf8(measure.text));
  row.end();
}

}  // namespace carom
