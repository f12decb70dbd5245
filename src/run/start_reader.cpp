// Flights are replayed up to the time. A table is read row by row up to the time, whose cell must be that very number:
// a state between two rows would be a guess.
#include "run/start_reader.h"

#include <fcntl.h>
#include <fmt/format.h>

#include "export/flights_file.h"
#include "files/failed_run.h"
#include "files/folder_writer.h"
#include "files/publication.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "physics/world.h"
#include "run/former_run.h"
#include "run/stored_trajectory.h"
#include "scene/scene.h"
#include "simulate/simulator.h"
#include "simulate/tolerances.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

constexpr const char* table_name = "trajectory.csv";

/// Null: it has none.
const FileRecord* states_file(const FormerRun& run) {
  return run.find(run.has_flights() ? flights_name : table_name);
}

/// A former run that stands ready to be read.
FormerRun opened(const string& folder, const LoadOptions& options) {
  if (const string failure = stored_failure(folder); !failure.empty())
    throw StartError("it has failed: " + failure.substr(0, failure.find('\n')),
                     "name the folder of a run that is done");
  settle_folder(folder);

  LoadOptions load;
  load.budget = load.budget.without_outputs();
  load.budget.enforced = false;
  load.chooses_outputs = true;
  load.mesh_points = options.mesh_points;
  SceneFile file(former_scene_file(folder), load);
  return read_former_run(folder, file, [](const FormerRun& run, string_view name) {
    const FileRecord* const states = states_file(run);
    return (states == nullptr || name != states->name) && name != "summary.csv";
  });
}

string without_slash(string path) {
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return path;
}

/// What of an error's text is the fault, and what the remedy: its first line, and the others.
StartError in_parts(const string& text) {
  const size_t line = min(text.find('\n'), text.size());
  string remedy = text.substr(min(line + 1, text.size()));
  remedy.erase(0, min(remedy.find_first_not_of(' '), remedy.size()));
  return {text.substr(0, line), remedy};
}

/// Times of a table on both sides of one, in s.
struct Nearest {
  optional<double> before, after;
};

[[noreturn]] void refuse_time(double at, const Nearest& near) {
  vector<string> times;
  for (const optional<double>& time : {near.before, near.after})
    if (time) times.push_back(shortest(*time));
  throw StartError(
      fmt::format("it has no flights, and its {} has no rows at {} s", table_name, shortest(at)),
      fmt::format("the nearest rows are at {} s\nor run it with `output.flights: true`, which has every time "
                  "of motion along parabolas",
                  joined(times, " and ")),
      true);
}

State state_in_flights(const FormerRun& run, double at) {
  const unique_ptr<Simulator> replay = run.replay(run.scene);
  while (replay->time() < at) replay->advance_to(at);
  return replay->state();
}

State state_in_table(const FormerRun& run, double at) {
  const Descriptor folder = open_folder(AT_FDCWD, run.folder, true);
  Descriptor file = folder ? open_stored_table(folder.get(), table_name) : Descriptor();
  if (!file) throw StartError(fmt::format("{} is missing", table_name), "run it again");

  StoredTrajectory trajectory(std::move(file), run.scene);
  Nearest near;
  while (!near.after && trajectory.next()) {
    if (trajectory.time() != at) {
      (trajectory.time() < at ? near.before : near.after) = trajectory.time();
      continue;
    }

    // Bodies that are gone have no rows, or empty ones.
    const size_t bodies = run.scene.world.body_count();
    State state;
    state.time = at;
    state.position.assign(bodies, Vec3::Zero());
    state.velocity.assign(bodies, Vec3::Zero());
    state.part_of.assign(bodies, no_entity);

    trajectory.read([&](Entity body, const vector<string_view>& row, size_t first) {
      if (read_motion(row, first, state.position[body], state.velocity[body]))
        state.part_of[body] = body;
      else if (!row[first].empty())
        throw ForeignRow();
    });
    if (ranges::count(state.part_of, no_entity) == 0) state.part_of.clear();
    return state;
  }
  refuse_time(at, near);
}

/// The book's engine applies the impulses of time 0 in its first frame, so that its velocities at time 0 lack them.
bool lacks_impulses(const Scene& scene, double at) {
  return scene.simulate.engine == Engine::book && !scene.world.impulse.empty() &&
         at <= stepped_tolerance::frame_rounding * scene.simulate.step.value_or(0);
}

/// Throws StartError, and what reading files throws.
FormerState state_of(const FormerRun& run, optional<double> at) {
  const double end = run.read_end_time();
  if (at && !(*at >= 0 && *at <= end))
    throw StartError(fmt::format("it ended at {} s, before {} s", shortest(end), shortest(*at)),
                     fmt::format("expected `at` from 0 to {} s", shortest(end)), true);
  if (lacks_impulses(run.scene, at.value_or(end)))
    throw StartError("the book's engine had not yet applied the impulses then", "expected a later `at`", true);

  const FileRecord* const file = states_file(run);
  if (file == nullptr)
    throw StartError("it has neither flights nor a trajectory",
                     "run it with `output.flights: true`, or with `output.trajectory`");
  if (!run.has_flights() && !run.in_table.empty())
    throw StartError(fmt::format("it has no flights, and its {} has rows of {} alone", table_name, run.in_table),
                     "run it with `output.flights: true`, or with `output.trajectory` without `on`");

  FormerState former;
  for (Entity body = 0; body < run.scene.world.body_count(); ++body)
    former.names.push_back(run.scene.roster.name(body));
  former.state = run.has_flights() ? state_in_flights(run, at.value_or(end)) : state_in_table(run, at.value_or(end));
  const vector<Entity>& part_of = former.state.part_of;
  bool gone = false;
  for (Entity body = 0; body < part_of.size(); ++body) gone = gone || part_of[body] != body;
  former.has_merged = gone && run.scene.simulate.contact.merge;

  former.file = file->name;
  former.sha256 = file->sha256;
  if (!run.manifest.warnings.empty()) former.doubt = run.manifest.warnings.front().text;
  return former;
}

/// The run and the state that were read last. A scene is often loaded several times.
struct LastRead {
  string folder;
  optional<FormerRun> run{};
  optional<double> at{};
  optional<FormerState> state{};
};

}  // namespace

function<FormerState(const string& folder, optional<double> at)> start_reader(const LoadOptions& options) {
  const auto last = make_shared<LastRead>();
  return [last, options](const string& folder, optional<double> at) {
    const string path = without_slash(folder);
    try {
      // One folder is read once, for any number of times.
      if (!last->run || last->folder != path) {
        *last = {path};
        last->run = opened(path, options);
      }

      if (!last->state || last->at != at) {
        last->state.reset();
        last->state = state_of(*last->run, at);
        last->at = at;
      }
      return *last->state;

      // A run that cannot be read is an error of the scene that begins with it.
    } catch (const SceneError&) {
      throw StartError("its scene.yaml has errors", fmt::format("carom check {}/scene.yaml shows them", path));
    } catch (const ForeignRow&) {
      throw StartError(fmt::format("{} has a row that is not one of its scene's", table_name), "run it again");
    } catch (const ExportError& error) {
      throw in_parts(error.what());
    }
  };
}

}  // namespace carom
