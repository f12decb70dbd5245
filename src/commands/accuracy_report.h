#pragma once
// What a run's accuracy consists of, for people and as JSON.
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "run/engine.h"

namespace carom {

struct Scene;

struct AccuracyReport {
  std::vector<std::pair<std::string, std::string>> lines;  // label, text
  nlohmann::ordered_json json;                             // an object; null: there is nothing to tell
};

/// Runs the scene several times for it. Throws Interrupted.
AccuracyReport report_accuracy(const Scene& scene, EngineChoice engine);

}  // namespace carom
