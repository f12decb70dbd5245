#pragma once
// The outputs that are made in one way through a motion, with the timeline of their instants.

#include "export/timeline.h"
#include "export/writer.h"
#include "std.h"

namespace carom {

class OutputPart {
 public:
  /// The timeline ends at `end` (s).
  explicit OutputPart(double end) : timeline_(end) {}

  /// Adds a writer of the kind with this number, which takes states at these instants. Empty: it writes no states.
  void add(size_t kind, unique_ptr<Writer> writer, span<const Ticks> ticks);

  Timeline& timeline() { return timeline_; }
  const Timeline& timeline() const { return timeline_; }
  /// Whether any writer is due at the timeline's present instant.
  bool needs_state() const;
  /// The same for outputs of contact forces.
  bool needs_contacts() const;

  void record(span<const Collision> collisions) const;
  void record_paths(span<const PathPiece> pieces) const;
  void record_crossings(span<const RegionCrossing> crossings) const;
  /// Writes the rows that are due. `contacts`: sorted by a, then b; read only if needs_contacts().
  void sample(const State& state, span<const ContactForce> contacts = {}) const;
  /// Ends the run for all writers, after which they record and sample nothing.
  void end(const Tally& tally) const;

  struct OpenWriter {
    size_t kind;  // its number among the kinds of outputs
    unique_ptr<Writer> writer;
    vector<int> timeline_streams;  // empty: it writes no states
  };
  span<const OpenWriter> writers() const { return writers_; }

  void keep(auto& archive) {
    archive(timeline_);
    for (const OpenWriter& open : writers_) open.writer->keep(archive);
  }

 private:
  bool due(const OpenWriter& open) const;

  Timeline timeline_;
  vector<OpenWriter> writers_;
};

}  // namespace carom
