#pragma once
// The interface of outputs made from states and collisions. Picture outputs are separate.
// Each kind has one row, and is opened only if the scene requests it.

#include "export/timeline.h"
#include "files/open_folder.h"
#include "files/output_file.h"
#include "physics/archive.h"
#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "physics/world_region.h"
#include "render/model.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

struct Scene;

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
  /// The files that this output has given up.
  virtual vector<LeftOut> left_out() const { return {}; }
  /// Its files with all their bytes, not yet complete. Called after end().
  virtual vector<OutputFile*> files() = 0;
  /// Its files that already have their final names.
  virtual vector<FileRecord> published() const { return {}; }

  /// Its state between two records or instants, of a run that goes on later. By default that is how far its files are.
  virtual void keep(StateWriter& archive);
  /// Takes it over, newly opened. Throws ArchiveError.
  virtual void keep(StateReader& archive);
};

struct WriterKind {
  string_view name;  // the name of its OutputKind
  /// Opens its files. What can be refused in advance is refused before. Throws ExportError.
  unique_ptr<Writer> (*open)(OpenFolder& folder, const Scene& scene, const ModelMakers& makers);
  /// An estimate of the bytes of all its files at this number of instants.
  double (*bytes)(const Scene& scene, double instants);
  /// The instants at which it takes states, if not those of OutputKind::every.
  vector<Ticks> (*ticks)(const Scene& scene) = nullptr;
  /// Whether it needs something of the whole motion at its first state: the run's end, or a camera that frames all.
  /// Null: never.
  bool (*waits)(const Scene& scene) = nullptr;

  bool waits_for_motion(const Scene& scene) const { return waits != nullptr && waits(scene); }
};

/// In the order of output_kinds().
span<const WriterKind> writer_kinds();
const WriterKind* writer_named(string_view name);  // null: a picture output

}  // namespace carom
