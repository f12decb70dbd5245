#pragma once
// The measures of a finished run: from its summary.csv and manifest, or else derived from its tables.

#include "compare/end_of_trajectory.h"
#include "files/manifest.h"
#include "run/measure.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

/// The scene in a run's folder. Throws SceneError.
Scene load_run_scene(const string& folder);

class StoredMeasures {
 public:
  /// `folder`: the open folder of the run, which must stay open. `path`: its path, for messages.
  StoredMeasures(int folder, string path) : folder_(folder), path_(std::move(path)) {}

  /// Whether every measure can be determined.
  bool have(span<const Measure> measures);
  /// A measure's value. `summary`: the cells of the run's row, by summary_columns().
  /// Throws ExportError, with a remedy, if the folder does not have what the measure requires.
  Measured value(const Measure& measure, const vector<string>& summary);

 private:
  /// The collisions between two things: their number, and the time of the first (s).
  struct Meetings {
    double count = 0, first;
  };

  /// The crossings of a region.
  struct Visits {
    double entries = 0, inside = 0, first;  // the number of entries, of bodies inside at the end; s, of the first entry
    string entrant;                         // the body of the first entry
  };

  const Manifest* manifest();
  const Measured* measured(const string& name);
  bool has_file(const char* name) const;
  const Scene& scene();
  const vector<EndMotion>& ends();
  bool has(const Measure& measure);
  string lacking(const Measure& measure);
  double number(const Measure& measure, const vector<string>& summary);
  double at_end(const Measure& measure);
  double quantity(const Measure& measure, size_t body);
  double counted(const Measure& measure, const vector<string>& summary);
  double evaluated(const Measure& measure, const vector<string>& summary);
  Meetings meetings(const Measure& measure);
  /// The name of the second body of a string. Empty: it is tied to a point, or not known.
  string second_body(string_view string);
  Visits visits(const Measure& measure);

  const int folder_;
  const string path_;
  optional<optional<Manifest>> manifest_;
  optional<Scene> scene_;
  double duration_ = 0;  // s, of the run
  optional<vector<EndMotion>> ends_;
};

}  // namespace carom
