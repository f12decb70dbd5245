// For a direction of view the motion is four numbers an instant (frustum.h), which bound the eye by four inequalities.
// A still eye obeys them for all instants. An eye that moves obeys smooth functions below them (smooth_minorant.h): the
// wider these are smoothed, the slower it moves, and in the end it stands still. The least width that is slow enough is
// taken. No search over paths is needed, and what is in view stays in view.
#include "render/camera_fit.h"

#include "numerics/smooth_minorant.h"
#include "physics/world.h"
#include "render/frustum.h"
#include "render/motion_view.h"
#include "render/parallel.h"
#include "render/sight.h"
#include "std.h"

namespace carom {
namespace {

/// The part of the picture's height that a body has at least as it collides: in the nearest view, in one that need not
/// come nearer, in one that need not move, in one that moves to keep more bodies, and in one that shows it at all.
constexpr double largest = 0.25, large = 0.08, good_size = 0.045, fair_size = 0.03, least_size = 0.02;
/// Where bodies are smaller, the shares of the impulses that may be all that is framed.
constexpr array shares = {0.95, 0.9, 0.8, 0.7, 0.6, 0.5};
/// The gain in size that makes up for a shorter time in view, and for a camera that moves.
constexpr double worth_cutting = 1.3, worth_moving = 1.3;
/// The share of the bodies in view from which on a view need not keep more, that of the bodies or of the instants with
/// one in view which a view keeps if it shows bodies larger than they need be, and a gain that is worth a move.
constexpr double some_kept = 0.35, nearly_all_kept = 0.95, worth_keeping = 0.15;
/// Of a camera that moves, per second of film: heights of the picture, and the natural logarithm of the distance.
constexpr double top_speed = 1, top_acceleration = 2;

constexpr array elevations = {slight_elevation, 30.0, 45.0, 60.0, 75.0, 85.0};  // degrees
// Of a flat motion, from and to; of an upright one. A view along an upright motion would show little of it.
constexpr size_t flat_from = 1, flat_to = elevations.size(), upright_to = 4;
/// A steeper view of a flat motion shows bodies apart, unless they become smaller than so.
constexpr double worth_height = 0.95;
/// Fewer are known only of very many bodies, which no camera goes along with.
constexpr size_t few_instants = 32;
/// Directions of a round at which the motion is framed.
constexpr int round_views = 24;

/// Lines of sight that are tried, and tests of things on them.
constexpr size_t most_lines = 20000, most_tests = 400000;
/// The part of the lines that may be hidden if all collisions are seen.
constexpr double may_be_hidden = 0.02;

/// The size of a box along a unit vector (m).
double size_along(const Extent& box, const Vec3& n) {
  return n.cwiseAbs().dot(box.high - box.low);
}

/// Views from one direction.
struct Plan {
  CameraViews views;
  double least = 0;  // part of the picture's height that a body has at least as it collides
  double kept = 0;   // mean share of the bodies that are in view
  double shown = 0;  // share of the instants that have a body in view
};

/// What is hidden of the lines of sight that were tried.
struct Hidden {
  double share = 0;         // of the lines
  bool strikes = false;     // bodies as they collide
  vector<Entity> behind{};  // these things hide them, ascending
  bool none() const { return !strikes && share <= may_be_hidden; }
};

class ViewPlanner {
 public:
  /// `share`: of MotionView.
  ViewPlanner(const Scene& scene, const MotionSamples& samples, Size size, double pace, double share)
      : scene_(scene), samples_(samples), view_(scene, samples, pace, share), sight_(scene), size_(size), pace_(pace) {
    if (scene.camera) lens_ = *scene.camera, orbit_ = scene.camera->orbit, parallel_ = scene.camera->orthographic;
    if (parallel_) lens_ = from_afar(lens_);
    find_best();
  }

  double least() const { return best_.least; }
  bool is_quiet() const { return view_.is_quiet(); }
  size_t strikes() const { return view_.strikes().size(); }
  CameraViews views() const { return best_.views; }

 private:
  /// Goes up until nothing is hidden. If all hide something, the lowest elevation that hides about as little as any.
  void find_best() {
    Hidden least_hidden{2};
    const size_t first = first_elevation(), to = first < flat_from ? upright_to : flat_to;
    for (size_t i = first; i < to; ++i) {
      Plan plan = plan_from(elevations[i]);
      Hidden hidden = hidden_in(plan.views);
      if (!hidden.none() && hidden.share + may_be_hidden >= least_hidden.share) continue;
      best_ = std::move(plan);
      least_hidden = std::move(hidden);
      if (least_hidden.none()) return;
    }
    for (const Entity e : least_hidden.behind) best_.views.faded.push_back(uint32_t(e - scene_.world.body_count()));
  }

  Frustum frustum_from(double elevation, double azimuth = 0) const { return Frustum(lens_, size_, elevation, azimuth); }

  /// A motion that is less than half as high as it is deep, such as one on a table, is seen from higher up.
  size_t first_elevation() const {
    const Frustum frustum = frustum_from(elevations.front());
    const Extent bodies = view_.all(frustum).bodies;
    if (2 * size_along(bodies, frustum.up()) >= size_along(bodies, frustum.front())) return 0;
    const Plan low = plan_from(elevations[flat_from]), high = plan_from(elevations[flat_from + 1]);
    const bool is_as_good = high.least > worth_height * low.least && high.kept > worth_height * low.kept;
    return flat_from + is_as_good;
  }

  Plan plan_from(double elevation) const {
    const Frustum frustum = frustum_from(elevation);
    Plan still = still_plan(views_from(elevation));
    const bool is_good = still.least >= (view_.is_quiet() ? least_size : good_size);
    if ((is_good && (still.kept >= some_kept || view_.is_quiet())) || orbit_ > 0 || samples_.instants() < few_instants)
      return still;

    Plan moving = moving_plan(frustum, is_good ? fair_size : good_size);
    const bool is_better = is_good ? moving.least >= fair_size && moving.kept > still.kept + worth_keeping
                                   : moving.least > worth_moving * still.least;
    return is_better ? moving : still;
  }

  /// The directions from which a still eye, or one that goes round, looks.
  vector<Frustum> views_from(double elevation) const {
    vector<Frustum> views;
    const int count = orbit_ > 0 ? round_views : 1;
    for (int i = 0; i < count; ++i) views.push_back(frustum_from(elevation, 360.0 * i / count));
    return views;
  }

  /// The widest scope in which bodies are large enough as they collide. A narrower one has to show them larger.
  Plan still_plan(const vector<Frustum>& views) const {
    vector<MotionView::Content> contents;
    for (const Frustum& view : views) contents.push_back(view_.all(view));
    Plan best = still_plan(views, contents);
    if (view_.is_quiet() || best.least >= large) return best;

    vector<array<MotionView::Content, MotionView::whole>> parts;
    for (const Frustum& view : views) parts.push_back(view_.parts(view));
    for (size_t scope = MotionView::whole; scope-- > 0;) {
      if (best.least >= (scope >= widest_cut ? large : good_size)) break;
      for (size_t i = 0; i < views.size(); ++i) contents[i] = parts[i][scope];
      Plan plan = still_plan(views, contents);
      if (best.least >= good_size && plan.kept < nearly_all_kept) break;
      if (best.least >= least_size && plan.shown < nearly_all_kept) break;
      if (plan.least > worth_cutting * best.least) best = std::move(plan);
    }
    return best;
  }

  Plan still_plan(const vector<Frustum>& views, const vector<MotionView::Content>& contents) const {
    const Frustum& frustum = views.front();
    const Vec3 middle = contents.front().bodies.middle();
    Vec3 eye = frustum.eye(contents.front().reach);
    double distance = frustum.depth(contents.front().reach, middle);
    if (orbit_ > 0) {
      for (size_t i = 0; i < views.size(); ++i) distance = max(distance, views[i].distance(contents[i].reach, middle));
      eye = middle - distance * frustum.view().forward;
    }
    // All is in one point.
    if (!(distance > 0)) {
      distance = 1;
      eye = middle - frustum.view().forward;
    }

    // Nor nearer than necessary.
    const auto still = [&](size_t) -> const Vec3& { return eye; };
    Plan plan{{lens_, {}, {}}};
    plan.least = least_size_of(frustum, still);
    if (plan.least > largest) {
      const double back = (plan.least / largest - 1) * distance;
      eye -= back * frustum.view().forward;
      distance += back;
      plan.least = least_size_of(frustum, still);
    }
    find_kept(plan, frustum, still);

    plan.views.camera.eye = eye;
    plan.views.camera.target = eye + distance * frustum.view().forward;
    set_limits(plan.views.camera, distance, distance);
    return plan;
  }

  /// How large bodies are as they collide: the part of the picture's height that the smallest one has.
  template <typename EyeAt>
  double least_size_of(const Frustum& frustum, const EyeAt& eye) const {
    double least = 1;
    for (const MotionView::Strike& strike : view_.strikes()) {
      const Vec3& center = samples_.center(strike.instant, strike.body);
      // Of a quiet motion some may have left.
      if (view_.is_quiet() && !frustum.has(center, eye(strike.instant))) continue;
      const double depth = frustum.view().forward.dot(center - eye(strike.instant));
      const double height = 2 * samples_.volume(strike.instant, strike.body).half.maxCoeff();
      least = min(least, height / frustum.height(depth));
    }
    return least;
  }

  template <typename EyeAt>
  void find_kept(Plan& plan, const Frustum& frustum, const EyeAt& eye) const {
    size_t there = 0, kept = 0, instants = 0, shown = 0;
    for (size_t k = 0; k < samples_.instants(); ++k) {
      const size_t there_before = there, kept_before = kept;
      for (size_t i = 0; i < samples_.bodies().size(); ++i) {
        if (!samples_.is_there(k, i)) continue;
        ++there;
        kept += frustum.has(samples_.center(k, i), eye(k));
      }

      instants += there > there_before;
      shown += kept > kept_before;
    }

    plan.kept = there > 0 ? double(kept) / double(there) : 1;
    plan.shown = instants > 0 ? double(shown) / double(instants) : 1;
  }

  /// The widest scope in which bodies are large enough as they collide, or the one in which they are largest.
  Plan moving_plan(const Frustum& frustum, double enough) const {
    Plan best;
    for (size_t scope = view_.is_quiet() ? 1 : MotionView::whole; scope-- > 0;) {
      Plan plan = moving_plan(frustum, scope);
      if (plan.least > worth_cutting * best.least) best = std::move(plan);
      if (best.least >= enough) break;
    }
    return best;
  }

  Plan moving_plan(const Frustum& frustum, size_t scope) const {
    vector<MotionView::Moment> moments = view_.moments(frustum, scope);
    if (!fill_gaps(moments)) return {};

    // From a fifth of a second of film on.
    const double film_s = (samples_.time(samples_.instants() - 1) - samples_.time(0)) / pace_;
    const size_t count = moments.size();
    for (double half = max(1.0, double(count) / film_s / 15);; half *= 1.25) {
      vector<Vec3> eyes;
      vector<double> depths;
      follow(frustum, moments, size_t(half), eyes, depths);
      if (3 * half < double(count) && !is_slow(frustum, eyes, depths)) continue;
      return plan_along(frustum, eyes, depths);
    }
  }

  /// Between moments at which something happens, the camera goes on from the one to the other. False: nothing happens.
  static bool fill_gaps(vector<MotionView::Moment>& moments) {
    vector<size_t> given;
    for (size_t k = 0; k < moments.size(); ++k)
      if (!moments[k].reach.empty()) given.push_back(k);
    if (given.empty()) return false;

    for (size_t k = 0; k < given.front(); ++k) moments[k] = moments[given.front()];
    for (size_t k = given.back() + 1; k < moments.size(); ++k) moments[k] = moments[given.back()];
    for (size_t g = 1; g < given.size(); ++g) {
      const MotionView::Moment &a = moments[given[g - 1]], &b = moments[given[g]];
      for (size_t k = given[g - 1] + 1; k < given[g]; ++k) {
        const double part = double(k - given[g - 1]) / double(given[g] - given[g - 1]);
        for (size_t side = 0; side < 4; ++side)
          moments[k].reach.least[side] = (1 - part) * a.reach.least[side] + part * b.reach.least[side];
        moments[k].middle = (1 - part) * a.middle + part * b.middle;
      }
    }
    return true;
  }

  /// Eyes and the depths of what happens, smoothed by so many instants.
  void follow(const Frustum& frustum, const vector<MotionView::Moment>& moments, size_t half, vector<Vec3>& eyes,
              vector<double>& depths) const {
    const size_t count = moments.size();
    const Vec3& forward = frustum.view().forward;
    vector<Frustum::Reach> reach(count);
    for (size_t side = 0; side < 4; ++side) {
      vector<double> least(count);
      for (size_t k = 0; k < count; ++k) least[k] = moments[k].reach.least[side];
      least = smooth_minorant(least, half);
      for (size_t k = 0; k < count; ++k) reach[k].least[side] = least[k];
    }

    vector<double> ahead(count), middle(count);
    for (size_t k = 0; k < count; ++k) {
      eyes.push_back(frustum.eye(reach[k]));
      ahead[k] = forward.dot(eyes[k]);
      middle[k] = forward.dot(moments[k].middle);
    }
    // The nearest eye leaves the one pair of sides for the other with a kink. An eye farther back sees the same.
    const vector<double> smooth = smooth_minorant(ahead, half);
    middle = smoothed(middle, half);
    for (size_t k = 0; k < count; ++k) {
      eyes[k] += (smooth[k] - ahead[k]) * forward;
      depths.push_back(middle[k] - smooth[k]);
    }
  }

  bool is_slow(const Frustum& frustum, const vector<Vec3>& eyes, const vector<double>& depths) const {
    const auto film_s = [&](size_t k) { return (samples_.time(k + 1) - samples_.time(k)) / pace_; };
    Vec3 before = Vec3::Zero();
    for (size_t k = 0; k + 1 < eyes.size(); ++k) {
      if (!(depths[k] > 0 && depths[k + 1] > 0)) return false;

      const Vec3 way = (eyes[k + 1] - eyes[k]) / frustum.height(depths[k]);
      const Vec3 speed =
          Vec3(frustum.view().right.dot(way), frustum.view().up.dot(way), std::log(depths[k + 1] / depths[k])) /
          film_s(k);

      const double pan = hypot(speed.x(), speed.y()), zoom = std::abs(speed.z());
      const Vec3 gain = (speed - before) / film_s(k);
      if (max(pan, zoom) > top_speed) return false;
      if (k > 0 && max(hypot(gain.x(), gain.y()), std::abs(gain.z())) > top_acceleration) return false;
      before = speed;
    }
    return true;
  }

  Plan plan_along(const Frustum& frustum, const vector<Vec3>& eyes, const vector<double>& depths) const {
    const auto [nearest, farthest] = ranges::minmax_element(depths);
    if (!(*nearest > 0)) return {};
    Plan plan{{lens_, {}, {}}};
    for (size_t k = 0; k < eyes.size(); ++k)
      plan.views.path.push_back({samples_.time(k), eyes[k], eyes[k] + depths[k] * frustum.view().forward, lens_.fov});
    plan.views.camera.eye = plan.views.path.front().eye;
    plan.views.camera.target = plan.views.path.front().target;
    set_limits(plan.views.camera, *nearest, *farthest);
    const auto moving = [&](size_t instant) -> const Vec3& { return eyes[instant]; };
    plan.least = least_size_of(frustum, moving);
    find_kept(plan, frustum, moving);
    return plan;
  }

  void set_limits(Camera& camera, double nearest, double farthest) const {
    // Seen from afar, the eye is where a camera of the angle of the scene would stand.
    camera.near = parallel_ ? nearest * (1 - 1 / times_farther) : nearest / 1000;
    camera.far = parallel_ ? farthest * (1 + 1000 / times_farther) : farthest * 1000;
  }

  Hidden hidden_in(const CameraViews& views) const {
    Hidden hidden;
    if (!sight_.may_hide() || samples_.instants() < 2) return hidden;
    const size_t bodies = samples_.bodies().size();
    size_t lines = 0, behind = 0;
    vector<size_t> by_thing(scene_.world.fixed_count());
    vector<bool> behind_strikes(scene_.world.fixed_count());

    const auto look = [&](size_t instant, size_t i) {
      Camera camera = views.camera;
      if (!views.path.empty()) camera.eye = views.path[instant].eye, camera.target = views.path[instant].target;
      if (orbit_ > 0) camera = turned(camera, 360 * samples_.time(instant) / orbit_);

      const vector<Entity> hiders =
          sight_.hiders(samples_.world(), samples_.time(instant), camera.eye, view_of(camera, size_),
                        samples_.center(instant, i), samples_.volume(instant, i).half.maxCoeff());
      ++lines;
      behind += !hiders.empty();
      for (const Entity e : hiders) ++by_thing[e - scene_.world.body_count()];
      return hiders;
    };

    // Collisions, and what goes into them and comes out of them.
    const size_t most = min(most_lines, max<size_t>(most_tests / sight_.count(), 1));
    const size_t step = 1 + view_.strikes().size() / most;
    for (size_t i = 0; i < view_.strikes().size(); i += step)
      for (const Entity e : look(view_.strikes()[i].instant, view_.strikes()[i].body))
        behind_strikes[e - scene_.world.body_count()] = hidden.strikes = true;

    const size_t all = bodies * samples_.instants(), stride = 1 + all / most;
    for (size_t n = 0; n < all; n += stride) {
      const size_t instant = n / bodies, i = n % bodies;
      if (samples_.is_there(instant, i) && view_.is_in(sight_scope, instant, i)) look(instant, i);
    }

    hidden.share = lines > 0 ? double(behind) / double(lines) : 0;
    for (size_t thing = 0; thing < by_thing.size(); ++thing)
      if (behind_strikes[thing] || double(by_thing[thing]) > may_be_hidden * double(lines))
        hidden.behind.push_back(Entity(scene_.world.body_count() + thing));
    return hidden;
  }

  // Scopes of MotionView: what goes into collisions and comes out of them, and what is cut only where it must be.
  static constexpr size_t sight_scope = 2, widest_cut = 2;

  const Scene& scene_;
  const MotionSamples& samples_;
  const MotionView view_;
  const Sight sight_;
  Camera lens_;
  Size size_;
  double pace_;
  double orbit_ = 0;  // s
  bool parallel_ = false;
  Plan best_;
};

}  // namespace

CameraViews frame_views(const Scene& scene, const MotionSamples& samples, Size size, double pace) {
  const ViewPlanner all(scene, samples, size, pace, 1);
  if (all.least() >= least_size) return all.views();

  // Where not all can be seen, most of it, and at least half of the collisions. If the least share is not seen much
  // better, no share is.
  CameraViews best = all.views();
  double best_worth = all.least();
  const ViewPlanner fewest(scene, samples, size, pace, shares.back());
  if (all.is_quiet() || fewest.least() <= worth_cutting * all.least()) return best;

  for (const double share : shares) {
    const ViewPlanner most(scene, samples, size, pace, share);
    if (2 * most.strikes() < all.strikes()) break;
    const double worth = share * min(most.least(), least_size);
    if (worth <= worth_cutting * best_worth) continue;
    best = most.views();
    best_worth = worth;
    if (most.least() >= least_size) break;
  }
  return best;
}

}  // namespace carom
