#pragma once
// What is to happen within a step, by time. An event is void once a body that it concerns has another path.
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

#include "physics/world.h"
#include "simulate/stepped_paths.h"

namespace carom {

enum class StepEventKind : std::uint8_t { release, impact };  // in the order in which events of one instant happen

struct StepEvent {
  double time;  // s, since the step's start
  StepEventKind kind;
  Entity a, b;           // of a release too: the two that part
  std::uint8_t feature;  // as in Touch
  std::uint32_t version_a = 0, version_b = 0;

  bool operator>(const StepEvent& e) const {
    if (time != e.time) return time > e.time;
    if (kind != e.kind) return kind > e.kind;
    return a != e.a ? a > e.a : b > e.b;
  }
};

class StepEvents {
 public:
  /// `paths` must outlive this.
  explicit StepEvents(const StepPaths& paths) : paths_(paths) {}

  /// Schedules an event of the bodies' present paths.
  void push(double time, StepEventKind kind, Entity a, Entity b, std::uint8_t feature) {
    queue_.push({time, kind, a, b, feature, paths_.version_of(a), paths_.version_of(b)});
  }
  /// Takes the first event that is not void. False: there is none.
  bool pop(StepEvent& event) {
    while (!queue_.empty()) {
      event = queue_.top();
      queue_.pop();
      if (paths_.version_of(event.a) == event.version_a && paths_.version_of(event.b) == event.version_b) return true;
    }
    return false;
  }

 private:
  const StepPaths& paths_;
  std::priority_queue<StepEvent, std::vector<StepEvent>, std::greater<>> queue_;
};

}  // namespace carom
