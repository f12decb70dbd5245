// Reads blocks of entries. It checks every entry, because a wrong path would give wrong results without notice.
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "export/flights_file.h"
#include "export/flights_format.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

using namespace flights_format;

namespace {

/// What a reader takes of a damaged file at most.
constexpr size_t largest_block = size_t{1} << 20;

}  // namespace

FlightsReader::FlightsReader(int folder, const string& path, const Scene& scene)
    : FlightsReader(open_stored(folder, flights_name), path, scene) {}

FlightsReader::FlightsReader(Descriptor file, const string& path, const Scene& scene)
    : path_(path), file_(std::move(file)), codec_(scene.world) {
  struct stat info {};
  if (!file_ || fstat(file_.get(), &info) != 0) refuse("it cannot be opened, or is not a file");
  const auto size = uint64_t(info.st_size);
  take_header(size, scene);
  take_tail(size, scene);
  place_ = header_size;
  left_ = entries_;
}

void FlightsReader::take_header(uint64_t size, const Scene& scene) {
  if (size < header_size) refuse("it is truncated");
  load(0, header_size);
  if (string_view(buffer_.data(), magic.size()) != magic) refuse("it is not a file of flights");
  at_ = magic.size();
  if (take<uint32_t>() != version) refuse(fmt::format("another version of carom wrote it\n  {}", run_again(path_)));
  if (take<uint32_t>() != byte_order) refuse("it is damaged");
  if (size < header_size + tail_size) refuse("it is truncated");

  const auto bodies = take<uint64_t>();
  has_collisions_ = (bodies & collisions_bit) != 0;
  has_impulses_ = (bodies & impulses_bit) != 0;
  if ((bodies & ~(collisions_bit | impulses_bit)) != scene.world.body_count() ||
      take<double>() != scene.simulate.duration)
    refuse("it belongs to another scene");
  codec_ = PathCodec(scene.world, has_impulses_);
}

/// Reads the tail, and what comes before it behind the blocks.
void FlightsReader::take_tail(uint64_t size, const Scene& scene) {
  load(size - tail_size, tail_size);
  if (take<uint32_t>() != last_entry) refuse("it is truncated");
  const auto has_end = take<uint32_t>();
  if (has_end > 1) refuse("it is truncated");

  const auto keys = take<uint64_t>();
  entries_ = take<uint64_t>();
  for (uint64_t* count : counts_of(tally_)) *count = take<uint64_t>();

  for (Entity* entity : {&tally_.shared.body, &tally_.shared.one, &tally_.shared.other}) {
    const auto number = take<uint64_t>();
    if (tally_.shared.instants > 0 && number >= scene.world.entity_count()) refuse("it is damaged");
    *entity = Entity(number);
  }
  for (double* value : values_of(tally_)) *value = take<double>();

  uint64_t left = size - header_size - tail_size;
  if (has_end == 1) {
    if (left < end_size) refuse("it is truncated");
    left -= end_size;
    take_end(header_size + left, scene);
  }

  const size_t fired_size = sizeof(double) * scene.world.triggers.all.size();
  if (left < fired_size) refuse("it is truncated");
  left -= fired_size;
  take_fired(header_size + left, scene);

  if (keys > left / key_size) refuse("it is truncated");
  end_ = header_size + left - keys * key_size;
  check_keys(keys);
}

/// Reads what has ended the run, at `place` in the file, and what it has lost.
void FlightsReader::take_end(uint64_t place, const Scene& scene) {
  load(place, end_size);
  const auto time = take<double>();
  const auto reason = take<uint32_t>(), region = take<uint32_t>();

  for (Passage* passage : {&tally_.changes.removed, &tally_.changes.appeared}) {
    passage->bodies = take<uint64_t>();
    passage->energy = take<double>();
    for (int k = 0; k < 3; ++k) passage->momentum[k] = take<double>();
  }
  if (std::isnan(time)) return;
  const auto by = static_cast<EndReason>(reason);
  if (!(time >= 0 && time <= scene.simulate.duration) || reason > uint32_t(EndReason::region) ||
      (by == EndReason::region && region >= scene.world.regions.size()))
    refuse("it is damaged");
  tally_.end = RunEnd{time, by, region};
}

/// Reads when events have happened, at `place` in the file.
void FlightsReader::take_fired(uint64_t place, const Scene& scene) {
  tally_.changes.fired.resize(scene.world.triggers.all.size());
  load(place, sizeof(double) * tally_.changes.fired.size());
  for (double& time : tally_.changes.fired) {
    time = take<double>();
    if (!(time > 0 && (time == not_yet || time <= std::nextafter(scene.simulate.duration, infinity))))
      refuse("it is damaged");
  }
}

void FlightsReader::check_keys(uint64_t count) {
  FlightsKey last{0, header_size, 0};
  for (uint64_t k = 0; k < count; ++k) {
    load(end_ + k * key_size, key_size);
    FlightsKey key;
    key.time = take<double>();
    key.place = take<uint64_t>();
    key.entries = take<uint64_t>();
    if (!(key.time >= last.time) || key.place < last.place || key.place >= end_ || key.entries < last.entries ||
        key.entries > entries_)
      refuse("it is damaged");
    last = key;
  }
}

struct FlightsReader::Block {
  uint32_t kind = 0, entries = 0;
  double time = 0;  // s
};

/// Reads the next block. Of a key, only its head.
FlightsReader::Block FlightsReader::take_block() {
  if (end_ - place_ < block_head) refuse("it is damaged");
  load(place_, block_head);

  Block block;
  block.kind = take<uint32_t>();
  block.entries = take<uint32_t>();
  const size_t bytes = take<uint32_t>();
  const auto checksum = take<uint32_t>();
  block.time = take<double>();

  if (block.kind > more_of_key || bytes > largest_block || bytes > end_ - place_ - block_head || !isfinite(block.time))
    refuse("it is damaged");

  if (block.kind == of_entries) {
    load(place_, block_head + bytes);
    std::memset(buffer_.data() + checksum_place, 0, sizeof checksum);
    if (checksum_of(buffer_) != checksum || !columns_.unpack(span(buffer_).subspan(block_head)))
      refuse("it is damaged");
  }
  place_ += block_head + bytes;
  return block;
}

bool FlightsReader::next(Recorded& recorded) {
  while (in_block_ == 0) {
    if (!columns_.at_end()) refuse("it is damaged");
    if (place_ == end_ && left_ == 0) return false;

    const double last = codec_.from();
    const Block block = take_block();
    if (block.kind != of_entries) continue;
    if (block.entries > left_ || block.time < last) refuse("it is damaged");
    in_block_ = block.entries;
    codec_.begin_block(block.time);
  }

  read_entry(recorded);
  --in_block_;
  --left_;
  return true;
}

/// Reads an entry of the present block.
void FlightsReader::read_entry(Recorded& recorded) {
  const double last = codec_.from();
  recorded = {};
  if (!codec_.read(columns_, recorded)) refuse("it is damaged");
  if (recorded.kind == Recorded::Kind::collision) return check(recorded.collision);
  if (!(recorded.piece.from >= last)) refuse("it is damaged");
  check(recorded.piece);
}

void FlightsReader::check(const CollisionMark& collision) const {
  const bool known = collision.kind <= CollisionKind::taut;
  if (!known || !has_collisions_ || !isfinite(collision.time) || !isfinite(collision.impulse)) refuse("it is damaged");
}

void FlightsReader::check(const PathPiece& piece) const {
  const auto finite = [](const DoubleDouble& t) { return isfinite(t.hi + t.lo); };
  const auto positive = [](double x) { return x > 0 && isfinite(x); };

  bool right = isfinite(piece.from) && finite(piece.start) && finite(piece.until);
  for (const Vec3* v : {&piece.x, &piece.v, &piece.a, &piece.kick}) right = right && v->allFinite();
  right = right && isfinite(piece.fade) && isfinite(piece.rounding) && piece.part_of != piece.body;

  // What only some pieces have.
  if (piece.joint)
    right =
        right && positive(piece.mass) && positive(piece.radius) && piece.half.allFinite() && piece.half.minCoeff() > 0;
  if (piece.curve) {
    right = right && positive(piece.curve->length) && piece.curve->ahead.allFinite();
    for (const Vec3& term : piece.curve->displacement) right = right && term.allFinite();
  }
  if (!right) refuse("it is damaged");
}

void FlightsReader::load(uint64_t place, size_t size) {
  buffer_.resize(size);
  at_ = 0;
  for (size_t have = 0; have < size;) {
    const ssize_t n = pread(file_.get(), buffer_.data() + have, size - have, off_t(place + have));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", {-1, path_}, flights_name);
    if (n == 0) refuse("it is truncated");
    have += size_t(n);
  }
}

template <typename T>
T FlightsReader::take() {
  T value;
  std::memcpy(&value, buffer_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

void FlightsReader::refuse(const string& reason) const {
  fail("use", {-1, path_}, flights_name, reason);
}

}  // namespace carom
