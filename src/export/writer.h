#pragma once
// What writes an output from states and collisions, picture outputs aside: one row a kind, opened only if the scene
// asks for it.
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "files/open_folder.h"
#include "files/output_file.h"
#include "physics/collision.h"
#include "physics/contact_force.h"
#include "physics/path_piece.h"
#include "physics/state.h"
#include "physics/tally.h"
#include "render/model.h"

namespace carom {

struct Scene;

class Writer {
 public:
  virtual ~Writer() = default;
  /// Collisions, in the order in which they happened.
  virtual void record(std::span<const Collision>) {}
  /// Pieces of paths, in their order.
  virtual void record_paths(std::span<const PathPiece>) {}
  /// Whether add() looks at the forces of contact.
  virtual bool wants_contacts() const { return false; }
  /// The state at an instant at which this output is due (s). `contacts`: by a, then b.
  virtual void add(double, const State&, std::span<const ContactForce>) {}
  /// The run is at its end.
  virtual void end(const Tally&) {}
  /// Those of its files that it has given up.
  virtual std::vector<LeftOut> left_out() const { return {}; }
  /// Its files with all their bytes, not complete yet; after end().
  virtual std::vector<OutputFile*> files() = 0;
  /// Its files that have their names already.
  virtual std::vector<FileRecord> published() const { return {}; }
};

struct WriterKind {
  std::string_view name;  // its OutputKind's
  /// Opens its files; what can be refused without is refused before. Throws ExportError.
  std::unique_ptr<Writer> (*open)(OpenFolder& folder, const Scene& scene, const ModelMakers& makers);
  /// Roughly, of all its files, at so many instants.
  double (*bytes)(const Scene& scene, double instants);
};

/// In the order of output_kinds().
std::span<const WriterKind> writer_kinds();
const WriterKind* writer_named(std::string_view name);  // null: a picture output

}  // namespace carom
