// Writes entries while they happen and reads them back in order, in pieces of constant size.
// An entry stores only what differs from the previous one, which keeps the common entry at 72 bytes.
// The reader checks every entry, because a wrong path would give wrong results without notice.
#include "export/flights_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

#include "files/run_folder.h"
#include "files/stored_file.h"
#include "physics/world.h"
#include "scene/scene.h"

namespace carom {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view magic = "caromfly";
constexpr std::uint32_t version = 7, byte_order = 0x01020304, last_entry = 0xffffffff, collision_entry = 0xfffffffe;
constexpr std::uint64_t collisions_bit = std::uint64_t{1} << 63;
enum Has : std::uint32_t {
  has_acceleration = 1,
  has_from = 2,
  has_kick = 4,
  has_whole = 8,
  has_joint = 16,
  has_curve = 32,
  has_left = 64,
  has_fade = 128,
  has_verlet = 256,
  has_closed = 512,
  has_frame = 1024,
  has_all = 2047
};

constexpr std::size_t header_size = 32, tail_size = 8 + 25 * 8, end_size = 8 * 8;
constexpr std::size_t largest_entry = 8 + (8 + 3 + 1 + 5 + 1 + 5 + 1 + 3 * PolynomialPath::terms + 3 + 1 + 1) * 8;

/// The counts of the tail, in its order.
template <typename Sums>
auto counts_of(Sums& tally) {
  return std::array{&tally.body_body,          &tally.body_fixed,      &tally.merges,
                    &tally.tautened,           &tally.collapses,       &tally.resting,
                    &tally.taken_up.impacts,   &tally.shared.instants, &tally.shared.ties,
                    &tally.shared.without_room};
}

/// The values of the tail, in its order.
template <typename Sums>
auto values_of(Sums& tally) {
  return std::array{&tally.first_collision, &tally.last_collision, &tally.energy_lost,     &tally.work,
                    &tally.max_overlap,     &tally.fastest.speed,  &tally.stepped_contact, &tally.taken_up.fastest,
                    &tally.taken_up.energy, &tally.shared.first,   &tally.shared.absorbed};
}

/// The default of `from` where an entry has none.
double first_double(const DoubleDouble& start) {
  return start.lo > 0 ? std::nextafter(start.hi, std::numeric_limits<double>::infinity()) : start.hi;
}

/// Bitwise equality. Unlike ==, it distinguishes -0 from 0.
bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

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
  void put(const DoubleDouble& time) {
    put(time.hi);
    put(time.lo);
  }
  const char* end() const { return to_; }

 private:
  char* to_;
};

}  // namespace

double flight_bytes(double of_events, double of_crowd) {
  // Measured in a gas and in piles.
  constexpr double event_bytes = 72;
  constexpr double crowd_bytes = 136;
  return event_bytes * of_events + crowd_bytes * of_crowd;
}

FlightsFile::FlightsFile(const FilePlace& place, const Scene& scene, std::uint64_t most)
    : has_collisions_(drawings_show_collisions(scene)),
      most_(most),
      bytes_(header_size + tail_size),
      acceleration_(scene.world.body_count(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) {
  file_.emplace(place, flights_name);
  begin(scene);
}

FlightsFile::FlightsFile(const FilePlace& place, const Scene& scene, Nameless)
    : has_collisions_(drawings_show_collisions(scene)),
      keeps_whole_(true),
      most_(0),
      acceleration_(scene.world.body_count(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN())) {
  file_.emplace(place, nameless_file(place));
  begin(scene);
}

void FlightsFile::begin(const Scene& scene) {
  file_->write(magic);
  InPlace writer(file_->room(header_size));
  writer.put(version);
  writer.put(byte_order);
  writer.put(scene.world.body_count() | (has_collisions_ ? collisions_bit : 0));
  writer.put(scene.simulate.duration);
  file_->written(writer.end());
}

void FlightsFile::record(std::span<const Collision> collisions) {
  if (has_collisions_) collisions_.insert(collisions_.end(), collisions.begin(), collisions.end());
}

void FlightsFile::record_paths(std::span<const PathPiece> pieces) {
  in_order(
      collisions_, pieces, [this](const CollisionMark& mark) { put(mark); },
      [this](const PathPiece& piece) { put(piece); });
  collisions_.clear();
}

void FlightsFile::put(const CollisionMark& collision) {
  if (!file_) return;
  char* const begin = file_->room(largest_entry);
  InPlace writer(begin);
  writer.put(collision_entry);
  writer.put(static_cast<std::uint32_t>(collision.kind));
  writer.put(collision.a);
  writer.put(collision.b);
  writer.put(collision.time);
  written(writer.end(), static_cast<std::size_t>(writer.end() - begin));
}

void FlightsFile::put(const PathPiece& piece) {
  if (!file_) return;
  std::uint32_t has = 0;
  if (!same_bits(piece.a, acceleration_[piece.body])) has |= has_acceleration;
  if (piece.from != first_double(piece.start)) has |= has_from;
  if (piece.kicked) has |= has_kick;
  if (piece.part_of != no_entity) has |= has_whole;
  if (piece.joint) has |= has_joint;
  if (piece.curve) has |= has_curve;
  if (piece.removed) has |= has_left;
  if (piece.fade != 0) has |= has_fade;
  if (piece.law == PathLaw::verlet) has |= has_verlet;
  if (piece.law == PathLaw::closed) has |= has_closed;
  if (piece.law == PathLaw::frame) has |= has_frame;

  char* const begin = file_->room(largest_entry);
  InPlace writer(begin);
  writer.put(piece.body);
  writer.put(has);
  writer.put(piece.start);
  writer.put(piece.x);
  writer.put(piece.v);
  if (has & has_acceleration) writer.put(acceleration_[piece.body] = piece.a);
  if (has & has_from) writer.put(piece.from);
  if (has & has_kick) {
    writer.put(piece.until);
    writer.put(piece.kick);
  }
  if (has & has_whole) writer.put(std::uint64_t{piece.part_of});
  if (has & has_joint) {
    writer.put(piece.mass);
    writer.put(piece.radius);
    writer.put(piece.half);
  }
  if (has & has_curve) {
    writer.put(piece.curve->length);
    for (const Vec3& term : piece.curve->displacement) writer.put(term);
    writer.put(piece.curve->ahead);
  }
  if (has & has_fade) writer.put(piece.fade);
  if (has & has_frame) writer.put(piece.rounding);
  written(writer.end(), static_cast<std::size_t>(writer.end() - begin));
}

/// Counts an entry of so many bytes.
void FlightsFile::written(const char* end, std::size_t size) {
  file_->written(end);
  ++entries_;
  bytes_ += size;
  if (bytes_ > most_ && !keeps_whole_) file_.reset();
}

void FlightsFile::end(const Tally& tally) {
  record_paths({});
  if (!file_) return;
  const bool has_end = tally.end || tally.removed.bodies > 0;
  InPlace writer(file_->room(end_size + tail_size));
  if (has_end) {
    const RunEnd end = tally.end.value_or(RunEnd{std::numeric_limits<double>::quiet_NaN()});
    writer.put(end.time);
    writer.put(static_cast<std::uint32_t>(end.reason));
    writer.put(end.region);
    writer.put(tally.removed.bodies);
    writer.put(tally.removed.energy);
    writer.put(tally.removed.momentum);
    writer.put(0.0);
  }

  writer.put(last_entry);
  writer.put(std::uint32_t{has_end});
  writer.put(entries_);
  for (const std::uint64_t* count : counts_of(tally)) writer.put(*count);
  for (const Entity entity : {tally.shared.body, tally.shared.one, tally.shared.other})
    writer.put(std::uint64_t{entity});
  for (const double* value : values_of(tally)) writer.put(*value);
  file_->written(writer.end());
}

Descriptor FlightsFile::reopened() {
  return file_->reopened();
}

std::vector<LeftOut> FlightsFile::left_out() const {
  if (file_ && bytes_ <= most_) return {};
  return {{flights_name, fmt::format("larger than {:.3g} GB", 1e-9 * static_cast<double>(most_))}};
}

std::vector<OutputFile*> FlightsFile::files() {
  return file_ && bytes_ <= most_ ? std::vector{&*file_} : std::vector<OutputFile*>();
}

FlightsReader::FlightsReader(int folder, const std::string& path, const Scene& scene)
    : FlightsReader(open_stored(folder, flights_name), path, scene) {}

FlightsReader::FlightsReader(Descriptor file, const std::string& path, const Scene& scene)
    : path_(path),
      file_(std::move(file)),
      buffer_(std::size_t{256} * 1024),
      acceleration_(scene.world.body_count(), Vec3::Zero()) {
  struct stat info {};
  if (!file_ || fstat(file_.get(), &info) != 0) refuse("it cannot be opened, or is not a file");
  const auto size = static_cast<std::uint64_t>(info.st_size);
  // The header tells whether the rest is what is expected.
  left_ = std::min<std::uint64_t>(size, header_size);
  fill(header_size);
  if (end_ < header_size) refuse("it is truncated");
  if (std::string_view(buffer_.data(), magic.size()) != magic) refuse("it is not a file of flights");
  at_ = magic.size();
  if (take<std::uint32_t>() != version) refuse("another version of carom wrote it");
  if (take<std::uint32_t>() != byte_order) refuse("it is damaged");
  if (size < header_size + tail_size) refuse("it is truncated");
  const auto bodies = take<std::uint64_t>();
  has_collisions_ = (bodies & collisions_bit) != 0;
  entities_ = scene.world.entity_count();
  if ((bodies & ~collisions_bit) != scene.world.body_count() || take<double>() != scene.simulate.duration)
    refuse("it belongs to another scene");

  char tail[tail_size];
  if (pread(file_.get(), tail, tail_size, static_cast<off_t>(size - tail_size)) != static_cast<ssize_t>(tail_size))
    refuse("it cannot be read");
  std::memcpy(buffer_.data(), tail, tail_size);
  at_ = 0;
  end_ = tail_size;
  if (take<std::uint32_t>() != last_entry) refuse("it is truncated");
  const auto has_end = take<std::uint32_t>();
  if (has_end > 1 || (has_end == 1 && size < header_size + end_size + tail_size)) refuse("it is truncated");
  entries_ = take<std::uint64_t>();
  for (std::uint64_t* count : counts_of(tally_)) *count = take<std::uint64_t>();
  for (Entity* entity : {&tally_.shared.body, &tally_.shared.one, &tally_.shared.other}) {
    const auto number = take<std::uint64_t>();
    if (tally_.shared.instants > 0 && number >= scene.world.entity_count()) refuse("it is damaged");
    *entity = static_cast<Entity>(number);
  }
  for (double* value : values_of(tally_)) *value = take<double>();

  at_ = end_ = 0;
  left_ = size - tail_size - header_size;
  if (has_end == 1) take_end(header_size + (left_ -= end_size), scene);
}

/// Reads what has ended the run, at `offset` in the file, and what it has lost.
void FlightsReader::take_end(std::uint64_t offset, const Scene& scene) {
  if (pread(file_.get(), buffer_.data(), end_size, static_cast<off_t>(offset)) != static_cast<ssize_t>(end_size))
    refuse("it cannot be read");
  end_ = end_size;
  const auto time = take<double>();
  const auto reason = take<std::uint32_t>(), region = take<std::uint32_t>();
  tally_.removed.bodies = take<std::uint64_t>();
  tally_.removed.energy = take<double>();
  tally_.removed.momentum = take_vector();
  at_ = end_ = 0;
  if (std::isnan(time)) return;
  const auto by = static_cast<EndReason>(reason);
  if (!(time >= 0 && time <= scene.simulate.duration) || reason > static_cast<std::uint32_t>(EndReason::region) ||
      (by == EndReason::region && region >= scene.world.regions.size()))
    refuse("it is damaged");
  tally_.end = RunEnd{time, by, region};
}

bool FlightsReader::next(Recorded& recorded) {
  if (entries_ == 0) {
    if (left_ > 0 || at_ != end_) refuse("it is damaged");
    return false;
  }
  --entries_;
  fill(largest_entry);
  const auto body = take<std::uint32_t>();
  recorded = {};
  if (body == collision_entry) {
    recorded.kind = Recorded::Kind::collision;
    recorded.collision = take_collision();
    return true;
  }
  recorded.piece.body = body;
  take_piece(recorded.piece);
  return true;
}

CollisionMark FlightsReader::take_collision() {
  CollisionMark collision;
  const auto kind = take<std::uint32_t>();
  collision.kind = static_cast<CollisionKind>(kind);
  collision.a = take<std::uint32_t>();
  collision.b = take<std::uint32_t>();
  collision.time = take<double>();
  const bool known = kind <= static_cast<std::uint32_t>(CollisionKind::string) && collision.a < acceleration_.size() &&
                     collision.b < entities_;
  if (!known || !has_collisions_ || !std::isfinite(collision.time)) refuse("it is damaged");
  return collision;
}

void FlightsReader::take_piece(PathPiece& piece) {
  const auto has = take<std::uint32_t>();
  if (piece.body >= acceleration_.size() || has > has_all) refuse("it is damaged");
  const auto take_time = [&] {
    const double hi = take<double>();
    return DoubleDouble{hi, take<double>()};
  };
  piece.start = take_time();
  piece.x = take_vector();
  piece.v = take_vector();
  if (has & has_acceleration) acceleration_[piece.body] = take_vector();
  piece.a = acceleration_[piece.body];
  piece.from = has & has_from ? take<double>() : first_double(piece.start);
  if (has & has_kick) {
    piece.kicked = true;
    piece.until = take_time();
    piece.kick = take_vector();
  }
  if (has & has_whole) {
    const auto whole = take<std::uint64_t>();
    if (whole >= acceleration_.size() || whole == piece.body) refuse("it is damaged");
    piece.part_of = static_cast<Entity>(whole);
  }
  if (has & has_joint) {
    piece.joint = true;
    piece.mass = take<double>();
    piece.radius = take<double>();
    piece.half = take_vector();
  }
  if (has & has_curve) piece.curve = take_curve();
  if (has & has_fade) piece.fade = take<double>();
  if (has & has_verlet) piece.law = PathLaw::verlet;
  if (has & has_closed) piece.law = PathLaw::closed;
  if (has & has_frame) {
    piece.law = PathLaw::frame;
    piece.rounding = take<double>();
  }
  piece.removed = (has & has_left) != 0;
  const auto finite = [](const DoubleDouble& t) { return std::isfinite(t.hi) && std::isfinite(t.lo); };
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (!(piece.from >= last_) || !std::isfinite(piece.from) || !finite(piece.start) || !finite(piece.until))
    refuse("it is damaged");
  for (const Vec3* v : {&piece.x, &piece.v, &piece.a, &piece.kick})
    if (!v->allFinite()) refuse("it is damaged");
  if (piece.joint &&
      !(positive(piece.mass) && positive(piece.radius) && piece.half.allFinite() && piece.half.minCoeff() > 0))
    refuse("it is damaged");
  last_ = piece.from;
}

/// Ensures that the buffer has `size` bytes, or all that are left.
void FlightsReader::fill(std::size_t size) {
  if (end_ - at_ >= size) return;
  std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
  end_ -= at_;
  at_ = 0;
  while (end_ < size && left_ > 0) {
    const ssize_t n = read(file_.get(), buffer_.data() + end_, std::min<std::uint64_t>(buffer_.size() - end_, left_));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", {-1, path_}, flights_name);
    if (n == 0) refuse("it is truncated");
    end_ += static_cast<std::size_t>(n);
    left_ -= static_cast<std::uint64_t>(n);
  }
}

template <typename T>
T FlightsReader::take() {
  if (end_ - at_ < sizeof(T)) refuse("it is truncated");
  T value;
  std::memcpy(&value, buffer_.data() + at_, sizeof value);
  at_ += sizeof value;
  return value;
}

Vec3 FlightsReader::take_vector() {
  Vec3 v;
  for (int k = 0; k < 3; ++k) v[k] = take<double>();
  return v;
}

std::shared_ptr<const PolynomialPath> FlightsReader::take_curve() {
  PolynomialPath curve;
  curve.length = take<double>();
  if (!(curve.length > 0 && std::isfinite(curve.length))) refuse("it is damaged");
  for (Vec3& term : curve.displacement)
    if (term = take_vector(); !term.allFinite()) refuse("it is damaged");
  curve.ahead = take_vector();
  if (!curve.ahead.allFinite()) refuse("it is damaged");
  return std::make_shared<PolynomialPath>(curve);
}

void FlightsReader::refuse(const std::string& reason) const {
  fail("use", {-1, path_}, flights_name, reason);
}

}  // namespace carom
