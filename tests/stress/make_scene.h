#pragma once
// The maker of random scenes: draws numbers, places things where there is room.
#include <initializer_list>
#include <iterator>

#include "std.h"
#include "stress/draws.h"
#include "stress/scene.h"

namespace carom::stress {

class Maker {
 public:
  Maker(uint64_t seed, RandomScene& scene, string_view bytes = {});

  // Numbers.
  double uniform(double low, double high) { return random_(low, high); }
  double spread(double low, double high);  // by its logarithm
  int whole(int low, int high) { return static_cast<int>(floor(random_(low, high + 1))); }
  bool chance(double p) { return random_(0, 1) < p; }
  double any(std::initializer_list<double> list) {
    return std::data(list)[whole(0, static_cast<int>(list.size()) - 1)];
  }
  Vec3 direction();
  Vec3 within(const Vec3& low, const Vec3& high);
  Vec3 somewhere(double half) { return within(Vec3::Constant(-half), Vec3::Constant(half)); }

  // Things. Those of fixed things come before bodies that need room.
  void plane(const Vec3& point, const Vec3& normal);
  void wall(const Vec3& center, const Vec3& normal, const Vec3& up, double width, double height);
  void room(double half);
  void obstacle(const Vec3& center, const Volume& volume);
  Entity body(const Vec3& x, const Vec3& v, const Volume& volume, double mass, double e);
  /// A body somewhere in the box, if there is room for it.
  bool fit(double half, const Volume& volume, const Vec3& v, double mass, double e);
  bool is_free(const Vec3& x, const Volume& volume);
  Volume volume(double size);
  Volume any_volume(double size, double spheres);

  // Laws.
  void gravity(double none);
  double restitution();  // 0 … 1, often one for all
  void rules();          // combination, pairs, coefficients of fixed things
  void forces(double duration, double acceleration);
  /// Of fixed things, up to this speed. Events set some of their times.
  void motions(World& world, const State& initial, double duration, double speed);
  /// An event of a body, by its number: its first collision, or its first entry into a half-space near its start.
  uint32_t event(World& world, const State& initial);

  RandomScene& scene;

 private:
  Draws random_;
};

}  // namespace carom::stress
