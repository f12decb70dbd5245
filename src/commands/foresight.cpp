// Simulates by the most exact engine within a budget of wall time, and extrapolates the time of the whole run. The
// number of collisions has no formula.
#include "commands/foresight.h"

#include <fmt/format.h>

#include <chrono>

#include "commands/crowd_ahead.h"
#include "commands/interrupt.h"
#include "commands/preview.h"
#include "export/picture_streams.h"
#include "export/timeline.h"
#include "physics/body_now.h"
#include "physics/force.h"
#include "physics/world.h"
#include "physics/world_now.h"
#include "render/moving_camera.h"
#include "render/sight.h"
#include "run/stopwatch.h"
#include "run/survey.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

/// The instants of the pictures. Of several outputs: from the first one on at the least of their intervals. If there
/// are too many, the largest allowed number, evenly spaced.
Ticks instants_of(const Scene& scene, Foresight& result) {
  constexpr int64_t most = 2000;
  vector<Ticks> shown = shown_instants(scene);
  std::erase_if(shown, [](const Ticks& ticks) { return ticks.count() < 1; });
  if (shown.empty()) return Ticks::even(0, 0, 0);

  double from = infinity, until = 0, interval = infinity;
  for (const Ticks& ticks : shown) {
    from = min(from, ticks.at(ticks.first()));
    until = max(until, ticks.at(ticks.last()));
    if (ticks.count() > 1) interval = min(interval, ticks.interval());
  }

  const double intervals = interval < infinity ? std::round((until - from) / interval) : 1;
  const double count = from < until ? 1 + intervals : 1;
  const bool all = shown.size() == 1 && count <= most;
  const Ticks ticks = all ? shown.front() : Ticks::even(int64_t(min(count, double(most))), from, until);
  result.every = ticks.count() > 1 ? ticks.interval() : 0;
  result.watched_from = result.watched_until = from;
  return ticks;
}

/// Multiple of the budget: the search for the first collision ends.
constexpr double budgets_to_first = 20;

/// Runs the most exact simulator from instant to instant.
class Trial {
 public:
  Trial(const Scene& scene, const MovingCamera* camera, double budget)
      : scene_(scene), budget_(budget), camera_(camera) {
    if (camera == nullptr) return;
    sight_.emplace(scene);
    ticks_ = instants_of(scene, result_);
    next_ = ticks_.first();
    last_ = ticks_.last();
  }

  Foresight go() {
    try {
      const auto start = Clock::now();
      oracle_ = make_oracle(scene_, scene_.output.flights);
      count_pieces();
      made_s_ = since(start);
      check_view_if_due();

      while (oracle_->time() < scene_.simulate.duration && needs_more()) advance();
      if (!result_.first && oracle_->time() < scene_.simulate.duration)
        result_.trouble = oracle_->time() > 0
                              ? fmt::format("there is none until {:.3g} s, and a second of motion takes {:.2g} s",
                                            oracle_->time(), advance_s_ / oracle_->time())
                              : fmt::format("the simulation had not begun after {:.2g} s", since(start_));
    } catch (const SimulationError& error) {
      (result_.first ? result_.failure : result_.trouble) =
          error.named([&](Entity body) { return fmt::format("`{}`", scene_.roster.name(body)); }).what();
      result_.cut = result_.cut || next_ <= last_;
    }
    for (const Hiding& hiding : hidden_) result_.hidings.push_back(hiding);
    return std::move(result_);
  }

  /// Wall time of the whole simulation, scaled up from this part of it; none: nothing was simulated.
  optional<double> whole() const {
    const double duration = scene_.simulate.duration;
    if (duration == 0 && oracle_) return made_s_;
    if (!oracle_ || !(oracle_->time() > 0)) return nullopt;
    const double rate = advance_s_ / oracle_->time();
    return made_s_ + advance_s_ +
           time_ahead(crowd_ahead(scene_, most_exact(scene_.world)), oracle_->time(), duration, rate);
  }

  /// Of the whole motion, scaled up from this part of it.
  PiecesAhead pieces() const {
    if (!oracle_ || !(oracle_->time() > 0)) return pieces_;
    const double rate = pieces_.of_events / oracle_->time();
    const PiecesAhead ahead =
        pieces_ahead(crowd_ahead(scene_, most_exact(scene_.world)), oracle_->time(), scene_.simulate.duration, rate);
    return {pieces_.of_events + ahead.of_events, pieces_.of_crowd + ahead.of_crowd};
  }

 private:
  void count_pieces() {
    for (const PathPiece& piece : oracle_->paths()) ++(piece.kicked ? pieces_.of_crowd : pieces_.of_events);
  }

  bool needs_more() {
    if (since(start_) < budget_) return true;
    if (next_ <= last_) result_.cut = true;
    // Crossings are not worth more time.
    next_ = last_ + 1;
    return !result_.first && since(start_) < budgets_to_first * budget_;
  }

  /// To the next instant. Before the first collision at most to twice the time reached, so that little is simulated
  /// beyond it.
  void advance() {
    const double duration = scene_.simulate.duration, time = oracle_->time();
    double target = min(duration, result_.first ? time + duration / 100 : max(2 * time, duration * 0x1p-20));
    if (next_ <= last_) target = min(target, ticks_.at(next_));

    while (oracle_->time() < target) {
      stop_if_interrupted();
      const auto start = Clock::now();
      oracle_->advance_to(target);
      advance_s_ += since(start);
      count_pieces();

      for (const Collision& collision : oracle_->collisions()) {
        if (!result_.first && collision.kind != CollisionKind::rest) result_.first = collision;
      }
      if (!needs_more()) return;
    }
    check_view_if_due();
  }

  void check_view_if_due() {
    if (next_ > last_ || oracle_->time() < ticks_.at(next_)) return;
    const State& state = oracle_->state();
    const Camera camera = camera_->at(state);
    const CameraFrame view = view_of(camera, camera_->size());

    const bool begins = in_view_.empty();
    in_view_.resize(state.position.size());
    for (Entity body = 0; body < in_view_.size(); ++body) {
      if (is_gone(state, body)) continue;
      const double reach = volume_now(scene_.world, state, body).reach();
      const bool in_view = is_sphere_in_view(camera, view, state.position[body], reach);
      if (!begins && in_view != in_view_[body]) result_.crossings.push_back({body, ticks_.at(next_), in_view});
      in_view_[body] = in_view;
    }
    check_hidden(state, camera, view);
    result_.watched_until = ticks_.at(next_++);
  }

  /// Goes on with what hides a body as long as it does.
  void check_hidden(const State& state, const Camera& camera, const CameraFrame& view) {
    if (!sight_->may_hide()) return;
    const World& world = known_.at(state.fired);
    const double time = ticks_.at(next_);
    vector<Hiding> before = exchange(hidden_, {});
    for (Entity body = 0; body < in_view_.size(); ++body) {
      if (!in_view_[body] || is_gone(state, body)) continue;
      vector<Entity> hiders =
          sight_->hiders(world, time, camera.eye, view, state.position[body], radius_now(scene_.world, state, body));
      std::erase_if(hiders, [&](Entity e) {
        return ranges::binary_search(camera_->faded(), uint32_t(e - scene_.world.body_count()));
      });
      if (hiders.empty()) continue;

      const auto same = ranges::find_if(before, [&](const Hiding& hiding) {
        return hiding.body == body && ranges::binary_search(hiders, hiding.behind);
      });
      hidden_.push_back(same == before.end() ? Hiding{body, hiders.front(), time, time} : *same);
      hidden_.back().until = time;
      if (same != before.end()) before.erase(same);
    }
    result_.hidings.insert(result_.hidings.end(), before.begin(), before.end());
  }

  const Scene& scene_;
  double budget_;
  Clock::time_point start_ = Clock::now();
  const MovingCamera* camera_;  // null: crossings are not sought
  Ticks ticks_ = Ticks::even(0, 0, 0);
  int64_t next_ = 0, last_ = -1;  // ticks left to check
  vector<bool> in_view_;          // by body, at the previous tick; empty: there was none
  optional<Sight> sight_;         // of the camera
  WorldNow known_{scene_.world};
  vector<Hiding> hidden_;  // at the previous tick
  unique_ptr<Simulator> oracle_;
  double made_s_ = 0, advance_s_ = 0;  // wall times
  PiecesAhead pieces_;                 // so far
  Foresight result_;
};

/// Wall time of a simulation by the scene's own engine, extrapolated from the part that the budget (s) allows.
optional<double> own_engine_s(const Scene& scene, const EngineChoice& engine, double budget) {
  const double duration = scene.simulate.duration;
  const auto start = Clock::now();
  try {
    const auto simulator = make_simulator(scene, {}, engine.steps);
    const double made = since(start);

    while (simulator->time() < duration && since(start) < budget) {
      stop_if_interrupted();
      simulator->advance_to(min(duration, simulator->time() + duration / 1000));
    }

    if (!(simulator->time() > 0)) return nullopt;
    const double spent = since(start) - made;
    const double time = simulator->time();
    return made + spent + time_ahead(crowd_ahead(scene, engine.engine), time, duration, spent / time);
  } catch (const SimulationError&) {
    return nullopt;
  }
}

}  // namespace

Foresight foresee(const Scene& scene, const EngineChoice& engine, const MovingCamera* camera, double budget) {
  Trial trial(scene, camera, budget);
  Foresight result = trial.go();
  result.pieces = trial.pieces();
  const Engine oracle = most_exact(scene.world);
  // A failure of another simulator.
  if (engine.engine != oracle) result.failure.clear();
  // A tolerance takes an unknown number of runs.
  const bool settled = !scene.simulate.tolerance;
  if (!settled) return result;
  result.simulate_s = engine.engine == oracle ? trial.whole() : own_engine_s(scene, engine, budget);
  return result;
}

bool frame_motion(MovingCamera& camera, double budget) {
  if (!camera.frames_motion()) return true;
  struct Spent {};
  const auto start = Clock::now();
  try {
    MovingCamera* const cameras[] = {&camera};
    survey(cameras, *make_oracle(camera.scene()), [&] {
      stop_if_interrupted();
      if (since(start) >= budget) throw Spent();
    });
    return true;
  } catch (const Spent&) {
    return false;
  } catch (const SimulationError&) {
    // There is no motion.
    return false;
  }
}

}  // namespace carom
