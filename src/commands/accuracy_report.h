#pragma once
// The sources of a run's error, as text and as JSON.
#include <nlohmann/json.hpp>

#include "engine/engine.h"
#include "std.h"

namespace carom {

struct Scene;

struct AccuracyReport {
  vector<pair<string, string>> lines;  // label, text
  nlohmann::ordered_json json;         // an object; null: the scene has no motion
};

/// Runs the scene several times for it. Throws Interrupted.
AccuracyReport report_accuracy(const Scene& scene, EngineChoice engine);

}  // namespace carom
