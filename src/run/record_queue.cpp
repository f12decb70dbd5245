#include "run/record_queue.h"

#include "physics/trigger.h"
#include "std.h"

namespace carom {
namespace {

/// On the way, unless a single batch has more: some 20 MB.
constexpr size_t most_parts = 65536;

}  // namespace

/// Adds the events that are new.
void RecordQueue::add_events(const vector<double>& fired, Batch& batch) {
  fired_.resize(fired.size(), not_yet);
  for (uint32_t k = 0; k < fired.size(); ++k) {
    if (fired_[k] == fired[k]) continue;
    Recorded& recorded = batch.emplace_back();
    recorded.kind = Recorded::Kind::event;
    recorded.event = {k, fired[k]};
  }
  fired_ = fired;
}

void RecordQueue::put(const Simulator& simulator) {
  Batch batch;
  batch.reserve(simulator.collisions().size() + simulator.paths().size());
  add_events(simulator.tally().changes.fired, batch);
  in_order(
      simulator.collisions(), simulator.paths(),
      [&](const CollisionMark& mark) {
        Recorded& recorded = batch.emplace_back();
        recorded.kind = Recorded::Kind::collision;
        recorded.collision = mark;
      },
      [&](const PathPiece& piece) { batch.emplace_back().piece = piece; });
  if (batch.empty()) return;

  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return left_ || parts_ == 0 || parts_ + batch.size() <= most_parts; });
  if (left_) return;
  parts_ += batch.size();
  batches_.push_back(std::move(batch));
  changed_.notify_all();
}

void RecordQueue::end(bool whole) {
  const std::lock_guard lock(mutex_);
  state_ = whole ? State::whole : State::abandoned;
  changed_.notify_all();
}

void RecordQueue::leave() {
  const std::lock_guard lock(mutex_);
  left_ = true;
  batches_.clear();
  parts_ = 0;
  changed_.notify_all();
}

bool RecordQueue::next(Recorded& recorded) {
  if (read_ == reading_.size()) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return state_ != State::open || !batches_.empty(); });
    if (batches_.empty()) {
      if (state_ == State::abandoned) throw RecordAbandoned();
      return false;
    }

    reading_ = std::move(batches_.front());
    batches_.pop_front();
    parts_ -= reading_.size();
    read_ = 0;
    changed_.notify_all();
  }
  recorded = std::move(reading_[read_++]);
  return true;
}

}  // namespace carom
