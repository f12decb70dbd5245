#pragma once
// The CSV files of a run. Each is made only if the scene requests it.
// Long tables format their numbers on a background thread.

#include "export/writer.h"
#include "files/conveyor.h"
#include "files/csv.h"
#include "files/output_file.h"
#include "std.h"

namespace carom {

struct Roster;
struct Scene;
struct World;

struct Summary;

/// As in the column `kind` of collisions.csv.
string_view name_of(CollisionKind kind);
/// None: no kind has this name.
optional<CollisionKind> collision_kind_named(string_view name);

/// A table of a run, in the scene's dialect, compressed if the scene requests that.
class TableWriter : public Writer {
 public:
  vector<OutputFile*> files() override { return {&file_}; }
  optional<TableSize> size() const override { return TableSize{name_, rows_, columns_}; }
  void keep(StateWriter& archive) override;
  void keep(StateReader& archive) override;

 protected:
  /// `name`: of the output. `heads`: the names of the columns, separated by commas.
  TableWriter(const FilePlace& place, const Scene& scene, string name, string_view heads);

  string name_;
  uint64_t rows_ = 0, columns_ = 0;  // without heads
  OutputFile file_;
  const char separator_;
};

/// trajectory.csv. Long form: a row for each body and instant, by time then body.
/// Wide form: a row for each instant, six columns for each body:
/// time_s,<name>.x_m,<name>.y_m,<name>.z_m,<name>.vx_m_per_s,<name>.vy_m_per_s,<name>.vz_m_per_s,...
/// A body that has merged into another has no rows from then on. In a wide table its cells are empty.
/// With `on` only those bodies have rows, or columns.
class TrajectoryTable : public TableWriter {
 public:
  TrajectoryTable(const FilePlace& place, const Scene& scene);
  void add(double time, const State& state, span<const ContactForce> contacts) override;
  vector<OutputFile*> files() override;

 private:
  struct Motion {
    /// In m and m/s. Not finite: the body has merged into another.
    Vec3 position, velocity;
  };
  /// The motions of `count` of the bodies with rows at one instant, from number `first` of these on.
  struct Part {
    double time;  // s
    Entity first, count;
  };
  /// Numbers that wait to be formatted.
  struct Block {
    vector<Part> parts;
    vector<Motion> motions;
  };
  void write(Block& block);
  template <typename Dialect>
  void write(const Block& block, Dialect dialect);
  template <typename Dialect>
  void write_long(const Part& part, const Motion* motion, Dialect dialect);
  template <typename Dialect>
  void write_wide(const Part& part, const Motion* motion, Dialect dialect);

  const Scene& scene_;
  const vector<Entity> bodies_;  // those with rows, ascending
  /// Last, because its thread writes into file_.
  Conveyor<Block> blocks_;
};

/// collisions.csv: a row for each collision, in the order of occurrence.
class CollisionTable : public TableWriter {
 public:
  CollisionTable(const FilePlace& place, const Scene& scene);
  void record(span<const Collision> collisions) override;
  vector<OutputFile*> files() override;

 private:
  void write(vector<Collision>& collisions);

  const Roster& roster_;
  Entity bodies_;
  /// Last, because its thread writes into file_.
  Conveyor<vector<Collision>> blocks_;
};

/// contacts.csv: a row for each instant and pair in lasting contact, by time, then a, then b.
class ContactTable : public TableWriter {
 public:
  ContactTable(const FilePlace& place, const Scene& scene);
  bool needs_contacts() const override { return true; }
  void add(double time, const State& state, span<const ContactForce> contacts) override;

 private:
  const Roster& roster_;
  Entity bodies_;
};

/// regions.csv: a row for each crossing of a region, by time, then region, then body.
class RegionTable : public TableWriter {
 public:
  RegionTable(const FilePlace& place, const Scene& scene);
  void record_crossings(span<const RegionCrossing> crossings) override;

 private:
  const Roster& roster_;
  Entity bodies_;
};

/// energy.csv: a row for each instant.
class EnergyTable : public TableWriter {
 public:
  EnergyTable(const FilePlace& place, const Scene& scene);
  void add(double time, const State& state, span<const ContactForce> contacts) override;

 private:
  const World& world_;
};

/// summary.csv: its single row.
void write_summary(OutputFile& file, const Summary& summary);

}  // namespace carom
