#pragma once
// A priority queue with one entry for each body: a tournament with games of eight. Each node keeps its winner and the
// winner's time. The eight times of a game are contiguous, and only equal times need more data. A changed entry replays
// its games up to the first one with the same result.
#include <bit>

#include "numerics/large_pages.h"
#include "numerics/prefetch.h"
#include "numerics/vectors.h"
#include "std.h"

namespace carom {

/// Before(i, j): whether entry i comes before entry j, for two entries with the same time. Together with the time it is
/// a total order.
template <typename Before>
class Tournament {
 public:
  Tournament(uint32_t entries, Before before) : before_(before) {
    vector<size_t> sizes;
    size_t nodes = entries;
    size_t all = 0;
    do {
      nodes = (nodes + width - 1) / width;
      sizes.push_back(nodes * width);
      all += sizes.back();
    } while (nodes > 1);

    times_.assign(all, never);
    winners_.assign(all - sizes[0], none);

    double* time = times_.data();
    uint32_t* winner = winners_.data();
    for (size_t l = 0; l < sizes.size(); ++l) {
      levels_.push_back({time, l == 0 ? nullptr : winner});
      time += sizes[l];
      if (l > 0) winner += sizes[l];
    }
  }
  Tournament(const Tournament&) = delete;
  Tournament& operator=(const Tournament&) = delete;

  uint32_t first() const { return first_; }  // none: no entry is due
  double first_time() const { return first_time_; }
  double time(uint32_t i) const { return levels_[0].time[i]; }  // as of the last update

  /// Call this after entry i has changed. Its time (s) may be infinite: it is then never due.
  void update(uint32_t i, double time) {
    size_t at = i;
    uint32_t winner = i;
    levels_[0].time[i] = time;
    for (size_t l = 1; l < levels_.size(); ++l) {
      at /= width;
      Level& up = levels_[l];

      // An entry that did not win before, and that comes later than the winner, changes nothing.
      if (up.winner[at] != i && up.time[at] < time) {
        if (!(up.time[at] + close_ < time)) [[unlikely]]
          note_close(time);
        return;
      }
      play(l - 1, at, winner, time);
      // Entry i itself may have changed in more than its time.
      if (up.winner[at] == winner && up.time[at] == time && winner != i) return;
      up.winner[at] = winner;
      up.time[at] = time;
    }

    play(levels_.size() - 1, 0, first_, first_time_);
  }

  static constexpr uint32_t none = ~uint32_t{0};
  void prefetch(uint32_t i) const {
    carom::prefetch(&levels_[0].time[i]);
    if (levels_.size() > 1) carom::prefetch(&levels_[1].time[i / width]);
    if (levels_.size() > 1) carom::prefetch(&levels_[1].winner[i / width]);
  }

  /// Times that differ by no more than this (s) are close. They are noted where two entries in one game have them.
  void set_close(double span) { close_ = span; }
  /// Whether two entries have been close about this time (s), which must not decrease from call to call.
  bool close_at(double time) { return !close_times_.empty() && find_close(time); }

  /// An entry and its time.
  struct Due {
    double time;
    uint32_t entry;
  };
  /// Appends entries that are due up to `until`, in no order. Of entries in the same games at the lowest levels, only
  /// the first is appended.
  void due_until(double until, vector<Due>& due) const {
    if (first_time_ <= until) collect(levels_.size() - 1, 0, until, due);
  }

  void keep(auto& archive) {
    archive.sized(times_, winners_);
    archive(first_, first_time_, close_times_);
  }

 private:
  static constexpr size_t width = 8;
  static constexpr double never = infinity;

  struct Level {
    double* time;  // s, padded to whole games
    // The winner with that time. There is none at the bottom, where it is the entry itself.
    uint32_t* winner;
  };

  void collect(size_t l, size_t game, double until, vector<Due>& due) const {
    constexpr size_t low = 2;
    const Level& level = levels_[l];
    for (size_t k = game * width; k < (game + 1) * width; ++k) {
      if (level.time[k] > until) continue;
      if (l == 0)
        due.push_back({level.time[k], uint32_t(k)});
      else if (l == low)
        due.push_back({level.time[k], level.winner[k]});
      else
        collect(l - 1, k, until, due);
    }
  }

  void play(size_t l, size_t game, uint32_t& winner, double& time) const {
    const Level& level = levels_[l];
    const double* t = level.time + game * width;

    // The least time of the game, and a bit for each entry that has it, or is close.
    typedef double Pair __attribute__((vector_size(16)));
    Pair pair[4];
    for (int k = 0; k < 4; ++k) std::memcpy(&pair[k], t + 2 * k, sizeof(Pair));
    const auto lesser = [](Pair a, Pair b) { return a < b ? a : b; };
    const Pair least = lesser(lesser(pair[0], pair[1]), lesser(pair[2], pair[3]));
    const Pair first = lesser(least, __builtin_shufflevector(least, least, 1, 0));
    time = first[0];
    unsigned ties = 0;
    for (int k = 0; k < 4; ++k) ties |= bits_of(pair[k] <= first + close_) << (2 * k);

    if (time == never) {
      winner = none;
    } else if ((ties & (ties - 1)) == 0) [[likely]] {
      winner = entry(l, game * width + unsigned(std::countr_zero(ties)));
    } else {
      winner = first_of(ties, l, game, time);
    }
  }

  uint32_t entry(size_t l, size_t place) const { return l == 0 ? uint32_t(place) : levels_[l].winner[place]; }

  /// Of several entries of a game with this time or close to it, the one that comes before all others.
  [[gnu::noinline]] uint32_t first_of(unsigned ties, size_t l, size_t game, double time) const {
    note_close(time);
    uint32_t winner = none;
    for (; ties != 0; ties &= ties - 1) {
      const size_t place = game * width + unsigned(std::countr_zero(ties));
      if (levels_[l].time[place] != time) continue;
      const uint32_t other = entry(l, place);
      if (winner == none || before_(other, winner)) winner = other;
    }
    return winner;
  }

  [[gnu::noinline]] void note_close(double time) const {
    if (close_times_.empty() || close_times_.back() != time) close_times_.push_back(time);
  }
  [[gnu::noinline]] bool find_close(double time) {
    std::erase_if(close_times_, [&](double close) { return close < time - close_; });
    return any_of(close_times_, [&](double close) { return close <= time + close_; });
  }

  Before before_;
  LargeVector<double> times_;      // of all levels
  LargeVector<uint32_t> winners_;  // of all levels but the first
  vector<Level> levels_;
  uint32_t first_ = none;
  double first_time_ = never;
  double close_ = 0;  // s
  mutable vector<double> close_times_;
};

}  // namespace carom
