// Packs entries while they happen, block by block, in memory of constant size for each body.
#include "export/flights_file.h"

#include <fmt/format.h>

#include <cstring>

#include "export/flights_format.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

using namespace flights_format;

namespace {

/// Bytes of a block before it is packed. Smaller blocks have more bytes in all, larger ones hardly fewer.
constexpr size_t block_size = size_t{256} * 1024;

/// From one key to the next are so many times the bytes of a key. The first one is expected to have so many for a body.
constexpr uint64_t key_share = 64;
constexpr uint64_t key_bytes_of_body = 64;

/// Writes values into a buffer in place.
class InPlace {
 public:
  explicit InPlace(char* to) : to_(to) {}
  template <typename T>
  void put(const T& value) {
    std::memcpy(to_, &value, sizeof value);
    to_ += sizeof value;
  }
  void put(const Vec3& v) {
    for (int k = 0; k < 3; ++k) put(v[k]);
  }
  const char* end() const { return to_; }

 private:
  char* to_;
};

}  // namespace

double flight_bytes(double of_events, double of_crowd) {
  // Measured: 4 to 7 in gases, 17 to 30 in scenes of rest and rolling; 22 to 26 in piles.
  constexpr double event_bytes = 10;
  constexpr double crowd_bytes = 25;
  return event_bytes * of_events + crowd_bytes * of_crowd;
}

FlightsFile::FlightsFile(const Scene& scene, uint64_t most)
    : has_collisions_(drawings_show_collisions(scene)),
      has_impulses_(sounds(scene)),
      world_(scene.world),
      most_(most),
      bytes_(header_size + tail_size + sizeof(double) * scene.world.triggers.all.size()),
      codec_(scene.world, has_impulses_),
      next_key_(key_share * key_bytes_of_body * scene.world.body_count()) {}

FlightsFile::FlightsFile(const FilePlace& place, const Scene& scene, uint64_t most) : FlightsFile(scene, most) {
  file_.emplace(place, flights_name);
  begin(scene);
}

FlightsFile::FlightsFile(const FilePlace& place, const Scene& scene, Nameless) : FlightsFile(scene, 0) {
  keeps_whole_ = true;
  file_.emplace(place, nameless_file(place));
  begin(scene);
}

void FlightsFile::begin(const Scene& scene) {
  file_->write(magic);
  InPlace writer(file_->room(header_size));
  writer.put(version);
  writer.put(byte_order);
  writer.put(scene.world.body_count() | (has_collisions_ ? collisions_bit : 0) | (has_impulses_ ? impulses_bit : 0));
  writer.put(scene.simulate.duration);
  file_->written(writer.end());
}

void FlightsFile::record(span<const Collision> collisions) {
  if (has_collisions_) collisions_.insert(collisions_.end(), collisions.begin(), collisions.end());
}

/// The pieces of the last instant are held until one of another is known, so that neither the order nor the bytes
/// depend on where an advance ends. The first pieces of all bodies come before whatever happens at time 0.
void FlightsFile::record_paths(span<const PathPiece> pieces) {
  for (const PathPiece& piece : pieces) {
    if (!group_.empty() && piece.from != group_.back().from) end_group(&piece);
    group_.push_back(piece);
    if (entries_ == 0 && group_.size() == world_.body_count()) put_group(nullptr);
  }
}

/// Writes the pieces of an instant, and before them the collisions until then.
void FlightsFile::end_group(const PathPiece* next) {
  while (!group_.empty() && !collisions_.empty()) {
    const optional<CollisionMark> mark = mark_until(collisions_.front(), group_.front().from);
    if (!mark) break;
    put(*mark);
    collisions_.pop_front();
  }
  put_group(next);
}

/// Writes the pieces of an instant, before the piece `next`.
void FlightsFile::put_group(const PathPiece* next) {
  for (size_t k = 0; k < group_.size(); ++k) put(group_[k], k + 1 < group_.size() ? &group_[k + 1] : next);
  group_.clear();
}

void FlightsFile::put(const CollisionMark& collision) {
  if (!file_) return;
  codec_.write(columns_, collision);
  count();
}

void FlightsFile::put(const PathPiece& piece, const PathPiece* next) {
  if (!file_) return;
  codec_.write(columns_, piece, next, world_);
  count();
}

/// Counts an entry, and ends the block if it is full.
void FlightsFile::count() {
  ++in_block_;
  ++entries_;
  if (columns_.size() < block_size) return;
  end_block(of_entries, columns_, exchange(in_block_, 0), block_time_);
  if (file_ && bytes_ >= next_key_) put_key();
  block_time_ = codec_.from();
  codec_.begin_block(block_time_);
}

/// Writes a block, or leaves the file out if it becomes too large.
void FlightsFile::end_block(uint32_t kind, ColumnWriter& columns, uint32_t entries, double time) {
  packed_.resize(block_head);
  columns.pack(packed_);

  InPlace writer(packed_.data());
  writer.put(kind);
  writer.put(entries);
  writer.put(uint32_t(packed_.size() - block_head));
  writer.put(uint32_t{0});
  writer.put(time);

  const uint32_t checksum = checksum_of(packed_);
  std::memcpy(packed_.data() + checksum_place, &checksum, sizeof checksum);

  bytes_ += packed_.size();
  if (bytes_ > most_ && !keeps_whole_) return file_.reset();
  file_->write({packed_.data(), packed_.size()});
}

/// Writes the present piece of every body.
void FlightsFile::put_key() {
  const uint64_t begin = bytes_;
  keys_.push_back({codec_.from(), begin - tail_size - key_size * keys_.size(), entries_});
  bytes_ += key_size;

  // In order of time, as all entries.
  vector<const PathPiece*> pieces;
  for (const PathPiece& piece : codec_.present())
    if (piece.body != no_entity) pieces.push_back(&piece);
  ranges::stable_sort(pieces, {}, [](const PathPiece* piece) { return piece->from; });

  PathCodec codec(world_);
  ColumnWriter columns;
  uint32_t kind = of_key;
  uint32_t entries = 0;
  double time = 0;  // s

  for (size_t k = 0; k < pieces.size(); ++k) {
    codec.write(columns, *pieces[k], nullptr, world_);
    ++entries;
    if (columns.size() < block_size && k + 1 < pieces.size()) continue;
    end_block(exchange(kind, more_of_key), columns, exchange(entries, 0), time);
    if (!file_) return;
    codec.begin_block(time = codec.from());
  }
  next_key_ = bytes_ + key_share * (bytes_ - begin);
}

void FlightsFile::end(const Tally& tally) {
  end_group(nullptr);
  for (const Collision& collision : collisions_) put(mark_of(collision));
  if (file_ && in_block_ > 0) end_block(of_entries, columns_, in_block_, block_time_);
  if (!file_) return;

  const bool has_end = tally.end || tally.changes.removed.bodies + tally.changes.appeared.bodies > 0;
  InPlace writer(
      file_->room(key_size * keys_.size() + sizeof(double) * tally.changes.fired.size() + end_size + tail_size));
  for (const FlightsKey& key : keys_) {
    writer.put(key.time);
    writer.put(key.place);
    writer.put(key.entries);
  }

  for (const double time : tally.changes.fired) writer.put(time);

  if (has_end) {
    const RunEnd end = tally.end.value_or(RunEnd{numeric_limits<double>::quiet_NaN()});
    writer.put(end.time);
    writer.put(uint32_t(end.reason));
    writer.put(end.region);
    for (const Passage& passage : {tally.changes.removed, tally.changes.appeared}) {
      writer.put(passage.bodies);
      writer.put(passage.energy);
      writer.put(passage.momentum);
    }
  }

  writer.put(last_entry);
  writer.put(uint32_t{has_end});
  writer.put(uint64_t{keys_.size()});
  writer.put(entries_);
  for (const uint64_t* count : counts_of(tally)) writer.put(*count);
  for (const Entity entity : {tally.shared.body, tally.shared.one, tally.shared.other}) writer.put(uint64_t{entity});
  for (const double* value : values_of(tally)) writer.put(*value);
  file_->written(writer.end());
}

Descriptor FlightsFile::reopened() {
  return file_->reopened();
}

vector<LeftOut> FlightsFile::left_out() const {
  if (file_ && bytes_ <= most_) return {};
  return {{flights_name, fmt::format("larger than {:.3g} GB", 1e-9 * double(most_))}};
}

vector<OutputFile*> FlightsFile::files() {
  return file_ && bytes_ <= most_ ? vector{&*file_} : vector<OutputFile*>();
}

}  // namespace carom
