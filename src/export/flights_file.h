#pragma once
// flights.bin: the paths of a run's bodies, from which the state at any instant is known again, bit for bit.
//
// Little-endian, doubles as IEEE 754 has them. A header of 32 bytes:
//   8 bytes "caromfly", u32 version (4), u32 0x01020304, u64 number of bodies, f64 duration (s)
// then entries, by the time from which on they hold. Each is u32 body (by the order of the scene file), u32 what it
// has, and of these what it has, in this order:
//   always   start: f64 hi, f64 lo (s, their sum); x, y, z (m) and vx, vy, vz (m/s) at start
//   1        ax, ay, az (m/s^2); without it, what the body's last entry had
//   2        from: f64 (s), the first double at which it holds; without it: hi, or if lo > 0 the next double
//   4        until: f64 hi, f64 lo (s); hx, hy, hz (m/s^2)
//   8        the body has become part of another: u64 which; that one's entries are its own from now on
//   16       others have become part of it; it is now of: f64 mass (kg), f64 radius (m), 3 f64 half extents (m)
//   32       bx, by, bz (m/s^2), cx, cy, cz (m/s^3)
// At a time T, with s = (T - hi) - lo: position x + s (v + (s/2) a), velocity v + s a, less (until - T) h if it has 4,
// and s (b + s c) more if it has 32.
// Last: u32 0xffffffff, u32 0; u64 entries, body-body and body-fixed collisions, merges, clusters taken into contact,
// bodies at rest at the end; f64 first and last collision (s, NaN: none), energy lost and work (J), deepest overlap
// (m), greatest speed (m/s), lasting contact told by time stepping (s, summed over bodies), and of the impacts that
// contact took up, which are the last of the u64, the fastest (m/s) and their energy (J).
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "export/writer.h"

namespace carom {

struct Scene;

inline constexpr const char* flights_name = "flights.bin";

/// Bytes; of a run with more no flights are kept.
inline constexpr std::uint64_t largest_flights = 1'000'000'000;

class FlightsFile final : public Writer {
 public:
  /// Throws ExportError, as all of this class does.
  FlightsFile(const FilePlace& place, const Scene& scene, std::uint64_t most = largest_flights);
  void record_paths(std::span<const PathPiece> pieces) override;
  void end(const Tally& tally) override;
  std::vector<LeftOut> left_out() const override;
  std::vector<OutputFile*> files() override;

 private:
  std::optional<OutputFile> file_;
  std::uint64_t most_, bytes_ = 0, entries_ = 0;
  std::vector<Vec3> acceleration_;  // m/s^2, by body: of its last entry
};

/// Reads such a file once from its start to its end.
class FlightsReader {
 public:
  /// `scene`: that of the run. Throws ExportError if it is none of this scene's, not whole, or cannot be read.
  FlightsReader(int folder, const std::string& path, const Scene& scene);
  /// The next piece; false: there is none. Throws ExportError.
  bool next(PathPiece& piece);
  const Tally& tally() const { return tally_; }  // of the run's end

 private:
  [[noreturn]] void refuse(const std::string& reason) const;
  void fill(std::size_t size);
  template <typename T>
  T take();
  Vec3 take_vector();

  std::string path_;  // of the folder, as the user knows it
  Descriptor file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, end_ = 0;    // of the buffer: what is read and not yet taken
  std::uint64_t left_ = 0;          // bytes of the file that are not yet in the buffer, without its last ones
  std::uint64_t entries_ = 0;       // still to come
  double last_ = 0;                 // s, from when on the last one held
  std::vector<Vec3> acceleration_;  // m/s^2, by body: of its last entry
  Tally tally_;
};

}  // namespace carom
