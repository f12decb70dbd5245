// The scenes are measured in turn, in one process. Parallel runs would disturb one another's times.
#include "commands/commands.h"

#include <fmt/format.h>

#include "bench/bench_folder.h"
#include "commands/bench_report.h"
#include "commands/error_list.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/progress.h"
#include "commands/report.h"
#include "commands/text.h"
#include "export/gnuplot.h"
#include "numerics/processors.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

/// All scenes of one command line, one after another, so that no scene disturbs the times of another.
class BenchSession {
 public:
  explicit BenchSession(const Options& options)
      : options_(options), gnuplot_(find_gnuplot()), scenes_(plan_scenes(options, Purpose::bench)) {}

  int go() {
    refuse_other_content(scenes_, options_);
    if (const string errors = error_count(scenes_); !errors.empty()) return refuse(errors);

    int code = 0, interrupted = 0;
    for (PlannedScene& planned : scenes_) {
      Json entry = {{"scene", planned.file}, {"status", "not run"}, {"folder", planned.folder}};
      if (interrupted == 0) {
        try {
          if (!measure(planned, entry)) code = 1;
        } catch (const Interrupted& stop) {
          interrupted = stop.exit_code();
          entry["status"] = "interrupted";
          complain(options_, fmt::format("{}: interrupted; nothing was written", printable(planned.file)));
        }
      }

      document_.push_back(std::move(entry));
      planned.scene.reset();  // the next one may need the memory
    }

    return print_end(options_, interrupted != 0 ? interrupted : code, document_);
  }

 private:
  int refuse(const string& errors) {
    for (const PlannedScene& planned : scenes_) {
      write_err(planned.error);
      Json entry = {{"scene", planned.file}, {"status", planned.errors > 0 ? "wrong" : "not run"}};
      if (planned.errors > 0) entry["errors"] = errors_json(planned.records);
      document_.push_back(std::move(entry));
    }
    complain(options_, errors + "; nothing was run");
    return print_end(options_, 2, document_);
  }

  /// Returns whether the bench succeeded. Throws Interrupted.
  bool measure(const PlannedScene& planned, Json& entry) {
    try {
      bench(planned, entry);
      return true;
    } catch (const std::exception& error) {
      // Ctrl-C ends gnuplot too: its error is then the interrupt.
      stop_if_interrupted();
      fail(planned, entry, reason_of(error));
      return false;
    }
  }

  void bench(const PlannedScene& planned, Json& entry) {
    const Scene& scene = *planned.scene;
    BenchFolder folder(planned.folder, gnuplot_);
    Progress progress(options_, printable(planned.name));
    const BenchWatch watch{stop_if_interrupted, [&](double done, const string& what) { progress.update(done, what); }};
    const BenchResult result = run_bench(scene, options_.bench, watch);

    stop_if_interrupted();
    progress.clear();
    folder.write(scene, options_.bench, result);

    entry["status"] = "done";
    entry.update(bench_json(result));
    entry["files"] = files_in(planned.folder);

    if (options_.json || options_.quiet) return;
    Block block(options_);
    block.heading(planned.name, scene.title);
    describe(block, planned, result);
    write_out(block.text());
    flush_out();
  }

  void fail(const PlannedScene& planned, Json& entry, string_view text) {
    complain(options_, fmt::format("{}: the bench failed: {}", printable(planned.file), text));
    entry["status"] = "failed";
    entry["errors"] = errors_json(error_of_text(text, planned.file));
  }

  const Options& options_;
  string gnuplot_;
  vector<PlannedScene> scenes_;
  Json document_ = Json::array();
};

}  // namespace

const Command bench_command = {
    "bench",
    [](const Options& options) {
      // Run times of one thread are compared.
      use_threads(1);
      return BenchSession(options).go();
    },
    "measures run time against error by every engine, integrator and step",
    "  carom bench scenes/two_bowling_balls.yaml\n"
    "  carom bench scene.yaml --steps 0.1:0.0001 --repeat 9  which steps, how many timed runs\n"
    "  carom bench scenes/*.yaml --budget 5 -o benches       benches/<scene file's stem>/...\n",
    "Without -o a scene's bench goes to output/<scene file's stem>.bench/: bench.csv, the plot as\n"
    "bench.png and bench.svg, scene.yaml and manifest.json. A bench of the same scene is replaced.\n"
    "\n"
    "Exit codes: 0 done, 1 a bench failed, 2 the command line or a scene is wrong, 130 or 143\n"
    "interrupted.",
    {{"--output",
      "the bench's folder; with several scenes, the folder that\nholds theirs (output/<scene file's stem>.bench)"},
     {"--set"},
     {"--seed"},
     {"--steps"},
     {"--repeat"},
     {"--budget"},
     {"--reference"},
     {"--jobs", "no effect: scenes are measured one after another"},
     {"--force", "overwrite other content of the folder"},
     {"--progress"}}};

}  // namespace carom
