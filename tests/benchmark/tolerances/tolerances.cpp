// Effect of the constants of simulate/tolerances.h. Each is made 4 times as large and 4 times as small, and the same
// runs are repeated. The CSV has the greatest change of a position, in radii, in runs of 1 to 20 bodies. A * marks a
// failed run, or a pile of up to 54 balls that comes to rest too late or never.
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

#include "benchmark/tolerances/varied.h"
#include "physics/world.h"
#include "simulate/exact.h"
#include "simulate/pile.h"
#include "std.h"

namespace carom {
namespace {

Problem problem(double duration, double sideways = 0) {
  Problem p;
  p.world.gravity = Vec3(sideways, -10, 0);
  p.options.duration = duration;
  p.options.record_collisions = false;
  return p;
}

Problem bouncing_ball() {
  Problem p = problem(4);
  p.ball({0, 1.5, 0}, {0.7, 0, 0.1}, 1, 0.5, 0.5);
  p.plane({0, 0, 0}, {0, 1, 0});
  return p;
}

Problem ball_on_a_ball() {
  Problem p = problem(3);
  p.obstacle({0, 0, 0}, Volume::sphere(1));
  p.ball({0.02, sqrt(1.5 * 1.5 - 0.02 * 0.02), 0}, Vec3::Zero(), 1, 0.5, 0.3);
  p.plane({0, -1, 0}, {0, 1, 0});
  return p;
}

Problem balls_in_a_groove() {
  Problem p = problem(3, 1);
  p.plane({0, 0, 0}, {0, 1, 1});
  p.plane({0, 0, 0}, {0, 1, -1});
  p.plane({9, 0, 0}, {-1, 0, 0});
  for (int k = 0; k < 3; ++k) p.ball({1.02 * k, 0.7072, 0}, {0.3 * k, 0, 0}, 1 + k, 0.5, 0.4);
  return p;
}

Problem balls_in_a_slot() {
  Problem p = problem(6);
  p.plane({0, 0, 0}, {0, 1, 0});
  p.plane({-0.5, 0, 0}, {1, 0, 0});
  p.plane({0.52, 0, 0}, {-1, 0, 0});
  for (int k = 0; k < 3; ++k) p.ball({0.01 * k, 0.6 + 1.1 * k, 0}, Vec3::Zero(), 1, 0.5, 0.3);
  return p;
}

Problem struck_row() {
  Problem p = problem(3);
  p.world.gravity.setZero();
  p.ball({-3, 0, 0}, {2, 0, 0});
  for (int k = 0; k < 5; ++k) p.ball({1.0 * k, 0, 0}, Vec3::Zero());
  return p;
}

Problem ball_off_a_box() {
  Problem p = problem(3);
  p.obstacle({0, -1, 0}, Volume::box({1, 1, 1}));
  p.ball({0, 0.5, 0.2}, {0.8, 0, 0}, 1, 0.5, 0.5);
  p.plane({0, -2, 0}, {0, 1, 0});
  return p;
}

Problem column(int balls) {
  Problem p = problem(12);
  p.plane({0, 0, 0}, {0, 1, 0});
  for (int k = 0; k < balls; ++k) p.ball({0, 0.5 + 1.001 * k, 0}, Vec3::Zero(), 1, 0.5, 0.5);
  return p;
}

/// The first of 20 balls on a floor pushes the others along.
Problem pushed_row() {
  Problem p = problem(2);
  p.plane({0, 0, 0}, {0, 1, 0});
  for (int k = 0; k < 20; ++k) p.ball({1.0 * k, 0.5, 0}, Vec3::Zero(), 1 + 0.1 * k, 0.5, 0.3);
  p.world.forces.push_back({UniformForce{Vec3(40, 0, 0)}, 0, 2, {0}});
  return p;
}

Problem row_that_slides_to_a_wall() {
  Problem p = problem(2, -3);
  p.plane({0, 0, 0}, {0, 1, 0});
  p.plane({-2, 0, 0}, {1, 0, 0});
  for (int k = 0; k < 6; ++k) p.ball({1.1 * k, 0.5, 0.02 * k}, {-0.5 * k, 0, 0}, 1, 0.5, 0.6);
  return p;
}

vector<Problem> problems() {
  return {bouncing_ball(),  ball_on_a_ball(), balls_in_a_groove(), balls_in_a_slot(),          struck_row(),
          ball_off_a_box(), column(20),       pushed_row(),        row_that_slides_to_a_wall()};
}

ExactOptions steps(const Problem& p, double step) {
  ExactOptions options;
  options.duration = p.options.duration;
  options.step = step;
  options.integrator = Integrator::rk4;
  options.record_collisions = false;
  return options;
}

unique_ptr<Simulator> simulator_of(const Problem& p, bool exact, double step) {
  if (exact) return make_exact_simulator(p.world, p.initial, p.options);
  return make_exact_simulator(p.world, p.initial, steps(p, step));
}

/// Prints positions of bodies at three times (m), and whether piles rest, one a line.
void run_all(bool exact) {
  for (const Problem& p : problems()) {
    const unique_ptr<Simulator> simulator = simulator_of(p, exact, 0.01);
    for (int k = 1; k <= 3; ++k) {
      go_to(*simulator, p.options.duration * k / 3);
      for (const Vec3& x : simulator->state().position) fmt::print("x {} {} {}\n", x.x(), x.y(), x.z());
    }
  }

  const int layers = exact ? 6 : 5;
  Problem pile = loose_pile(3, layers, exact ? 15 : 25);
  for (int other = 0; other < 3; ++other) {
    pile.initial.position[0].x() += 1e-3;
    const unique_ptr<Simulator> simulator = simulator_of(pile, exact, 0.005);
    go_to(*simulator, pile.options.duration);
    fmt::print("rest {}\n", simulator->tally().resting == pile.world.body_count() ? 1 : 0);
  }
}

/// Output of run_all in its own process; empty if it fails or takes longer than a minute.
vector<string> lines_of(const string& program, const string& engine, const string& varied) {
  const string command = fmt::format("CAROM_VARIED={} timeout 60 '{}' {} 2>/dev/null", varied, program, engine);
  vector<string> lines;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  array<char, 256> line;
  while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) lines.emplace_back(line.data());
  if (::pclose(pipe) != 0) lines.clear();
  return lines;
}

string difference(const vector<string>& usual, const vector<string>& other) {
  constexpr double radius = 0.5;  // m
  if (usual.size() != other.size()) return "*";
  double farthest = 0;
  bool rests = true;

  for (size_t k = 0; k < usual.size(); ++k) {
    Vec3 p, q;
    if (std::sscanf(usual[k].c_str(), "x %lf %lf %lf", &p.x(), &p.y(), &p.z()) == 3 &&
        std::sscanf(other[k].c_str(), "x %lf %lf %lf", &q.x(), &q.y(), &q.z()) == 3)
      farthest = std::max(farthest, (p - q).norm() / radius);
    else
      rests = rests && usual[k] == other[k];
  }
  return (farthest == 0 ? "-" : fmt::format("{:.0e}", farthest)) + (rests ? "" : "*");
}

int compare_all(const string& program) {
  fmt::print("constant,4 times,a quarter\n");
  string engine;
  vector<string> usual;
  for (const string& name : varied_names()) {
    const string its = name.substr(0, name.find('.'));
    if (its != engine) usual = lines_of(program, engine = its, "none");
    const auto effect = [&](const char* factor) {
      return difference(usual, lines_of(program, engine, name + "=" + factor));
    };

    const string larger = effect("4"), smaller = effect("0.25");
    fmt::print("{},{},{}\n", name, larger, smaller);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace carom

int main(int count, char** arguments) {
  if (count == 1) return carom::compare_all(arguments[0]);
  carom::run_all(std::string(arguments[1]) == "exact");
  return 0;
}
