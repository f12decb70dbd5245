#pragma once
// The sound of a film: a click at each collision.

#include "physics/collision.h"
#include "physics/path_piece.h"
#include "scene/film_clock.h"
#include "std.h"

namespace carom {

struct World;

/// Samples from the film's start, of one channel. A click begins at the first sample that is not before its collision.
class SoundTrack {
 public:
  static constexpr double rate = 48000;  // samples a second

  /// Of a film of this length (s), which is silent for `lead` (s) before its clock begins. `world` gives the sizes of
  /// bodies. `put` takes the samples, in order, as soon as they are known.
  SoundTrack(const World& world, const FilmClock& clock, double lead, double length,
             function<void(span<const float>)> put);

  /// Take what has been recorded since the last call, in order. Sizes change where bodies merge.
  void record(span<const Collision> collisions);
  void record_paths(span<const PathPiece> pieces);
  /// Makes the rest, of a film that has this length (s), which is at most the one above.
  void finish(double length);

  /// What the samples have to be multiplied by, so that the greatest one is `loudest`. 1: all are 0.
  double gain() const { return peak_ > 0 ? loudest / peak_ : 1; }
  /// 3 dB below what a file can hold, because encoders overshoot.
  static constexpr double loudest = 0.7;

 private:
  /// All bodies of about one size: y[n] = 2 r cos w y[n-1] - r^2 y[n-2] + x[n].
  struct Ring {
    double first = 0, second = 0;        // the factors of y[n-1] and y[n-2]
    double onset = 0;                    // of a click of amplitude 1: x at its first sample, sin w
    int64_t lasts = 0;                   // samples
    double x = 0, before = 0, last = 0;  // of the next sample; y[n-1], y[n-2]
    int64_t until = 0;                   // it is silent from this sample on
  };
  size_t tone_of(Entity body) const;
  void strike(size_t tone, double amplitude);
  void make_until(int64_t sample);
  void make(span<float> samples);

  vector<double> radius_;  // m, by body
  double middle_ = 1;      // m
  FilmClock clock_;
  double lead_;  // s
  int64_t end_;  // samples
  function<void(span<const float>)> put_;
  vector<Ring> rings_;      // by tone
  vector<size_t> ringing_;  // tones
  int64_t made_ = 0;        // samples
  double peak_ = 0;
};

}  // namespace carom
