// A run's folder keeps the meshes of its scene.
#include "export/export_testing.h"
#include "files/run_folder.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

Scene scene_with_mesh(const TempFolder& temp) {
  write(temp / "pin.stl", "solid pin");
  Scene scene = small_scene();
  scene.meshes = {{temp / "pin.stl", "pin.stl"}, {temp / "other.gltf", ""}};
  write(temp / "other.gltf", "{}");
  return scene;
}

TEST(Meshes, AreCopiedIntoTheRunsFolder) {
  TempFolder temp;
  const Scene scene = scene_with_mesh(temp);
  run(scene, temp / "run");
  EXPECT_EQ(read(temp / "run/pin.stl"), "solid pin");
  EXPECT_FALSE(fs::exists(temp / "run/other.gltf"));
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::this_run);
}

TEST(Meshes, ThatHaveChangedMakeAnotherRun) {
  for (const string name : {"pin.stl", "other.gltf"}) {
    TempFolder temp;
    const Scene scene = scene_with_mesh(temp);
    run(scene, temp / "run");
    write(temp / name, "changed");
    EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::other_run) << name;
  }
}

TEST(Meshes, CopyThatWasTamperedWithMakesTheRunTouched) {
  TempFolder temp;
  const Scene scene = scene_with_mesh(temp);
  run(scene, temp / "run");
  write(temp / "run/pin.stl", "solid pin!");
  EXPECT_EQ(inspect_folder(temp / "run", scene), FolderContent::touched);
}

TEST(Meshes, OfTheRunsOwnFolderOutliveARunIntoIt) {
  TempFolder temp;
  Scene scene = scene_with_mesh(temp);
  run(scene, temp / "run");
  scene.meshes = {{temp / "run/pin.stl", "pin.stl"}};  // as `carom run run/scene.yaml -o run --force`
  run(scene, temp / "run");
  EXPECT_EQ(read(temp / "run/pin.stl"), "solid pin");
}

TEST(Meshes, DoNotStayOfARunThatDidNotFinish) {
  TempFolder temp;
  const Scene scene = scene_with_mesh(temp);
  {
    Exports exports(scene, temp / "run");
    EXPECT_TRUE(fs::exists(temp / "run/pin.stl"));
  }
  EXPECT_FALSE(fs::exists(temp / "run"));
}

TEST(Meshes, ThatAreGoneAreReportedBeforeAnythingIsTouched) {
  TempFolder temp;
  const Scene scene = scene_with_mesh(temp);
  fs::remove(temp / "pin.stl");
  try {
    Exports exports(scene, temp / "run");
    FAIL();
  } catch (const ExportError& error) {
    EXPECT_EQ(string(error.what()), "cannot read the mesh " + (temp / "pin.stl") + ": No such file or directory");
  }
  EXPECT_FALSE(fs::exists(temp / "run"));
}

}  // namespace
}  // namespace carom
