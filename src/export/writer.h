#pragma once
// The interface of outputs made from states and collisions. Picture outputs are separate.

#include "files/output_file.h"
#include "files/summary.h"
#include "physics/archive.h"
#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "physics/world_region.h"
#include "std.h"

namespace carom {

/// Goes on with a file that is written, or keeps how far it is.
void keep_part(StateWriter& archive, OutputFile& file);
void keep_part(StateReader& archive, OutputFile& file);

class Writer {
 public:
  virtual ~Writer() = default;
  /// Takes collisions, in the order of occurrence.
  virtual void record(span<const Collision>) {}
  /// Takes pieces of paths, in order.
  virtual void record_paths(span<const PathPiece>) {}
  /// Takes crossings of regions, in order.
  virtual void record_crossings(span<const RegionCrossing>) {}
  /// Whether add() reads the contact forces.
  virtual bool needs_contacts() const { return false; }
  /// Takes the state at an instant (s) at which this output is due. `contacts`: by a, then b.
  virtual void add(double, const State&, span<const ContactForce>) {}
  /// Ends the run.
  virtual void end(const Tally&) {}
  /// How large its table is so far. None: it writes no table.
  virtual optional<TableSize> size() const { return nullopt; }
  /// The files that this output has given up.
  virtual vector<LeftOut> left_out() const { return {}; }
  /// Its files with all their bytes, not yet complete. Called after end().
  virtual vector<OutputFile*> files() = 0;
  /// Its page about the whole run, with all its bytes, not yet complete. Called last, with the files of all others.
  virtual OutputFile* page(const Summary&, const RunFacts&, span<const FileRecord>) { return nullptr; }
  /// Its files that already have their final names.
  virtual vector<FileRecord> published() const { return {}; }

  /// Its state between two records or instants, of a run that goes on later. By default that is how far its files are.
  virtual void keep(StateWriter& archive);
  /// Takes it over, newly opened. Throws ArchiveError.
  virtual void keep(StateReader& archive);
};

}  // namespace carom
