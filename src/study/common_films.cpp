// The runs' own paths are drawn where they are stored. Otherwise the motion is simulated again.
#include "study/common_films.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <deque>

#include "compare/stored_measures.h"
#include "engine/engine.h"
#include "files/folder_names.h"
#include "files/folders.h"
#include "overlay/history.h"
#include "render/common_view.h"
#include "render/moving_camera.h"
#include "run/former_run.h"
#include "run/run_scene.h"
#include "run/survey.h"
#include "scene/film_layout.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {
namespace {

/// A run whose film is drawn again.
struct Redrawn {
  FormerRun former{};
  Scene scene;
};

/// Null: its manifest is damaged.
optional<Redrawn> redrawn(const FilmTile& tile) {
  const Descriptor folder = open_folder(AT_FDCWD, tile.folder, true);
  optional<Manifest> manifest = folder ? read_manifest(folder.get(), manifest_name) : nullopt;
  if (!manifest) return nullopt;
  Redrawn run{{}, load_run_scene(tile.folder)};
  run.former.folder = tile.folder;
  run.former.manifest = std::move(*manifest);
  run.scene.output = restricted(run.scene.output, {"video"});
  run.scene.output.video->title = false;
  return run;
}

bool is_replayed(const Redrawn& run) {
  const OverlayNeeds needs = overlay_needs(run.scene);
  return needs.collisions || needs.collision_counts ? run.former.has_flights_with_collisions(run.scene)
                                                    : run.former.has_flights();
}

Size picture_of(const Redrawn& run) {
  return layout_of(*run.scene.output.video).picture;
}

/// The camera that frames the run's motion.
MovingCamera fitted(const Redrawn& run, const function<void()>& stop_check) {
  MovingCamera camera(run.scene, picture_of(run));
  MovingCamera* const cameras[] = {&camera};
  const auto motion = run.former.has_flights() ? run.former.replay(run.scene) : make_simulator(run.scene);
  survey(cameras, *motion, stop_check);
  return camera;
}

/// So many views make the path of a camera that holds others which move.
constexpr int views_of_path = 64;

/// One camera that has in view what all of them have, at each time up to `end` (s). None: they are one already.
optional<CameraPlan> common_plan(span<const MovingCamera> cameras, double end) {
  CameraPlan plan;
  bool differ = false;
  for (int i = 0; i <= views_of_path; ++i) {
    State state;
    state.time = end * i / views_of_path;
    vector<Camera> views;
    for (const MovingCamera& camera : cameras) views.push_back(camera.at(state));
    differ = differ || any_of(views, [&](const Camera& view) { return view != views.front(); });
    static_cast<Camera&>(plan) = common_view(views, cameras.front().size());
    plan.path.push_back({state.time, plan.eye, plan.target, plan.fov});
  }

  if (!differ) return nullopt;
  if (all_of(cameras, [](const MovingCamera& camera) { return camera.stands_still(); })) plan.path.clear();
  return plan;
}

void draw_film(const Redrawn& run, const string& folder, const function<void()>& stop_check) {
  RunSettings settings;
  settings.durability = Durability::deferred;
  settings.checkpoint_s = 0;
  settings.former = &run.former.manifest;
  if (is_replayed(run)) settings.replay = [&run](const Scene& scene) { return run.former.replay(scene); };
  run_scene({&run.scene, folder}, choose_engine(run.scene), settings, {stop_check, [](const RunProgress&) {}});
}

}  // namespace

CommonFilms::CommonFilms(const FilePlace& place, vector<FilmTile>& tiles, const function<void()>& stop_check)
    : place_(place) {
  std::deque<Redrawn> runs;
  for (const FilmTile& tile : tiles) {
    optional<Redrawn> run = redrawn(tile);
    if (!run || !frames_motion(run->scene)) return;
    runs.push_back(std::move(*run));
  }

  vector<MovingCamera> cameras;
  double end = 0;
  for (const Redrawn& run : runs) {
    cameras.push_back(fitted(run, stop_check));
    end = max(end, run.scene.simulate.duration);
  }
  const optional<CameraPlan> common = common_plan(cameras, end);
  if (!common) return;

  for (size_t i = 0; i < runs.size(); ++i) {
    runs[i].scene.camera = *common;
    const string& name = folders_.emplace_back(part_name(fmt::format("film_{}", i)));
    remove_entry(place_, name);
    const string folder = place_.path + "/" + name;
    draw_film(runs[i], folder, stop_check);
    tiles[i].folder = folder;
    tiles[i].file = runs[i].scene.output.video->file;
    tiles[i].before = 0;
  }
}

CommonFilms::~CommonFilms() {
  for (const string& folder : folders_) try_to_remove(place_.folder, folder);
}

}  // namespace carom
