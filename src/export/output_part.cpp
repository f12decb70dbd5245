#include "export/output_part.h"

#include <algorithm>
#include <utility>

namespace carom {

void OutputPart::add(std::size_t kind, std::unique_ptr<Writer> writer, std::span<const Ticks> ticks) {
  OpenWriter& open = writers_.emplace_back(OpenWriter{kind, std::move(writer), {}});
  for (const Ticks& some : ticks) open.timeline_streams.push_back(timeline_.add(some));
}

bool OutputPart::due(const OpenWriter& open) const {
  return std::any_of(open.timeline_streams.begin(), open.timeline_streams.end(),
                     [&](int stream) { return timeline_.due(stream).has_value(); });
}

bool OutputPart::needs_state() const {
  return std::any_of(writers_.begin(), writers_.end(), [&](const OpenWriter& open) { return due(open); });
}

bool OutputPart::needs_contacts() const {
  return std::any_of(writers_.begin(), writers_.end(),
                     [&](const OpenWriter& open) { return due(open) && open.writer->needs_contacts(); });
}

void OutputPart::record(std::span<const Collision> collisions) const {
  for (const OpenWriter& open : writers_) open.writer->record(collisions);
}

void OutputPart::record_paths(std::span<const PathPiece> pieces) const {
  for (const OpenWriter& open : writers_) open.writer->record_paths(pieces);
}

void OutputPart::record_crossings(std::span<const RegionCrossing> crossings) const {
  for (const OpenWriter& open : writers_) open.writer->record_crossings(crossings);
}

void OutputPart::sample(const State& state, std::span<const ContactForce> contacts) const {
  for (const OpenWriter& open : writers_)
    if (due(open)) open.writer->add(timeline_.time(), state, contacts);
}

void OutputPart::end(const Tally& tally) const {
  for (const OpenWriter& open : writers_) open.writer->end(tally);
}

}  // namespace carom
