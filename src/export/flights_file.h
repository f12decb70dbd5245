#pragma once
// flights.bin: the paths of a run's bodies, from which the state at any instant can be computed, bit for bit.
//
// The format is little-endian, with doubles as in IEEE 754. A header of 32 bytes comes first:
//   8 bytes "caromfly", u32 version (8), u32 0x01020304, u64 number of bodies, f64 duration (s)
// The number of bodies has 2^63 more if collisions are recorded, and another 2^62 if with their impulses.
//
// Then come blocks of entries, sorted by the time from which they hold. Each has a header of 24 bytes:
//   u32 kind (0 entries; 1 key, 2 more of the same key), u32 entries, u32 bytes that follow,
//   u32 CRC-32 of this header with 0 in this place and of these bytes, f64 time (s) at which it begins
// A key repeats the present piece of every body, so that a reader may begin there. Others pass over it.
// flight_columns.cpp describes the columns of a block, and path_codec.cpp what they have of an entry.
//
// A piece of a path has: body, start (two f64, s, their sum), `from` (s, the first double at which it holds), x (m), v
// (m/s) and a (m/s^2) at start; and for some
//   kicked   until: two f64 (s); kick (m/s^2)
//   curve    f64 length L (s), then c1 to c8 (m) and p (m/s)
//   part     the body has merged into another: which; the other one's entries are its own from here on
//   joint    others have merged into it; its new mass (kg), radius (m) and half extents (m)
//   removed  the body has left the world, or has yet to come; its next piece without this mark begins as it appears
//   fading   f64 rate (1/s): linear drag
//   verlet   the velocities are those of Verlet's method
//   closed   a motion in closed form from start on, with the forces of then
//   frame    f64 rounding (s): a straight line before start - rounding, and x itself from there on
// At a time T let s = (T - hi) - lo. The position is x + s (v + (s/2) a), and the velocity is v + s a. Of a curve let
// u = s / L. The position is x + c1 u + ... + c8 u^8, the velocity v - p + (2 c2 u + ... + 8 c8 u^7) / L, both by
// Horner's scheme. A kicked piece has (until - T) kick less velocity.
// A collision has: kind, a, b, f64 time (s), and where impulses are recorded f64 impulse (N s).
//
// The index has for each key: f64 time (s), u64 place in the file, u64 entries before it.
// Then come, for each event that sets times of the scene, f64 the first double after it (s), or the greatest double if
// it has not happened. The tail is u32 0xffffffff and u32 0, then counts as u64, then values as f64.
//   u64: keys, entries, body-body collisions, body-fixed collisions, merges, strings that went taut, clusters that
//        became lasting contacts, bodies at rest at the end, impacts that contact took up; instants with impacts that
//        share a body, of these with ties, and with bodies that had no room; such a body, and two things that it met at
//        once
//   f64: first and last collision (s, NaN: none), energy lost (J), work (J), deepest overlap (m), greatest speed (m/s),
//        lasting contact in crowds (s, summed over bodies), and of the impacts that contact took up
//        the fastest (m/s) and their energy (J); the first instant with impacts that share a body (s, NaN: none), and
//        the energy absorbed by bodies that had no room (J)
// A run that has ended before its duration, or has lost bodies to regions, or into which bodies have come, has 1
// instead of the 0 of the tail. Then 96 bytes come before the tail:
//   f64 end (s, NaN: the duration), u32 reason (0 rest, 1 collisions, 2 region), u32 which region
//   of removed bodies, then of those that have come: u64 number, f64 energy (J), and x, y, z of momentum (kg m/s)
#include <deque>

#include "export/path_codec.h"
#include "export/writer.h"
#include "physics/recorded.h"
#include "std.h"

namespace carom {

struct Scene;
struct World;

inline constexpr const char* flights_name = "flights.bin";

/// Bytes. A run with more keeps no flights.
inline constexpr uint64_t largest_flights = 1'000'000'000;

/// An estimate of the bytes of pieces that events begin, and of those of a crowd's steps.
double flight_bytes(double of_events, double of_crowd);

/// A place at which a reader may begin.
struct FlightsKey {
  double time = 0;       // s
  uint64_t place = 0;    // in the file
  uint64_t entries = 0;  // before it
};

class FlightsFile final : public Writer {
 public:
  /// `scene` must outlive this object. Throws ExportError, as all functions of this class do.
  FlightsFile(const FilePlace& place, const Scene& scene, uint64_t most = largest_flights);
  /// The same in a file without a name, which ends with this object.
  struct Nameless {};
  static constexpr Nameless nameless{};
  FlightsFile(const FilePlace& place, const Scene& scene, Nameless);
  /// Whether it is too large is judged at the end only: it is read before that.
  void keep_whole() { keeps_whole_ = true; }
  /// The whole file, to be read. Call it after end().
  Descriptor reopened();
  void record(span<const Collision> collisions) override;
  void record_paths(span<const PathPiece> pieces) override;
  void end(const Tally& tally) override;
  vector<LeftOut> left_out() const override;
  vector<OutputFile*> files() override;
  void keep(StateWriter& archive) override { keep_all(archive); }
  void keep(StateReader& archive) override { keep_all(archive); }

  /// Whether it has not been given up.
  bool is_there() const { return file_.has_value(); }
  /// Whether collisions are recorded: those that pictures of the scene show.
  bool has_collisions() const { return has_collisions_; }

 private:
  FlightsFile(const Scene& scene, uint64_t most);
  void begin(const Scene& scene);
  void end_group(const PathPiece* next);
  void put_group(const PathPiece* next);
  void put(const PathPiece& piece, const PathPiece* next);
  void put(const CollisionMark& collision);
  void count();
  void end_block(uint32_t kind, ColumnWriter& columns, uint32_t entries, double time);
  void put_key();
  void keep_all(auto& archive) {
    bool there = is_there();
    archive(there);
    if (!there) file_.reset();
    if (file_) keep_part(archive, *file_);
    archive(bytes_, entries_, group_, collisions_, codec_, columns_, in_block_, block_time_, keys_, next_key_);
  }

  optional<OutputFile> file_;
  const bool has_collisions_;
  const bool has_impulses_;
  bool keeps_whole_ = false;
  const World& world_;
  uint64_t most_;   // bytes
  uint64_t bytes_;  // so far, with those of the end
  uint64_t entries_ = 0;
  // Not yet written: the last pieces, which hold from one instant, and collisions.
  vector<PathPiece> group_;
  std::deque<Collision> collisions_;
  PathCodec codec_;
  // The present block: its columns, its entries, and when it begins (s).
  ColumnWriter columns_;
  uint32_t in_block_ = 0;
  double block_time_ = 0;
  vector<char> packed_;
  vector<FlightsKey> keys_;
  uint64_t next_key_;  // the number of bytes from which on a key is due
};

/// Reads such a file, in blocks.
class FlightsReader {
 public:
  /// `scene`: the scene of the run. Throws ExportError if the file is another scene's, incomplete or unreadable.
  FlightsReader(int folder, const string& path, const Scene& scene);
  /// The same of an open file, or of no file.
  FlightsReader(Descriptor file, const string& path, const Scene& scene);
  /// Reads the next piece or collision. False: the end. Throws ExportError.
  bool next(Recorded& recorded);
  bool has_collisions() const { return has_collisions_; }
  bool has_impulses() const { return has_impulses_; }
  const Tally& tally() const { return tally_; }  // at the end of the run

 private:
  [[noreturn]] void refuse(const string& reason) const;
  void load(uint64_t place, size_t size);
  void take_header(uint64_t size, const Scene& scene);
  void take_tail(uint64_t size, const Scene& scene);
  void take_end(uint64_t place, const Scene& scene);
  void take_fired(uint64_t place, const Scene& scene);
  void check_keys(uint64_t count);
  struct Block;
  Block take_block();
  void read_entry(Recorded& recorded);
  void check(const PathPiece& piece) const;
  void check(const CollisionMark& collision) const;
  template <typename T>
  T take();

  string path_;  // of the folder, for messages
  Descriptor file_;
  vector<char> buffer_;
  size_t at_ = 0;  // the start of what is not yet read of the buffer
  // Places in the file: of the next block, and behind the last one.
  uint64_t place_ = 0;
  uint64_t end_ = 0;
  uint64_t entries_ = 0;
  uint64_t left_ = 0;      // entries not yet read
  uint32_t in_block_ = 0;  // and those of the present block
  bool has_collisions_ = false;
  bool has_impulses_ = false;
  ColumnReader columns_;
  PathCodec codec_;
  Tally tally_;
};

}  // namespace carom
