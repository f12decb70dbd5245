// A run's folder before, during and after a run: whole files or none, no foreign files changed, nothing outside.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "export/export_testing.h"
#include "files/csv.h"
#include "files/failed_run.h"
#include "files/folder_writer.h"
#include "files/hash.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "scene/scene.h"
#include "std.h"
#include "version.h"

namespace carom {
namespace {

using namespace testing_export;
using Names = vector<string>;

Scene scene_with_tables() {
  Scene scene = small_scene();
  scene.output.trajectory = TrajectoryOutput{0.1, false};
  scene.output.collisions = true;
  scene.output.energy = EnergyOutput{0.1};
  return scene;
}

Scene scene_with_frames() {
  Scene scene = small_scene();
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0, {}};
  return scene;
}

TEST(Exports, OnlyWhatWasRequestedIsWritten) {
  TempFolder temp;
  Scene scene = small_scene();
  run(scene, temp / "none");
  EXPECT_EQ(names_in(temp / "none"), (Names{"manifest.json", "scene.yaml", "summary.csv"}));
  scene.output.collisions = true;
  run(scene, temp / "collisions");
  EXPECT_EQ(names_in(temp / "collisions"), (Names{"collisions.csv", "manifest.json", "scene.yaml", "summary.csv"}));
  run(scene_with_tables(), temp / "tables");
  EXPECT_EQ(names_in(temp / "tables"),
            (Names{"collisions.csv", "energy.csv", "manifest.json", "scene.yaml", "summary.csv", "trajectory.csv"}));
}

TEST(Exports, TheResolvedSceneIsKeptToTheByte) {
  TempFolder temp;
  run(small_scene(), temp / "run");
  EXPECT_EQ(read(temp / "run/scene.yaml"), "scene: 1\ntitle: Small\n");
}

TEST(Folder, HasTheLastNameOfItsPath) {
  const fs::path here = fs::current_path();
  EXPECT_EQ(name_of_folder("half"), "half");
  EXPECT_EQ(name_of_folder("output/half/"), "half");
  EXPECT_EQ(name_of_folder("output/half//"), "half");
  EXPECT_EQ(name_of_folder("output/./other/../half/."), "half");
  EXPECT_EQ(name_of_folder("."), here.filename());
  EXPECT_EQ(name_of_folder("./"), here.filename());
  EXPECT_EQ(name_of_folder(".."), here.parent_path().filename());
  EXPECT_EQ(name_of_folder("../"), here.parent_path().filename());
}

TEST(Exports, StateIsNeededOnlyWhenAnOutputIsDue) {
  TempFolder temp;
  Scene scene = small_scene();
  Exports nothing(scene, temp / "nothing");
  ASSERT_TRUE(nothing.tables().timeline().advance());
  EXPECT_FALSE(nothing.tables().needs_state());
  EXPECT_FALSE(nothing.draws());

  scene.output.energy = EnergyOutput{0.15};
  Exports energy(scene, temp / "energy");
  Timeline& timeline = energy.tables().timeline();
  for (const double due : {0.0, 0.15, 0.2}) {
    ASSERT_TRUE(timeline.advance());
    EXPECT_EQ(timeline.time(), due);
    EXPECT_TRUE(energy.tables().needs_state());
  }

  EXPECT_FALSE(timeline.advance());
}

TEST(Exports, FoldersAreMadeWithTheirParents) {
  TempFolder temp;
  run(small_scene(), temp / "a/b/c/");
  EXPECT_TRUE(fs::exists(temp / "a/b/c/manifest.json"));
}

TEST(Exports, NothingStaysOfARunThatDidNotFinish) {
  TempFolder temp;
  {
    const Scene scene = scene_with_tables();
    Exports exports(scene, temp / "run");
    play(scene, exports);
    EXPECT_EQ(names_in(temp / "run"),
              (Names{".collisions.csv.part", ".energy.csv.part", ".trajectory.csv.part", "scene.yaml"}));
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  }
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(Exports, FramesThatWereWholeStayWhenTheRunFails) {
  TempFolder temp;
  const Scene scene = scene_with_frames();
  {
    Exports exports(scene, temp / "run");
    exports.begin_drawings();
    exports.drawings().timeline().advance();
    exports.picture(0, picture({32, 18}, 0));
  }
  EXPECT_EQ(names_in(temp / "run"), (Names{"frames", "frames/frame_00000.png", "scene.yaml"}));
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  run(scene, temp / "run");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
}

TEST(Exports, TwoRunsDoNotWriteIntoOneFolder) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  Exports first(scene, temp / "run");
  EXPECT_EQ(
      error_of([&] { Exports second(scene, temp / "run"); }),
      "cannot write " + temp / "run" + ": another run is writing into it; wait for it, or name another folder with -o");
  play(scene, first);
  first.finish(some_summary(scene), {});
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
}

TEST(Exports, AFileInTheFoldersPlaceIsAClearError) {
  TempFolder temp;
  write(temp / "file", "x");
  const Scene scene = small_scene();
  EXPECT_EQ(inspect_folder(temp / "file", scene), FolderContent::other_run);
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "file"); }),
            "cannot open " + temp / "file" + ": Not a directory");
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "file/sub"); }),
            "cannot make " + temp / "file" + ": Not a directory");
}

TEST(Manifest, NamesEveryFileWithItsSizeAndHash) {
  TempFolder temp;
  Scene scene = scene_with_tables();
  scene.title = "Two \"balls\" \xff";
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0, {}};
  scene.output.sheet = SheetOutput{2, 1};
  run(scene, temp / "run");

  const auto manifest = nlohmann::json::parse(read(temp / "run/manifest.json"));
  EXPECT_EQ(manifest["tool"], "carom");
  EXPECT_EQ(manifest["version"], program_version);
  EXPECT_EQ(manifest["scene"]["file"], "small.yaml");
  EXPECT_EQ(manifest["scene"]["title"], "Two \"balls\" \xEF\xBF\xBD");
  EXPECT_EQ(manifest["scene"]["sha256"], sha256(scene.resolved));
  EXPECT_EQ(manifest["counts"]["frames"], 3);

  Names names;
  for (const auto& file : manifest["files"]) {
    const string text = read(temp / "run/" + file["name"].get<string>());
    names.push_back(file["name"]);
    EXPECT_EQ(file["bytes"], text.size()) << file["name"];
    EXPECT_EQ(file["sha256"], sha256(text)) << file["name"];
  }

  ranges::sort(names);
  EXPECT_EQ(names, (Names{"collisions.csv", "energy.csv", "frames/frame_00000.png", "frames/frame_00001.png",
                          "frames/frame_00002.png", "scene.yaml", "sheet.png", "summary.csv", "trajectory.csv"}));
}

TEST(Manifest, HashesAreSha256) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Manifest, OnlyNamesThatARunWritesAreAccepted) {
  for (const char* name :
       {"trajectory.csv", "my film.mp4", "x.gif", "x.webp", "frames/frame_00000.png", "frames/frame_123456.png"})
    EXPECT_TRUE(is_run_file(name)) << name;
  for (const char* name :
       {"", ".", "..", ".hidden", "../x", "/etc/passwd", "a/b", "frames/x.png", "frames/../x", "frames/frame_0000.png",
        "frames/frame_0000x.png", "frames/frame_00000.png/x", "a\nb", "a\\b"})
    EXPECT_FALSE(is_run_file(name)) << name;
  EXPECT_FALSE(is_run_file(string(201, 'a')));
}

TEST(Folder, WhatIsNotThereOrEmptyIsNothing) {
  TempFolder temp;
  EXPECT_EQ(inspect_folder(temp / "run", small_scene()), FolderContent::nothing);
  fs::create_directory(temp / "run");
  EXPECT_EQ(inspect_folder(temp / "run", small_scene()), FolderContent::nothing);
}

TEST(Folder, ACompleteRunIsRecognised) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  run(scene, temp / "run");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
  EXPECT_EQ(inspect_folder(temp / "run/", scene), FolderContent::this_run);
}

TEST(Folder, OtherOutputsOfTheSameSceneAreNotThisRun) {
  TempFolder temp;
  Scene scene = scene_with_tables();
  run(scene, temp / "run");
  scene.output.energy.reset();  // as --only trajectory,collisions does
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::more);
  run(scene, temp / "run");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
  EXPECT_FALSE(fs::exists(temp / "run/energy.csv"));  // the former run's
}

TEST(Folder, AnotherSceneIsAnotherRun) {
  TempFolder temp;
  Scene scene = small_scene();
  run(scene, temp / "run");
  scene.resolved += "seed: 1\n";
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::other_run);
}

TEST(Folder, ForeignFilesAreAnotherRun) {
  TempFolder temp;
  const Scene scene = small_scene();
  write(temp / "a/thesis.tex", "x");
  EXPECT_EQ(inspect_folder(temp / "a", scene), FolderContent::other_run);

  write(temp / "b/manifest.json", "{\"tool\": \"another\"}");
  EXPECT_EQ(inspect_folder(temp / "b", scene), FolderContent::other_run);

  write(temp / "c/manifest.json", "{\"tool\": \"carom\", ");
  EXPECT_EQ(inspect_folder(temp / "c", scene), FolderContent::other_run);
  write(temp / "d/manifest.json", string(1 << 20, '['));
  EXPECT_EQ(inspect_folder(temp / "d", scene), FolderContent::other_run);

  write(temp / "e/scene.yaml", "scene: 1\n");
  EXPECT_EQ(inspect_folder(temp / "e", scene), FolderContent::other_run);

  run(scene, temp / "a");  // as --force does: files that are not a run's stay
  EXPECT_EQ(read(temp / "a/thesis.tex"), "x");
}

TEST(Folder, AChangedFileMakesItTouchedAndALostOneIncomplete) {
  const Scene scene = scene_with_frames();
  for (const string name : {"summary.csv", "scene.yaml", "frames/frame_00001.png"}) {
    TempFolder temp;
    const string file = temp / "run/" + name;
    run(scene, temp / "run");
    const string text = read(file);

    string changed = text;
    changed[changed.size() / 2] ^= 1;  // one bit, the same size
    write(file, changed);
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::touched) << name;

    write(file, text.substr(1));
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::touched) << name;
    write(file, text);
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run) << name;

    fs::remove(file);
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete) << name;
  }
}

TEST(Folder, AManifestThatLeavesAFileOutIsNotWhole) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  run(scene, temp / "run");

  auto manifest = nlohmann::json::parse(read(temp / "run/manifest.json"));
  auto& files = manifest["files"];
  for (auto it = files.begin(); it != files.end(); ++it)
    if ((*it)["name"] == "energy.csv") {
      files.erase(it);
      break;
    }
  write(temp / "run/manifest.json", manifest.dump());

  FolderChanges changes;
  EXPECT_EQ(inspect_folder(temp / "run", scene, &changes), FolderContent::touched);
  EXPECT_EQ(changes.foreign, "energy.csv");
  fs::remove(temp / "run/energy.csv");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
}

TEST(Folder, AnotherVersionOfTheToolRunsAgain) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  run(scene, temp / "run");
  auto manifest = nlohmann::json::parse(read(temp / "run/manifest.json"));
  manifest["version"] = "0.0.0";
  write(temp / "run/manifest.json", manifest.dump());
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
}

TEST(Folder, AFormerRunsFilesAreRemovedByItsManifest) {
  TempFolder temp;
  Scene scene = scene_with_frames();
  run(scene, temp / "run");
  write(temp / "run/notes.txt", "mine");
  scene.resolved += "seed: 1\n";
  scene.output.frames.reset();
  scene.output.collisions = true;
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"),
            (Names{"collisions.csv", "manifest.json", "notes.txt", "scene.yaml", "summary.csv"}));
}

TEST(Folder, AnInterruptedRunsFilesAreRemovedWithoutAManifest) {
  TempFolder temp;
  const Scene scene = small_scene();
  write(temp / "run/scene.yaml", scene.resolved);
  for (const char* name :
       {"energy.csv", ".trajectory.csv.part", "frames/frame_00007.png", "frames/.frame_00008.png.part"})
    write(temp / "run/" + name, "old");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"), (Names{"manifest.json", "scene.yaml", "summary.csv"}));
}

TEST(Folder, ARemovalThatWasInterruptedGoesOn) {
  TempFolder temp;
  Scene scene = scene_with_tables();
  scene.output.frames = FramesOutput{10, {32, 18}, 1, 0, {}};
  run(scene, temp / "run");
  // A run with other outputs was killed when the manifest was put aside and scene.yaml was its own.
  fs::rename(temp / "run/manifest.json", temp / "run/.manifest.json.former");
  scene.resolved += "seed: 1\n";
  write(temp / "run/scene.yaml", scene.resolved);
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  scene.output = {};
  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"), (Names{"manifest.json", "scene.yaml", "summary.csv"}));
}

TEST(Folder, AHostileManifestRemovesNothingOutside) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  run(scene, temp / "run");
  const string whole = read(temp / "run/manifest.json");
  for (const string name : {"../victim", "/tmp/carom_victim", "frames/../../victim", "..", "sub/victim"}) {
    write(temp / "victim", "mine");
    write(temp / "run/sub/victim", "mine");
    auto manifest = nlohmann::json::parse(whole);
    manifest["files"].push_back({{"name", name}, {"bytes", 4}, {"sha256", sha256("mine")}});
    write(temp / "run/manifest.json", manifest.dump());
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::other_run) << name;

    run(scene, temp / "run");
    EXPECT_EQ(read(temp / "victim"), "mine") << name;
    EXPECT_EQ(read(temp / "run/sub/victim"), "mine") << name;
  }
}

TEST(Folder, LinksAreNotFollowedOut) {
  TempFolder temp;
  const Scene scene = scene_with_frames();
  write(temp / "victim", "mine");
  write(temp / "outside/frame_00000.png", "mine");
  // Links in the place of files that the run writes, whole and in part.
  fs::create_directory(temp / "run");
  for (const char* name : {"summary.csv", ".summary.csv.part", "scene.yaml", ".scene.yaml.part", "manifest.json"})
    fs::create_symlink("../victim", temp / "run/" + name);
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::other_run);
  run(scene, temp / "run");
  EXPECT_EQ(read(temp / "victim"), "mine");
  EXPECT_FALSE(fs::is_symlink(temp / "run/summary.csv"));
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
  // A link in the place of the folder of frames.
  fs::remove_all(temp / "run/frames");
  fs::create_symlink("../outside", temp / "run/frames");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  EXPECT_EQ(error_of([&] { Exports exports(scene, temp / "run"); }),
            "cannot open " + temp / "run" + "/frames: it is not a folder, or a link; remove it");
  EXPECT_EQ(read(temp / "outside/frame_00000.png"), "mine");
  // The run's folder itself may be a link: its owner chose the place.
  fs::create_directory(temp / "elsewhere");
  fs::create_symlink("elsewhere", temp / "link");
  run(scene, temp / "link");
  EXPECT_TRUE(fs::exists(temp / "elsewhere/manifest.json"));
  EXPECT_EQ(inspect_folder(temp / "link", scene), FolderContent::this_run);
}

TEST(Folder, ANamedPipeInAFilesPlaceDoesNotBlock) {
  TempFolder temp;
  const Scene scene = small_scene();
  run(scene, temp / "run");
  fs::remove(temp / "run/summary.csv");
  ASSERT_EQ(mkfifo((temp / "run/summary.csv").c_str(), 0600), 0);
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::incomplete);
  fs::remove(temp / "run/manifest.json");
  ASSERT_EQ(mkfifo((temp / "run/manifest.json").c_str(), 0600), 0);
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::other_run);
  run(scene, temp / "run");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
}

TEST(OutputFile, ANameThatLeadsElsewhereIsRefused) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY));
  for (const string name : {"../x", "a/b", "/x", ".", "..", "", ".x"})
    EXPECT_THROW(OutputFile(FilePlace{folder.get(), temp.path()}, name), ExportError) << name;
  EXPECT_EQ(names_in(temp.path()), Names{});
}

TEST(OutputFile, AnySizeArrivesWhole) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY));
  for (const size_t size : {0u, 1u, 262143u, 262144u, 262145u, 1000000u}) {
    string text;
    for (size_t i = 0; i < size; ++i) text += static_cast<char>(i * i % 251);

    OutputFile file({folder.get(), temp.path()}, "file");
    file.write(string_view(text).substr(0, size / 3));
    file.written(put_text(file.room(size - size / 3), string_view(text).substr(size / 3)));
    EXPECT_FALSE(fs::exists(temp / "file") && size == 0);
    file.publish();

    EXPECT_EQ(read(temp / "file"), text);
    EXPECT_EQ(file.record().bytes, size);
    EXPECT_EQ(file.record().sha256, sha256(text));
  }
}

/// Runs `action` in a child process; gives its wait status.
int in_child(const function<void()>& action) {
  const pid_t child = fork();
  if (child == 0) {
    action();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(OutputFile, AFullDiskIsReported) {
  TempFolder temp;
  const Scene scene = scene_with_tables();
  // The system refuses to let a file grow: the same path through the code as a disk without room.
  const int status = in_child([&] {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100, 100};
    setrlimit(RLIMIT_FSIZE, &limit);
    const string error = error_of([&] { run(scene, temp / "run"); });
    _exit(error == "cannot write " + temp / "run/summary.csv" + ": File too large" ? 0 : 1);
  });
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(OutputFile, KilledAtAnyMomentNoFinalFileIsIncomplete) {
  TempFolder temp;
  Scene scene = scene_with_tables();
  scene.output.frames = FramesOutput{100, {64, 36}, 1, 0, {}};
  run(scene, temp / "whole");

  vector<pair<string, string>> expected;
  for (const string& name : names_in(temp / "whole"))
    if (fs::is_regular_file(temp / "whole/" + name)) expected.emplace_back(name, read(temp / "whole/" + name));

  for (int i = 0; i < 40; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      for (;;) run(scene, temp / "run");
    }
    usleep(static_cast<useconds_t>(500 + i * 397));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);

    for (const auto& [name, text] : expected) {
      if (!fs::exists(temp / "run/" + name)) continue;
      ASSERT_EQ(read(temp / "run/" + name), text) << name << " after " << i;
    }
    const FolderContent content = inspect_folder(temp / "run", scene);
    ASSERT_NE(content, FolderContent::other_run) << i;
  }

  run(scene, temp / "run");
  EXPECT_EQ(names_in(temp / "run"), names_in(temp / "whole"));
}

TEST(FailedRun, LeavesItsReasonAloneAndCountsAsIncomplete) {
  TempFolder temp;
  run(scene_with_tables(), temp / "whole");
  store_failure(temp / "whole", "no luck");
  EXPECT_EQ(names_in(temp / "whole"), Names{"error.txt"});
  EXPECT_EQ(stored_failure(temp / "whole"), "no luck");
  EXPECT_EQ(inspect_folder(temp / "whole", small_scene()), FolderContent::incomplete);
  // One that was killed: pictures that no manifest names.
  run(scene_with_frames(), temp / "killed");
  fs::remove(temp / "killed/manifest.json");
  store_failure(temp / "killed", "no luck");
  EXPECT_EQ(names_in(temp / "killed"), Names{"error.txt"});
  run(small_scene(), temp / "killed");
  EXPECT_EQ(names_in(temp / "killed"), (Names{"manifest.json", "scene.yaml", "summary.csv"}));
}

}  // namespace
}  // namespace carom
