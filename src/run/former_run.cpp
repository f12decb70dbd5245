// Accepts a run only if its manifest, its scene and its files (except those to be drawn anew) agree by hash, so that a
// changed folder is never rendered.
#include "run/former_run.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "export/flights_file.h"
#include "files/folder_writer.h"
#include "files/hash.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "files/stored_table.h"
#include "run/replay.h"
#include "run/stored_trajectory.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "std.h"
#include "version.h"
#include "yaml/value_json.h"

namespace carom {

namespace {

[[noreturn]] void refuse(const string& reason, const string& remedy) {
  throw ExportError(fmt::format("{}\n  {}", reason, remedy));
}

[[noreturn]] void refuse_until_rerun(const string& folder, const string& reason) {
  refuse(reason, run_again(folder));
}

/// The names of outputs in its manifest.
vector<string> output_names_of(const Manifest& manifest) {
  vector<string> names;
  const auto json = json_of_text(manifest.outputs);
  if (json.is_object())
    for (const auto& [name, settings] : json.items()) names.push_back(name);
  return names;
}

}  // namespace

string former_scene_file(const string& folder) {
  const Standing stands = what_stands(folder);
  if (stands == Standing::nothing) refuse("there is no such folder", "name the folder of a run");
  if (stands == Standing::other) refuse("it is not a folder", "name the folder of a run, which has a manifest.json");
  const string file = (std::filesystem::path(folder) / "scene.yaml").string();
  const bool has_scene = what_stands(file) != Standing::nothing;
  if (!has_scene && what_stands((std::filesystem::path(folder) / "runs").string()) == Standing::folder)
    refuse("it holds many runs", fmt::format("name one of them or more: {}/runs/r0001", folder));
  if (what_stands((std::filesystem::path(folder) / manifest_name).string()) == Standing::nothing)
    refuse("it holds no whole run: there is no manifest.json",
           has_scene ? fmt::format("carom run {} -o {} finishes it", file, folder) : "name the folder of a run");
  return file;
}

FormerRun read_former_run(const string& folder, SceneFile& file, const SparedFile& spared) {
  FormerRun run;
  run.folder = folder;
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  const auto manifest = opened ? read_manifest(opened.get(), manifest_name) : nullopt;
  if (!manifest) refuse_until_rerun(folder, "its manifest.json is damaged, or not written by carom");
  run.manifest = *manifest;

  if (manifest->version != program_version)
    refuse_until_rerun(
        folder, fmt::format("it is a run of carom {}, and this is carom {}", manifest->version, program_version));

  // Its scene, with the outputs that it has.
  run.scene = file.scene();
  run.in_table = bodies_in_table(run.scene);
  if (sha256(run.scene.resolved) != manifest->scene_sha256)
    refuse_until_rerun(folder, "its scene.yaml is not the one that was run");
  run.scene.output = restricted(run.scene.output, output_names_of(*manifest));
  if (outputs_text(run.scene.output) != manifest->outputs)
    refuse("it holds no run", "name a folder that carom run has written");

  if (const string wrong = wrong_file(opened.get(), *manifest, [&](string_view name) { return spared(run, name); });
      !wrong.empty())
    refuse_until_rerun(folder, fmt::format("{} is missing or has changed", wrong));
  run.scene.file = manifest->scene_file;
  return run;
}

const FileRecord* FormerRun::find(string_view name) const {
  const string packed = string(name) + string(gzip_ending);
  const auto found =
      ranges::find_if(manifest.files, [&](const FileRecord& file) { return file.name == name || file.name == packed; });
  return found == manifest.files.end() ? nullptr : &*found;
}

bool FormerRun::has_flights() const {
  return has(flights_name);
}

double FormerRun::read_end_time() const {
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  Descriptor file = opened ? open_stored(opened.get(), "summary.csv") : Descriptor();
  if (!file) throw ExportError(fmt::format("{}/summary.csv is missing", folder));
  StoredTable table(std::move(file));
  const optional<size_t> column = table.find("duration_s");
  const optional<double> time = table.next() != nullptr ? number_in(table.cell(column)) : nullopt;
  if (!time) throw ExportError(fmt::format("{}/summary.csv has no duration_s", folder));
  return *time;
}

bool FormerRun::has_flights_with_collisions(const Scene& drawn) const {
  if (!has_flights()) return false;
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  const FlightsReader reader(opened.get(), folder, drawn);
  return reader.has_collisions() && (reader.has_impulses() || !sounds(drawn));
}

unique_ptr<Simulator> FormerRun::replay(const Scene& drawn) const {
  const Descriptor opened = open_folder(AT_FDCWD, folder, true);
  return replay_from(make_unique<FlightsReader>(opened.get(), folder, drawn), drawn.world);
}

}  // namespace carom
