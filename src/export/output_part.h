#pragma once
// The outputs that are made in one way through a motion, with the timeline of their instants.
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "export/timeline.h"
#include "export/writer.h"

namespace carom {

class OutputPart {
 public:
  /// The timeline ends at `end` (s).
  explicit OutputPart(double end) : timeline_(end) {}

  /// Adds a writer of the kind with this number, which takes states at these instants. Empty: it writes no states.
  void add(std::size_t kind, std::unique_ptr<Writer> writer, std::span<const Ticks> ticks);

  Timeline& timeline() { return timeline_; }
  const Timeline& timeline() const { return timeline_; }
  /// Whether any writer is due at the timeline's present instant.
  bool needs_state() const;
  /// The same for outputs of contact forces.
  bool needs_contacts() const;

  void record(std::span<const Collision> collisions) const;
  void record_paths(std::span<const PathPiece> pieces) const;
  void record_crossings(std::span<const RegionCrossing> crossings) const;
  /// Writes the rows that are due. `contacts`: sorted by a, then b; read only if needs_contacts().
  void sample(const State& state, std::span<const ContactForce> contacts = {}) const;
  /// Ends the run for all writers, after which they record and sample nothing.
  void end(const Tally& tally) const;

  struct OpenWriter {
    std::size_t kind;  // its number among the kinds of outputs
    std::unique_ptr<Writer> writer;
    std::vector<int> timeline_streams;  // empty: it writes no states
  };
  std::span<const OpenWriter> writers() const { return writers_; }

  void keep(auto& archive) {
    archive(timeline_);
    for (const OpenWriter& open : writers_) open.writer->keep(archive);
  }

 private:
  bool due(const OpenWriter& open) const;

  Timeline timeline_;
  std::vector<OpenWriter> writers_;
};

}  // namespace carom
