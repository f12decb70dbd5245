#pragma once
// The kinds of writers. Each has one row, and is opened only if the scene requests it.

#include "export/timeline.h"
#include "export/writer.h"
#include "files/folder_writer.h"
#include "render/model.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

struct Scene;

struct WriterKind {
  string_view name;  // the name of its OutputKind
  /// Opens its files. What can be refused in advance is refused before. Throws ExportError.
  unique_ptr<Writer> (*open)(FolderWriter& folder, const Scene& scene, const ModelMakers& makers);
  /// An estimate of the bytes of all its files at this number of instants.
  double (*bytes)(const Scene& scene, double instants);
  /// The rows and columns of its table at this number of instants. Null: it has none, or its rows are not known ahead.
  TableSize (*size)(const Scene& scene, double instants) = nullptr;
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
