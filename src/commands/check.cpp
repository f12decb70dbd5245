// Combines the plan, the forecast of the outputs and a short trial simulation (foresight.h). A whole run would take as
// long as `run`.
#include "commands/commands.h"

#include <fmt/format.h>

#include "commands/accuracy_report.h"
#include "commands/foresight.h"
#include "commands/interrupt.h"
#include "commands/plan.h"
#include "commands/preview.h"
#include "commands/report.h"
#include "commands/scene_outcome.h"
#include "commands/sizes.h"
#include "commands/slow.h"
#include "commands/table_sizes.h"
#include "commands/text.h"
#include "commands/volumes_report.h"
#include "export/flights_file.h"
#include "export/tables.h"
#include "files/checkpoint_file.h"
#include "physics/coupled_forces.h"
#include "physics/world.h"
#include "render/moving_camera.h"
#include "scene/scene.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {

using Json = nlohmann::ordered_json;

namespace {

constexpr size_t bodies_shown = 10, crossings_shown = 10, crossings_listed = 1000;
/// By FolderContent.
constexpr array content_names = {"new",         "up to date", "incomplete", "more outputs",
                                 "earlier run", "changed",    "other run"};
constexpr double trial_budget = 0.1;  // s of wall time
constexpr const char* unknown_view = "not known: the camera frames the motion, which takes longer to simulate";

// "red, blue and gas (1,000)".
string bodies_text(const Scene& scene) {
  vector<string> names;
  const vector<BodyRange>& bodies = scene.roster.bodies;
  for (size_t i = 0; i < bodies.size();) {
    const string name(bodies[i].thing());
    const bool several = bodies[i].group || bodies[i].name != name;
    uint64_t count = 0;
    do count += bodies[i].count;
    while (++i < bodies.size() && name != bodies[i].name && bodies[i].thing() == name);
    names.push_back(several ? fmt::format("{} ({})", name, grouped(count)) : name);
  }
  const string count = counted(scene.world.body_count(), "body", "bodies");
  return names.empty() ? count : fmt::format("{}: {}", count, listed(names, bodies_shown));
}

string fixed_text(const World& world) {
  const string text = fmt::format("{}, {}", counted(world.planes.size(), "plane", "planes"),
                                  counted(world.walls.size(), "wall", "walls"));
  if (world.obstacles.empty()) return text;
  return text + ", " + counted(world.obstacles.size(), "obstacle", "obstacles");
}

string strings_text(const World& world) {
  const auto rods = size_t(ranges::count_if(world.strings, [](const String& string) { return string.rod; }));
  const size_t strings = world.strings.size() - rods;
  if (rods == 0) return counted(strings, "string", "strings");
  return strings == 0 ? counted(rods, "rod", "rods")
                      : fmt::format("{}, {}", counted(strings, "string", "strings"), counted(rods, "rod", "rods"));
}

string forces_text(const World& world) {
  const size_t on_each = world.forces.size() + world.gravitations.size();
  string text = on_each > 0 || world.springs.empty() ? counted(on_each, "force", "forces") : "";
  if (!world.springs.empty()) {
    if (!text.empty()) text += " and ";
    text += counted(world.springs.size(), "spring", "springs") + " between bodies";
  }
  return text + " in addition to gravity";
}

string regions_text(const Scene& scene) {
  vector<string> names;
  for (size_t i = 0; i < scene.world.regions.size(); ++i) {
    const WorldRegion& region = scene.world.regions[i];
    names.push_back(scene.roster.regions[i] + (region.removes ? " (remove)" : region.stops ? " (stop)" : ""));
  }
  const size_t most = 4, count = names.size();
  if (count > most) names.resize(most);
  return fmt::format("{}: {}{}", counted(count, "region", "regions"), joined(names, ", "), count > most ? ", ..." : "");
}

string engine_text(const PlannedScene& planned) {
  const Simulate& simulate = planned.scene->simulate;
  string text(name_of(planned.price.engine.engine));
  if (simulate.as_printed) text += ", as printed";
  if (!planned.price.engine.why.empty()) text += fmt::format(" ({})", planned.price.engine.why);
  return text + fmt::format(", {} of motion", quantity(simulate.duration, "s"));
}

string first_collision_text(const PlannedScene& planned, const Foresight& foresight) {
  if (!foresight.trouble.empty()) return "not known: " + foresight.trouble;
  if (!foresight.first) return fmt::format("none within {}", quantity(planned.scene->simulate.duration, "s"));
  const Collision& c = *foresight.first;
  const Roster& roster = planned.scene->roster;
  // Smaller coordinates are rounding errors.
  const double nothing = 1e-9 * planned.scene->world.radius[c.a];
  const auto shown = [&](double x) { return std::abs(x) < nothing ? 0.0 : x; };

  const bool tautens = c.kind == CollisionKind::taut;
  string text =
      fmt::format("{} and {} at {}, at ({:.4g}, {:.4g}, {:.4g}) m, {} at {}", roster.name(c.a), roster.name(c.b),
                  quantity(c.time, "s"), shown(c.position.x()), shown(c.position.y()), shown(c.position.z()),
                  tautens ? "which goes taut" : "closing", quantity(c.approach_speed, "m/s"));
  if (planned.price.engine.engine == Engine::book) text += " (exact; the book engine detects it in a later frame)";
  return text;
}

/// Whether the scene has things that may hide bodies. Planes hide nothing.
bool has_walls(const World& world) {
  return !world.walls.empty() || !world.obstacles.empty();
}

struct SceneFindings {
  Foresight foresight;
  vector<string> faded;            // things
  optional<CameraPreview> camera;  // none: the scene has neither pictures nor a camera
};

/// The things that a camera of `fit: {on: ..}` frames, or goes with.
string framed_text(const Scene& scene) {
  if (!scene.camera || scene.camera->fit_on.empty()) return "the motion";
  vector<string> names;
  for (const Entity e : scene.camera->fit_on) {
    const bool whole = scene.world.is_body(e) && scene.roster.range_of(e).group;
    const string name = whole ? scene.roster.range_of(e).name : scene.roster.name(e);
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  return listed(names, bodies_shown);
}

string followed_text(const Scene& scene) {
  const auto& follow = scene.camera->follow;
  const BodyRange& range = scene.roster.range_of(follow->first);
  return follow->count == range.count  ? range.name
         : follow->count < range.count ? scene.roster.name(follow->first)
                                       : string(range.thing());
}

/// How the camera moves; empty: it stands still.
string camera_text(const Scene& scene, const CameraPreview& camera) {
  string text;
  if (camera.kind == "path") text = counted(scene.camera->path.size(), "keyframe", "keyframes") + "; ";
  if (camera.kind == "follow") text = fmt::format("follows {}; ", followed_text(scene));
  const bool orbits = scene.camera && scene.camera->orbit > 0;
  if (camera.kind == "fit")
    text = fmt::format("frames {}{}; ", framed_text(scene), camera.moves && !orbits ? ", and moves along" : "");
  if (orbits) text += fmt::format("goes round in {}; ", quantity(scene.camera->orbit, "s"));
  return text;
}

string angles_text(const CameraPreview& camera) {
  if (camera.parallel)
    return fmt::format("parallel projection of {:.4g} x {:.4g} m", (*camera.parallel)[0], (*camera.parallel)[1]);
  return fmt::format("fields of view {:.4g} x {:.4g} degrees", camera.fov_x, camera.fov_y);
}

string plus_x_text(const string& direction) {
  if (direction == "left" || direction == "right") return fmt::format("+x points to the {} of the picture", direction);
  if (direction == "up" || direction == "down") return fmt::format("+x points {} in the picture", direction);
  return direction == "away" ? "+x points away from the eye" : "+x points toward the eye";
}

string out_of_view_text(const PlannedScene& planned, const CameraPreview& view) {
  if (!view.out_of_view) return unknown_view;
  if (view.out_of_view->empty()) return "no body at time 0";
  vector<string> names;
  for (const Entity body : *view.out_of_view) {
    if (names.size() == bodies_shown) break;
    names.push_back(planned.scene->roster.name(body));
  }
  const size_t more = view.out_of_view->size() - names.size();
  return more == 0 ? listed(names) + " at time 0"
                   : fmt::format("{} and {} more at time 0", joined(names, ", "), grouped(more));
}

// "red and blue enter at 0.3 s; red leaves at 1.2 s"
string crossings_text(const PlannedScene& planned, const SceneFindings& findings) {
  if (!findings.camera->out_of_view) return unknown_view;
  const Foresight& foresight = findings.foresight;
  const vector<ViewChange>& all = foresight.crossings;

  // A text for the bodies that enter, or leave, at one instant.
  vector<string> texts;
  size_t i = 0;
  while (i < all.size() && texts.size() < crossings_shown) {
    const ViewChange& first = all[i];
    vector<string> names;
    for (; i < all.size() && all[i].time == first.time && all[i].enters == first.enters; ++i)
      names.push_back(planned.scene->roster.name(all[i].body));
    const bool one = names.size() == 1;
    texts.push_back(fmt::format("{} {} at {}", listed(names, bodies_shown),
                                first.enters ? (one ? "enters" : "enter") : (one ? "leaves" : "leave"),
                                quantity(first.time, "s")));
  }

  if (i < all.size()) texts.push_back(fmt::format("{} more", grouped(all.size() - i)));
  string text = texts.empty() ? "no body enters or leaves the picture" : joined(texts, "; ");
  if (foresight.cut) text += fmt::format(" (checked up to {})", quantity(foresight.watched_until, "s"));
  return text;
}

// "ball is behind lane from 0.3 s to 0.8 s"
string hidings_text(const PlannedScene& planned, const SceneFindings& findings) {
  if (!findings.camera->out_of_view) return unknown_view;
  const Foresight& foresight = findings.foresight;
  const Roster& roster = planned.scene->roster;
  vector<string> texts;
  for (const Hiding& hiding : foresight.hidings) {
    if (texts.size() == crossings_shown) break;
    const string when = hiding.from < hiding.until
                            ? fmt::format("from {} to {}", quantity(hiding.from, "s"), quantity(hiding.until, "s"))
                            : "at " + quantity(hiding.from, "s");
    texts.push_back(fmt::format("{} is behind {} {}", roster.name(hiding.body), roster.name(hiding.behind), when));
  }

  const size_t more = foresight.hidings.size() - texts.size();
  if (more > 0) texts.push_back(fmt::format("{} more", grouped(more)));
  string text = texts.empty() ? "no body in the picture" : joined(texts, "; ");
  if (foresight.cut) text += fmt::format(" (checked up to {})", quantity(foresight.watched_until, "s"));
  return text;
}

string content_text(const PlannedScene& planned) {
  switch (planned.found.content) {
    case FolderContent::nothing:
      return "new";
    case FolderContent::this_run:
      return "up to date";

    case FolderContent::incomplete:
      if (const optional<Checkpoint> kept = any_checkpoint(planned.folder))
        return fmt::format("interrupted at {} of its motion: the same command goes on there",
                           quantity(kept->time, "s"));
      return "incomplete, will be run again";

    case FolderContent::earlier:
      return "holds a run of the scene as it was, will be replaced";
    case FolderContent::touched:
      return fmt::format("holds {}: run needs --force or another -o", planned.found.obstacle);
    case FolderContent::more:
      return "holds more outputs of this scene: run needs --force or another -o";
    case FolderContent::other_run:
      break;
  }

  return "holds another run, or files that no run wrote: run needs --force or another -o";
}

SceneFindings examine(const PlannedScene& planned) {
  const Scene& scene = *planned.scene;
  if (!scene.camera && !scene.output.pictures())
    return {foresee(scene, planned.price.engine, nullptr, trial_budget), {}, nullopt};
  MovingCamera camera(scene, picture_size(scene.output));
  const bool known = frame_motion(camera, trial_budget);
  vector<string> faded;
  for (const uint32_t fixed : camera.faded()) faded.push_back(scene.roster.name(scene.world.body_count() + fixed));
  return {foresee(scene, planned.price.engine, known ? &camera : nullptr, trial_budget), std::move(faded),
          preview_camera(camera, known)};
}

// Wall time of a run (s): of the part that was simulated, scaled up, and of its outputs.
optional<double> seconds_to_come(const PlannedScene& planned, const SceneFindings& findings) {
  if (!findings.foresight.simulate_s) return nullopt;
  return planned.load_s + *findings.foresight.simulate_s + planned.price.forecast.seconds;
}

/// Of all files: flights by the part that was simulated, all others by the scene.
uint64_t bytes_to_come(const PlannedScene& planned, const SceneFindings& findings) {
  if (!planned.scene->output.flights) return planned.price.forecast.bytes;
  const PiecesAhead& pieces = findings.foresight.pieces;
  const double flights = flight_bytes(pieces.of_events, pieces.of_crowd);
  return planned.price.forecast.bytes + uint64_t(min(flights, double(largest_flights)));
}

string steps_text(double steps) {
  return steps < 1e15 ? counted(uint64_t(steps), "step", "steps") : fmt::format("{:.4g} steps", steps);
}

string to_come_text(const PlannedScene& planned, const SceneFindings& findings) {
  const optional<double> seconds = seconds_to_come(planned, findings);
  const optional<double> steps = steps_of(*planned.scene);
  // How many more a film has that slows down is known with the motion.
  const auto& video = planned.scene->output.video;
  return fmt::format("{}{}{}, {}, about {} and {}", steps ? steps_text(*steps) + ", " : "",
                     video && video->slow ? "at most " : "",
                     counted(planned.price.forecast.frames, "picture", "pictures"),
                     trajectory_rows_text(planned.price.forecast.tables), bytes_text(bytes_to_come(planned, findings)),
                     !seconds         ? "an unknown time"
                     : *seconds < 0.5 ? "less than a second"
                     : *seconds < 9.5 ? fmt::format("roughly {:.0f} s", *seconds)
                                      : "roughly " + wait_text(std::round(*seconds)));
}

void describe(Block& block, const PlannedScene& planned, const SceneFindings& findings) {
  block.heading(planned.name, planned.scene->title);
  block.line("bodies", bodies_text(*planned.scene));
  block.line("fixed", fixed_text(planned.scene->world));
  if (const string volumes = volumes_text(*planned.scene); !volumes.empty()) block.line("volumes", volumes);
  if (!planned.scene->world.strings.empty()) block.line("strings", strings_text(planned.scene->world));
  if (!planned.scene->world.forces.empty() || has_couplings(planned.scene->world))
    block.line("forces", forces_text(planned.scene->world));
  if (!planned.scene->world.regions.empty()) block.line("regions", regions_text(*planned.scene));

  if (const auto& start = planned.scene->made_from.start)
    block.line("start", fmt::format("the run {} at {}, by its {}", printable(start->run), quantity(start->at, "s"),
                                    start->file));
  for (const string& note : planned.scene->made_from.notes) block.line("note", note);

  block.line("engine", engine_text(planned));
  block.line("first hit", first_collision_text(planned, findings.foresight));
  if (!findings.foresight.failure.empty()) block.line("trouble", "a run would stop: " + findings.foresight.failure);
  if (const string slow = slow_text(*planned.scene); !slow.empty()) block.line("slow", slow);
  for (const string& odd : odd_sizes(*planned.scene)) block.line("size", odd);

  if (findings.camera) {
    block.line("camera", fmt::format("{}{}; {}", camera_text(*planned.scene, *findings.camera),
                                     plus_x_text(findings.camera->plus_x), angles_text(*findings.camera)));
    block.line("unseen", out_of_view_text(planned, *findings.camera));
    if (has_walls(planned.scene->world)) block.line("hidden", hidings_text(planned, findings));
    if (!findings.faded.empty())
      block.line("faded", listed(findings.faded, bodies_shown) + ": from every side tried, what happens is behind");
    block.line("in and out", crossings_text(planned, findings));
  } else {
    block.line("camera", "none: the scene has no pictures");
  }

  block.line("to come", to_come_text(planned, findings));
  for (const string& text : large_tables(planned.price.forecast.tables, planned.scene->output, true))
    block.warning("large", text);
  block.line("folder", fmt::format("{}: {}", printable(planned.folder), content_text(planned)));
}

Json collision_json(const Scene& scene, const Collision& c) {
  return {{"time_s", c.time},
          {"kind", name_of(c.kind)},
          {"a", scene.roster.name(c.a)},
          {"b", scene.roster.name(c.b)},
          {"x_m", c.position.x()},
          {"y_m", c.position.y()},
          {"z_m", c.position.z()},
          {"approach_speed_m_per_s", c.approach_speed}};
}

Json camera_json(const Scene& scene, const SceneFindings& findings) {
  const CameraPreview& camera = *findings.camera;
  const Foresight& foresight = findings.foresight;
  Json crossings = Json::array();
  for (const ViewChange& crossing : foresight.crossings) {
    if (crossings.size() == crossings_listed) break;
    crossings.push_back(
        {{"time_s", crossing.time}, {"body", scene.roster.name(crossing.body)}, {"enters", crossing.enters}});
  }

  Json names = Json::array();
  for (const Entity body : camera.out_of_view.value_or(vector<Entity>())) {
    if (names.size() == bodies_shown) break;
    names.push_back(scene.roster.name(body));
  }

  Json hidings = Json::array();
  for (const Hiding& hiding : foresight.hidings) {
    if (hidings.size() == crossings_listed) break;
    hidings.push_back({{"body", scene.roster.name(hiding.body)},
                       {"behind", scene.roster.name(hiding.behind)},
                       {"from_s", hiding.from},
                       {"until_s", hiding.until}});
  }

  const bool parallel = scene.camera && scene.camera->orthographic;
  const double orbit = scene.camera ? scene.camera->orbit : 0;
  return {{"kind", camera.kind},
          {"projection", parallel ? "orthographic" : "perspective"},
          {"moves", camera.moves},
          {"orbit_s", orbit > 0 ? Json(orbit) : Json(nullptr)},
          {"plus_x", camera.plus_x},
          {"fov_x_degrees", camera.fov_x},
          {"fov_y_degrees", camera.fov_y},
          // What it shows.
          {"out_of_view", camera.out_of_view ? Json(camera.out_of_view->size()) : Json(nullptr)},
          {"out_of_view_names", names},
          {"watched_from_s", foresight.watched_from},
          {"watched_until_s", foresight.watched_until},
          {"watched_every_s", foresight.every},
          {"crossings", foresight.crossings.size()},
          {"crossings_listed", crossings},
          {"hidings", foresight.hidings.size()},
          {"hidings_listed", hidings},
          {"faded", findings.faded}};
}

Json as_json(const PlannedScene& planned, const SceneFindings& findings) {
  const Scene& scene = *planned.scene;
  Json entry = {{"scene", planned.file},
                {"status", "right"},
                {"title", scene.title},
                {"bodies", scene.world.body_count()},
                {"planes", scene.world.planes.size()},
                {"walls", scene.world.walls.size()},
                {"obstacles", scene.world.obstacles.size()},
                {"strings", scene.world.strings.size()},
                {"regions", scene.roster.regions},
                {"forces", scene.world.forces.size() + scene.world.springs.size() + scene.world.gravitations.size()},
                // How it moves.
                {"engine", string(name_of(planned.price.engine.engine))},
                {"why", planned.price.engine.why},
                {"duration_s", scene.simulate.duration}};

  const auto& start = scene.made_from.start;
  if (start) entry["start"] = {{"run", start->run}, {"at_s", start->at}, {"file", start->file}};
  if (start || !scene.made_from.notes.empty()) entry["notes"] = scene.made_from.notes;

  entry["volumes"] = volumes_json(scene);
  entry["first_collision"] =
      findings.foresight.first ? collision_json(scene, *findings.foresight.first) : Json(nullptr);
  if (!findings.foresight.trouble.empty()) entry["first_collision_trouble"] = findings.foresight.trouble;
  if (!findings.foresight.failure.empty()) entry["failure"] = findings.foresight.failure;
  if (const string slow = slow_text(scene); !slow.empty()) entry["slow"] = slow;
  if (const vector<string> odd = odd_sizes(scene); !odd.empty()) entry["odd_sizes"] = odd;

  entry["camera"] = findings.camera ? camera_json(scene, findings) : Json(nullptr);

  // What is to come.
  const optional<double> steps = steps_of(scene);
  entry["steps"] = steps ? Json(*steps) : Json(nullptr);
  entry["pictures"] = planned.price.forecast.frames;
  const vector<TableSize>& tables = planned.price.forecast.tables;
  const TableSize* const trajectory = find_size(tables, "trajectory");
  entry["trajectory_rows"] = trajectory == nullptr ? 0 : trajectory->rows;
  entry["tables"] = sizes_json(tables);
  entry["bytes"] = bytes_to_come(planned, findings);
  const optional<double> seconds = seconds_to_come(planned, findings);
  entry["seconds"] = seconds ? Json(*seconds) : Json(nullptr);
  entry["folder"] = planned.folder;
  entry["content"] = content_names[size_t(planned.found.content)];
  return entry;
}

int check_scenes(const Options& options) {
  const vector<PlannedScene> scenes = plan_scenes(options);
  Json entries = Json::array();
  for (const PlannedScene& planned : scenes) {
    if (planned.errors > 0) {
      flush_out();
      write_err(planned.error);
      entries.push_back(wrong_scene(planned).entry);
      continue;
    }
    if (options.quiet) continue;

    const SceneFindings findings = examine(planned);
    AccuracyReport accuracy;
    if (options.accuracy) accuracy = report_accuracy(*planned.scene, planned.price.engine);
    if (options.json) {
      entries.push_back(as_json(planned, findings));
      if (options.accuracy) entries.back()["accuracy"] = accuracy.json;
    } else {
      Block block(options);
      describe(block, planned, findings);
      for (const auto& [label, text] : accuracy.lines) block.line(label, text);
      write_out(block.text());
    }
  }

  const string errors = error_count(scenes);
  print_end(options, 0, std::move(entries));
  if (errors.empty()) return 0;
  flush_out();
  complain(options, errors);
  return 2;
}

}  // namespace

const Command check_command = {
    "check",
    check_scenes,
    "shows what a run would do and every error of its scene, and writes nothing",
    "  carom check scenes/two_bowling_balls.yaml\n"
    "  carom check scenes/*.yaml -q                          only errors\n"
    "  carom check scene.yaml --set simulate.duration=60     how long would 60 s take?\n",
    "Exit codes: 0 all scenes are valid, 2 the command line or a scene is wrong, or its outputs need what\n"
    "this machine lacks.",
    {{"--output"}, {"--set"}, {"--only"}, {"--seed"}, {"--accuracy"}, {"--force", "lift the budget"}}};

}  // namespace carom
