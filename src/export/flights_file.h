#pragma once
// flights.bin: the paths of a run's bodies, from which the state at any instant can be computed, bit for bit.
//
// The format is little-endian, with doubles as in IEEE 754. A header of 32 bytes comes first:
//   8 bytes "caromfly", u32 version (7), u32 0x01020304, u64 number of bodies, f64 duration (s)
// The number of bodies has 2^63 more if collisions are recorded.
// Then come entries, sorted by the time from which they hold.
// Each is u32 body (in the order of the scene file), u32 flags, and for each flag set, in this order:
//   always   start: f64 hi, f64 lo (s, their sum); x, y, z (m) and vx, vy, vz (m/s) at start
//   1        ax, ay, az (m/s^2); without it, that of the body's previous entry
//   2        from: f64 (s), the first double at which it holds; without it: hi, or if lo > 0 the next double
//   4        until: f64 hi, f64 lo (s); hx, hy, hz (m/s^2)
//   8        the body has merged into another: u64 which; the other one's entries are its own from here on
//   16       others have merged into it; its new f64 mass (kg), f64 radius (m), 3 f64 half extents (m)
//   32       f64 length L (s), then c1 to c8 (m) and p (m/s): x, y, z of each
//   64       the body has left the world
//   128      f64 rate (1/s): linear drag
//   256      the velocities are those of Verlet's method
//   512      a motion in closed form from start on, with the forces of then
//   1024     f64 rounding (s): a straight line before start - rounding, and x itself from there on
// The number 0xfffffffe of a body means a collision: u32 kind, u32 a, u32 b, f64 time (s).
// At a time T let s = (T - hi) - lo. The position is x + s (v + (s/2) a), and the velocity is v + s a.
// With flag 32 let u = s / L. The position is x + c1 u + ... + c8 u^8, the velocity v - p + (2 c2 u + ... + 8 c8 u^7) /
// L, both by Horner's scheme. Flag 4 subtracts (until - T) h from the velocity.
//
// The tail is u32 0xffffffff and u32 0, then counts as u64, then values as f64.
//   u64: entries, body-body collisions, body-fixed collisions, merges, strings that went taut, clusters that became
//        lasting contacts, bodies at rest at the end, impacts that contact took up; instants with impacts that share a
//        body, of these with ties, and with bodies that had no room; such a body, and two things that it met at once
//   f64: first and last collision (s, NaN: none), energy lost (J), work (J), deepest overlap (m), greatest speed (m/s),
//        lasting contact in crowds (s, summed over bodies), and of the impacts that contact took up
//        the fastest (m/s) and their energy (J); the first instant with impacts that share a body (s, NaN: none), and
//        the energy absorbed by bodies that had no room (J)
// A run that has ended before its duration, or has lost bodies to regions, has 1 instead of the 0 of the tail. Then 64
// bytes come before the tail:
//   f64 end (s, NaN: the duration), u32 reason (0 rest, 1 collisions, 2 region), u32 which region, u64 removed bodies,
//   f64 their energy (J), and x, y, z of their momentum (kg m/s), f64 0
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/writer.h"
#include "physics/recorded.h"

namespace carom {

struct Scene;

inline constexpr const char* flights_name = "flights.bin";

/// Bytes. A run with more keeps no flights.
inline constexpr std::uint64_t largest_flights = 1'000'000'000;

/// An estimate of the bytes of pieces that events begin, and of those of a crowd's steps.
double flight_bytes(double of_events, double of_crowd);

class FlightsFile final : public Writer {
 public:
  /// Throws ExportError, as all functions of this class do.
  FlightsFile(const FilePlace& place, const Scene& scene, std::uint64_t most = largest_flights);
  /// The same in a file without a name, which ends with this object.
  struct Nameless {};
  static constexpr Nameless nameless{};
  FlightsFile(const FilePlace& place, const Scene& scene, Nameless);
  /// Whether it is too large is judged at the end only: it is read before that.
  void keep_whole() { keeps_whole_ = true; }
  /// The whole file, to be read. Call it after end().
  Descriptor reopened();
  void record(std::span<const Collision> collisions) override;
  void record_paths(std::span<const PathPiece> pieces) override;
  void end(const Tally& tally) override;
  std::vector<LeftOut> left_out() const override;
  std::vector<OutputFile*> files() override;

  /// Whether collisions are recorded: those that pictures of the scene show.
  bool has_collisions() const { return has_collisions_; }

 private:
  void begin(const Scene& scene);
  void put(const CollisionMark& collision);
  void put(const PathPiece& piece);
  void written(const char* end, std::size_t size);

  std::optional<OutputFile> file_;
  const bool has_collisions_;
  bool keeps_whole_ = false;
  std::uint64_t most_, bytes_ = 0, entries_ = 0;
  std::vector<Collision> collisions_;  // not yet written
  std::vector<Vec3> acceleration_;     // m/s^2, by body: that of its previous entry
};

/// Reads such a file once, from start to end.
class FlightsReader {
 public:
  /// `scene`: the scene of the run. Throws ExportError if the file is another scene's, incomplete or unreadable.
  FlightsReader(int folder, const std::string& path, const Scene& scene);
  /// The same of an open file, or of no file.
  FlightsReader(Descriptor file, const std::string& path, const Scene& scene);
  /// Reads the next piece or collision. False: the end. Throws ExportError.
  bool next(Recorded& recorded);
  bool has_collisions() const { return has_collisions_; }
  const Tally& tally() const { return tally_; }  // at the end of the run

 private:
  [[noreturn]] void refuse(const std::string& reason) const;
  void fill(std::size_t size);
  void take_end(std::uint64_t offset, const Scene& scene);
  void take_piece(PathPiece& piece);
  CollisionMark take_collision();
  template <typename T>
  T take();
  Vec3 take_vector();
  std::shared_ptr<const PolynomialPath> take_curve();

  std::string path_;  // of the folder, for messages
  Descriptor file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;  // the unread range of the buffer
  /// Bytes of the file not yet in the buffer, without the tail.
  std::uint64_t left_ = 0;
  std::uint64_t entries_ = 0;  // entries not yet read
  Entity entities_ = 0;        // bodies and all that they meet
  bool has_collisions_ = false;
  /// In s, the time from which the previous entry holds.
  double last_ = 0;
  std::vector<Vec3> acceleration_;  // m/s^2, by body: that of its previous entry
  Tally tally_;
};

}  // namespace carom
