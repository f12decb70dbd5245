// Places what a picture shows in the camera's frame, and draws the tiles of the picture by several threads. Meshes are
// drawn by OSMesa before, into a picture of places and normals. A picture equal to the last one is not drawn again.
#include "render/renderer.h"

#include <fmt/format.h>

#include "physics/surface_motion.h"
#include "physics/world_now.h"
#include "raster/threads.h"
#include "render/last_picture.h"
#include "render/lighting.h"
#include "render/meshes.h"
#include "render/mirrored.h"
#include "render/room_edges.h"
#include "render/strokes.h"
#include "render/surfaces.h"
#include "render/things.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr int largest_side = 16384;

/// To prepare fewer solids takes less time than to wake a thread up.
constexpr size_t worth_sharing = 1000;

Size checked(Size size, int samples) {
  if (size.width < 1 || size.height < 1 || size.width > largest_side || size.height > largest_side)
    throw RenderError(fmt::format("a picture of {} x {} pixels cannot be drawn: each side can be 1 to {}", size.width,
                                  size.height, largest_side));
  if (samples < 1) throw RenderError(fmt::format("{} samples per pixel: there must be 1 or more", samples));
  return size;
}

}  // namespace

struct Renderer::Impl {
  Impl(const Scene& s, Size picture_size, int samples)
      : given(s.world),
        moved(s.world.moves() ? make_unique<Scene>(s) : nullptr),
        scene(moved ? *moved : s),
        size(checked(picture_size, samples)),
        things(scene),
        edges(room_edges(scene)) {
    shot.lens.smooth = samples > 1;
    shot.lens.width = size.width, shot.lens.height = size.height;
    if (scene.background.color) shot.backdrop.plain = true, shot.backdrop.color = linear(*scene.background.color);

    if (!things.files().empty()) {
      meshes.emplace(things.files(), size, shot.lens.smooth);
      things.measure([&](const MeshUse& use, size_t file) { return meshes->size_of(use, file); });
    }

    shot.backdrop.none = scene.background.transparent;
    shot.pattern.unit = float(pattern_unit(s, size));

    image.width = size.width, image.height = size.height;
    image.channels = scene.background.transparent ? 4 : 3;
    image.pixels.resize(size_t(size.height) * image.row_size());
  }

  void place_camera(const Eye& eye);
  void prepare(const raster::Shot& seen);
  void draw_images();
  void draw(const State& state, Drawing drawing);

  WorldNow given;
  const unique_ptr<Scene> moved;  // with fixed things where they are in the last picture; null: nothing moves
  const Scene& scene;             // the one that is shown
  const Size size;
  Things things;
  vector<Stroke> edges;  // of the room
  raster::Shot shot;
  raster::Silhouettes silhouettes;
  raster::Bins bins;
  raster::LightGrid lights;
  Lines lines;
  vector<vector<uint8_t>> images;  // of planes that mirror
  optional<Meshes> meshes;
  optional<raster::Threads> threads;
  optional<Camera> own_camera;  // camera_of(scene)
  LastPicture last;
  Image image;
  uint64_t drawn = 0;
};

void Renderer::Impl::place_camera(const Eye& eye) {
  shot.lens.pixel = float(eye.pixel);
  shot.lens.left = float(-eye.tan_x + 0.5 * eye.pixel);
  shot.lens.top = float(eye.tan_y - 0.5 * eye.pixel);
  shot.lens.near = float(eye.camera.near);
  for (size_t i = 0; i < 3; ++i) shot.lens.axes[i] = floats(eye.direction(Vec3::Unit(int(i))));
  if (!own_camera) own_camera = camera_of(scene);
  add_lights(scene, *own_camera, eye, shot);
  add_surfaces(scene, eye, shot);
}

/// Sorts the solids for the tiles and for the light, which do not depend on each other.
void Renderer::Impl::prepare(const raster::Shot& seen) {
  const auto part = [&](int i) {
    if (i == 1) return lights.fill(seen);
    silhouettes.fill(seen);
    bins.fill(seen, silhouettes);
  };
  if (seen.solids.size() < worth_sharing) {
    part(0), part(1);
  } else {
    threads->run(2, [&](raster::TileMemory&, int i) { part(i); });
  }
}

/// Draws what level planes mirror. The sides of a room are of glass by default, and a picture for each would be dear.
void Renderer::Impl::draw_images() {
  size_t count = 0;
  for (raster::Ground& ground : shot.grounds) {
    const bool level = raster::dot(ground.normal, shot.lens.axes[1]) > 0.7F;
    if (!(level && ground.most_mirror > 0 && ground.height > 0)) continue;
    if (images.size() <= count) images.emplace_back(4 * size_t(size.width) * size_t(size.height));
    vector<uint8_t>& pixels = images[count++];

    const raster::Shot seen = mirrored(shot, ground);
    prepare(seen);
    threads->draw({&seen, &silhouettes, &bins, &lights, nullptr, nullptr, pixels.data(), 4});
    ground.image = pixels.data();
  }
}

void Renderer::Impl::draw(const State& state, Drawing drawing) {
  const bool placed = moved && place_fixed_things(given.at(state.fired), state.time, moved->world);
  if (drawn > 0 && !placed && last.is_of(state, drawing)) return;
  if (placed) edges = room_edges(scene);

  const Eye eye(drawing.camera, size);
  if (drawn == 0 || placed || last.drawing.camera != drawing.camera) place_camera(eye);
  ++drawn;

  things.place(state, drawing, eye, shot);
  if (meshes) meshes->draw(things.meshes(), eye, shot);
  if (!threads) threads.emplace(raster::drawing_threads());
  draw_images();
  prepare(shot);

  lines.begin(size);
  lines.add(edges, eye);
  lines.add(drawing.strokes, eye);

  const raster::Picture picture{&shot,          &silhouettes,        &bins,         &lights, &lines.all,
                                &lines.by_tile, image.pixels.data(), image.channels};
  threads->draw(picture);
  last.take(state, std::move(drawing));
}

Renderer::Renderer(const Scene& scene, Size size, int samples) : impl_(make_unique<Impl>(scene, size, samples)) {}
Renderer::~Renderer() = default;

const Image& Renderer::draw(const State& state, Drawing drawing) {
  impl_->draw(state, std::move(drawing));
  return impl_->image;
}

const Image& Renderer::draw(const State& state) {
  if (!impl_->own_camera) impl_->own_camera = camera_of(impl_->scene);
  Drawing drawing;
  drawing.camera = *impl_->own_camera;
  return draw(state, std::move(drawing));
}

uint64_t Renderer::drawn() const {
  return impl_->drawn;
}

}  // namespace carom
