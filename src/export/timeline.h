#pragma once
// The times at which outputs are due. Each is computed from its number and never summed up, so that times do not drift.

#include "scene/film_clock.h"
#include "std.h"

namespace carom {

/// The instants of one output, numbered first() .. last().
class Ticks {
 public:
  /// 0, interval, 2 interval, ... below `duration` (s), and the duration itself as the last one.
  /// An interval that is a short decimal (0.01) or one over a whole number (1/30) is exact: tick 7 of 0.01 is 0.07.
  static Ticks every(double interval, double duration);
  /// Tick i at i / per_second exactly, for every i with a time in from .. until (s).
  static Ticks rate(double per_second, double from, double until);
  /// Tick i at from + i * speed / per_second exactly, for every i >= 0 with a time of at most `until` (s).
  /// A `from` or a `speed` that is a short decimal, or one over a whole number, is meant as such: 0.4 is 4/10.
  /// With a slowdown, tick i is at the time that the clock shows there.
  static Ticks film(double per_second, double speed, double from, double until, const optional<Slowdown>& slow = {});
  /// `count` evenly spaced instants from `from` to `until` (s), ends included. A single one is at `until`.
  static Ticks even(int64_t count, double from, double until);

  int64_t first() const { return first_; }
  int64_t last() const { return last_; }  // first() - 1: none
  int64_t count() const { return last_ - first_ + 1; }
  double at(int64_t i) const;                                    // s
  double interval() const { return numerator_ / denominator_; }  // s, between two of them, apart from a slowdown
  /// The decimals with which times of ticks are written: all of them, if these are at most 6. Else so many that
  /// rounding is at most a twentieth of the interval.
  int decimals() const;
  /// Leaves out what is after `end` (s). An output that ends with the duration ends there instead.
  void cut(double end);
  /// Whether both have the same instants, with any numbers.
  bool has_times_of(const Ticks& other) const;

 private:
  /// A tick's number, a fraction in most cases, at a time (s).
  double number_at(double time) const;
  /// The largest number whose time is at most `until`, near a guess of it. -1: none.
  int64_t last_until(double until, double guess) const;

  int64_t first_ = 0, last_ = -1;
  /// Tick i is at (offset + i * numerator) / denominator.
  double offset_ = 0, numerator_ = 1, denominator_ = 1;
  optional<FilmClock> clock_;  // of a slowdown, which shows these
  optional<double> end_;       // the last tick's own time
  bool closes_ = false;        // that is the run's end
};

/// The instants of all outputs in order. The last instant is the duration, even if no output is due then.
class Timeline {
 public:
  explicit Timeline(double duration);
  int add(const Ticks& ticks);  // returns the stream's number
  /// To the next instant. False: none is left.
  bool advance();
  /// Ends the timeline at `time` (s), which is after all instants before the present one. The present instant is that
  /// or an earlier one.
  void end_at(double time);
  double time() const { return time_; }  // s
  /// The tick's number if this stream is due.
  optional<int64_t> due(int stream) const;
  bool is_empty(int stream) const;  // it has no instant
  /// The time (s) of the stream's next tick, which may be due. None: none is left.
  optional<double> next(int stream) const;

  /// Which ticks are done. Those that end_at() cuts off are not due any more when it is called.
  void keep(auto& archive) {
    archive(time_, ended_);
    for (Stream& stream : streams_) archive(stream.next, stream.due);
  }

 private:
  struct Stream {
    Ticks ticks;
    int64_t next;
    bool due;
  };
  void find_due();

  double duration_, time_ = 0;
  bool ended_ = false;
  vector<Stream> streams_;
};

}  // namespace carom
