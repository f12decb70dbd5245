#include "export/output_part.h"

#include "std.h"

namespace carom {

void OutputPart::add(size_t kind, unique_ptr<Writer> writer, span<const Ticks> ticks) {
  OpenWriter& open = writers_.emplace_back(OpenWriter{kind, std::move(writer), {}});
  for (const Ticks& some : ticks) open.timeline_streams.push_back(timeline_.add(some));
}

bool OutputPart::due(const OpenWriter& open) const {
  return any_of(open.timeline_streams, [&](int stream) { return timeline_.due(stream).has_value(); });
}

bool OutputPart::needs_state() const {
  return any_of(writers_, [&](const OpenWriter& open) { return due(open); });
}

bool OutputPart::needs_contacts() const {
  return any_of(writers_, [&](const OpenWriter& open) { return due(open) && open.writer->needs_contacts(); });
}

void OutputPart::record(span<const Collision> collisions) const {
  for (const OpenWriter& open : writers_) open.writer->record(collisions);
}

void OutputPart::record_paths(span<const PathPiece> pieces) const {
  for (const OpenWriter& open : writers_) open.writer->record_paths(pieces);
}

void OutputPart::record_crossings(span<const RegionCrossing> crossings) const {
  for (const OpenWriter& open : writers_) open.writer->record_crossings(crossings);
}

void OutputPart::sample(const State& state, span<const ContactForce> contacts) const {
  for (const OpenWriter& open : writers_)
    if (due(open)) open.writer->add(timeline_.time(), state, contacts);
}

void OutputPart::end(const Tally& tally) const {
  for (const OpenWriter& open : writers_) open.writer->end(tally);
}

}  // namespace carom
