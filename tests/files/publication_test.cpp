// Files get their names all together: a folder that was left in the middle of it is finished when it is opened next.
#include "files/publication.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "export/export_testing.h"
#include "files/folder_names.h"
#include "files/folder_writer.h"
#include "files/manifest.h"
#include "files/run_folder.h"
#include "files/stored_file.h"
#include "scene/scene.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;
using Names = vector<string>;

Scene scene_with_frames(const string& title, int fps) {
  Scene scene = small_scene();
  scene.resolved = "scene: 1\ntitle: " + title + "\n";
  scene.output.collisions = true;
  scene.output.frames = FramesOutput{static_cast<double>(fps), {32, 18}, 1, 0, {}};
  return scene;
}

/// Every file beneath a folder: its bytes.
map<string, string> bytes_in(const string& folder) {
  map<string, string> bytes;
  for (const string& name : names_in(folder))
    if (fs::is_regular_file(folder + "/" + name)) bytes[name] = read(folder + "/" + name);
  return bytes;
}

/// The folder `to` as it is when a publication was committed: all of the former run, and the next one's parts.
void commit(const string& former, const string& next, const string& to) {
  fs::copy(former, to, fs::copy_options::recursive);
  for (const string name : {"collisions.csv", "scene.yaml", "summary.csv"})
    fs::copy(next + "/" + name, to + "/" + part_name(name));
  fs::copy(next + "/frames", to + "/.frames.part", fs::copy_options::recursive);
  fs::copy(next + "/manifest.json", to + "/" + next_manifest);
}

TEST(Publication, FromEveryMomentOfItTheNextStateIsReached) {
  TempFolder temp;
  run(scene_with_frames("Former", 20), temp / "former");
  run(scene_with_frames("Next", 10), temp / "next");
  const auto wanted = bytes_in(temp / "next");

  // Each step that a publication makes, one after the other; the rest is settled after each.
  const vector<function<void(const string&)>> steps = {
      [](const string& at) { fs::rename(at + "/.collisions.csv.part", at + "/collisions.csv"); },
      [](const string& at) { fs::rename(at + "/.frames.part/frame_00000.png", at + "/frames/frame_00000.png"); },
      [](const string& at) {
        fs::rename(at + "/.frames.part/frame_00001.png", at + "/frames/frame_00001.png");
        fs::rename(at + "/.frames.part/frame_00002.png", at + "/frames/frame_00002.png");
      },
      [](const string& at) { fs::rename(at + "/.scene.yaml.part", at + "/scene.yaml"); },
      [](const string& at) { fs::rename(at + "/.summary.csv.part", at + "/summary.csv"); },
      [](const string& at) { fs::remove(at + "/frames/frame_00004.png"); },
      [](const string& at) { fs::remove(at + "/.frames.part"); },
  };

  for (size_t made = 0; made <= steps.size(); ++made) {
    const string at = temp / to_string(made);
    commit(temp / "former", temp / "next", at);
    for (size_t k = 0; k < made; ++k) steps[k](at);
    settle_folder(at);
    EXPECT_EQ(bytes_in(at), wanted) << made;
    EXPECT_EQ(names_in(at), names_in(temp / "next")) << made;
  }
}

TEST(Publication, BeforeTheCommitNothingIsChanged) {
  TempFolder temp;
  run(scene_with_frames("Former", 20), temp / "former");
  run(scene_with_frames("Next", 10), temp / "next");
  commit(temp / "former", temp / "next", temp / "run");
  fs::rename(temp / "run/" + string(next_manifest), temp / "run/.manifest.json.part");
  const auto before = bytes_in(temp / "run");
  settle_folder(temp / "run");
  EXPECT_EQ(bytes_in(temp / "run"), before);
  EXPECT_EQ(inspect_folder(temp / "run", scene_with_frames("Former", 20)), FolderContent::this_run);
}

TEST(Publication, AFolderThatIsBeingWrittenIsLeftAsItIs) {
  TempFolder temp;
  run(scene_with_frames("Former", 20), temp / "former");
  run(scene_with_frames("Next", 10), temp / "next");
  commit(temp / "former", temp / "next", temp / "run");
  const auto before = bytes_in(temp / "run");
  const Descriptor other = open_folder(AT_FDCWD, temp / "run", true);
  ASSERT_TRUE(lock_folder({other.get(), "run"}, LockKind::alone));
  settle_folder(temp / "run");
  EXPECT_EQ(bytes_in(temp / "run"), before);
}

TEST(Publication, WhatStandsInTheWayIsNamedAndOnceItIsGoneTheNextCommandGoesOn) {
  TempFolder temp;
  run(scene_with_frames("Former", 20), temp / "former");
  run(scene_with_frames("Next", 10), temp / "next");
  commit(temp / "former", temp / "next", temp / "run");

  fs::remove(temp / "run/summary.csv");
  fs::create_directories(temp / "run/summary.csv/x");
  const string message =
      "cannot write " + (temp / "run/summary.csv") + ": a folder of that name stands there; remove it";
  EXPECT_EQ(error_of([&] { settle_folder(temp / "run"); }), message);
  EXPECT_EQ(error_of([&] { settle_folder(temp / "run"); }), message);

  fs::remove_all(temp / "run/summary.csv");
  settle_folder(temp / "run");
  EXPECT_EQ(bytes_in(temp / "run"), bytes_in(temp / "next"));
}

TEST(Folder, AFolderInAFilesPlaceIsNamedBeforeAnythingIsTouched) {
  TempFolder temp;
  Scene scene = scene_with_frames("Former", 20);
  run(scene, temp / "run");
  scene.output.energy = EnergyOutput{0.1};
  fs::create_directories(temp / "run/energy.csv/x");
  const auto before = bytes_in(temp / "run");
  EXPECT_EQ(error_of([&] { run(scene, temp / "run"); }),
            "cannot write " + (temp / "run/energy.csv") + ": a folder of that name stands there; remove it");
  EXPECT_EQ(bytes_in(temp / "run"), before);
}

TEST(Folder, ALoopOfLinksIsNoMissingFolder) {
  TempFolder temp;
  ASSERT_EQ(symlink("loop", (temp / "loop").c_str()), 0);
  const string reason = ": Too many levels of symbolic links";
  EXPECT_EQ(error_of([&] { open_folder(AT_FDCWD, temp / "loop", true); }), "cannot open " + (temp / "loop") + reason);
  EXPECT_EQ(error_of([&] { what_stands(temp / "loop"); }), "cannot look at " + (temp / "loop") + reason);
  EXPECT_EQ(error_of([&] { inspect_folder(temp / "loop", small_scene()); }), "cannot open " + (temp / "loop") + reason);
  EXPECT_FALSE(open_folder(AT_FDCWD, temp / "missing", true));
  EXPECT_EQ(what_stands(temp / "missing"), Standing::nothing);
}

/// Calls `action` when no file can be opened any more.
string without_descriptors(const function<void()>& action) {
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{0, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  const string error = error_of(action);
  setrlimit(RLIMIT_NOFILE, &before);
  return error;
}

TEST(Folder, AFileThatCannotBeOpenedIsNoMissingFile) {
  NOT_WITH_SANITIZERS();
  TempFolder temp;
  run(small_scene(), temp / "run");
  const Descriptor folder = open_folder(AT_FDCWD, temp / "run", true);
  const string reason = ": Too many open files";
  EXPECT_EQ(without_descriptors([&] { read_manifest(folder.get(), manifest_name); }),
            "cannot read " + (temp / "run/manifest.json") + reason);
  EXPECT_EQ(without_descriptors([&] { read_record(folder.get(), "scene.yaml"); }),
            "cannot read " + (temp / "run/scene.yaml") + reason);
  EXPECT_EQ(without_descriptors([&] { folder_names(folder.get()); }), "cannot read " + (temp / "run") + reason);
  EXPECT_EQ(without_descriptors([&] { inspect_folder(temp / "run", small_scene()); }),
            "cannot open " + (temp / "run") + reason);
}

}  // namespace
}  // namespace carom
