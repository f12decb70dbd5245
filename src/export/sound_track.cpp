// Each body rings in its lowest mode. An elastic sphere of diameter d has that at 0.84 c / d, with c the speed of shear
// waves in it and Poisson's ratio 1/4 (Lamb, Proc. London Math. Soc. 13, 1882; Love, Theory of Elasticity, 196). All
// bodies are of one material, whose c is such that the middle of the scene's sizes sounds at 1 kHz.
//
// A click has the amplitude J^(1/2), with J the impulse: two decibels of impulse are one of sound, so that what differs
// 10,000-fold is heard side by side. A power needs no reference: the whole is scaled at the end by its greatest sample
// (gain()), and nothing is clipped. The mode fades by a part of `loss` of its energy in a radian.
//
// Bodies of a size share a filter of two poles, which adds up their clicks. A sample therefore costs as much for a
// million collisions as for one of each size, and sizes are taken to a quarter of a tone. A mode that would be played
// from silence up has its first sample at the collision itself: r^n sin((n + 1) w).
#include "export/sound_track.h"

#include <numbers>

#include "physics/world.h"
#include "std.h"

namespace carom {
namespace {

constexpr double middle_tone = 1000;    // Hz
constexpr double tones_an_octave = 24;  // quarter tones
constexpr int most_tones = 80;          // above the middle, and below: 99 to 10079 Hz
constexpr double loss = 0.05;
constexpr double faded = 1e-6;     // of the amplitude: silence
constexpr double of_string = 0.5;  // the amplitude of a string that goes taut, in that of an impact
constexpr int64_t chunk = 4096;    // samples
// Of a sample: less is rounding and not a delay.
constexpr double rounding = 1e-6;

int64_t samples_until(double time) {
  return int64_t(ceil(time * SoundTrack::rate - rounding));
}

}  // namespace

SoundTrack::SoundTrack(const World& world, const FilmClock& clock, double lead, double length,
                       function<void(span<const float>)> put)
    : radius_(world.radius),
      clock_(clock),
      lead_(lead),
      end_(samples_until(length)),
      put_(std::move(put)),
      rings_(2 * most_tones + 1) {
  if (!radius_.empty()) {
    const auto [least, most] = ranges::minmax_element(radius_);
    middle_ = sqrt(*least) * sqrt(*most);
  }

  for (size_t tone = 0; tone < rings_.size(); ++tone) {
    const double frequency = middle_tone * std::exp2((double(tone) - most_tones) / tones_an_octave);
    const double w = 2 * std::numbers::pi * frequency / rate, fade = 0.5 * loss * w;
    const double r = std::exp(-fade);
    rings_[tone] = {.first = 2 * r * std::cos(w),
                    .second = -r * r,
                    .onset = std::sin(w),
                    .lasts = int64_t(ceil(-log(faded) / fade))};
  }
}

size_t SoundTrack::tone_of(Entity body) const {
  const double above = std::round(tones_an_octave * std::log2(middle_ / radius_[body]));
  return size_t(most_tones + clamp(above, -double(most_tones), double(most_tones)));
}

void SoundTrack::record(span<const Collision> collisions) {
  for (const Collision& collision : collisions) {
    if (collision.kind == CollisionKind::rest || !(collision.impulse > 0)) continue;
    const double time = clock_.film(collision.time);
    const int64_t sample = samples_until(lead_ + time);
    if (!(time >= 0) || sample >= end_) continue;

    make_until(sample);
    const bool two = collision.b < radius_.size();
    const double amplitude =
        sqrt(collision.impulse) * (two ? 0.5 : 1) * (collision.kind == CollisionKind::taut ? of_string : 1);
    strike(tone_of(collision.a), amplitude);
    if (two) strike(tone_of(collision.b), amplitude);
  }
}

void SoundTrack::record_paths(span<const PathPiece> pieces) {
  for (const PathPiece& piece : pieces)
    if (piece.joint) radius_[piece.body] = piece.radius;
}

void SoundTrack::strike(size_t tone, double amplitude) {
  Ring& ring = rings_[tone];
  if (ring.until <= made_) ringing_.push_back(tone);
  ring.until = made_ + ring.lasts;
  ring.x += amplitude * ring.onset;
}

/// Makes all samples before this one. What is struck sooner, by rounding, sounds now.
void SoundTrack::make_until(int64_t sample) {
  float samples[chunk];
  while (made_ < sample) {
    const auto count = size_t(min(chunk, sample - made_));
    make({samples, count});
    put_({samples, count});
  }
}

void SoundTrack::make(span<float> samples) {
  double sums[chunk] = {};
  for (const size_t tone : ringing_) {
    Ring& ring = rings_[tone];
    for (size_t i = 0; i < samples.size(); ++i) {
      const double y = ring.first * ring.before + ring.second * ring.last + ring.x;
      ring.x = 0;
      ring.last = ring.before;
      ring.before = y;
      sums[i] += y;
    }
  }

  for (size_t i = 0; i < samples.size(); ++i) {
    samples[i] = float(sums[i]);
    peak_ = max(peak_, double(std::abs(samples[i])));
  }

  made_ += int64_t(samples.size());
  std::erase_if(ringing_, [this](size_t tone) {
    Ring& ring = rings_[tone];
    if (made_ < ring.until) return false;
    ring.before = ring.last = 0;
    return true;
  });
}

void SoundTrack::finish(double length) {
  make_until(min(end_, samples_until(length)));
}

}  // namespace carom
