// Many bodies tied to each other: a hammock, cradles, chains, frames, and ties at random.
#include <gtest/gtest.h>

#include "simulate/random.h"
#include "simulate/ties.h"
#include "slow_with_sanitizers.h"
#include "std.h"

namespace carom {
namespace {

/// Three bobs between two anchors, taut and in balance: A hangs from the left, C from the right, B between them.
Tied hammock() {
  Tied problem;
  problem.ball({-0.5, -1, 0}, {0, 0, 0}, 1, 0.0625, 1);
  problem.ball({0, -1.25, 0}, {0, 0, 0}, 2, 0.0625, 1);
  problem.ball({0.5, -1, 0}, {0, 0, 0}, 1, 0.0625, 1);
  // kg, by g: half of B's weight, and from the slope 1/2 of B's strings their horizontal pull; with A's weight.
  const double half = 1, level = 2 * half, down = half + 1;
  const Vec3 out = Vec3(-level, down, 0);
  for (const auto& [from, to] : {pair<Entity, Entity>{0, 1}, {1, 2}})
    problem.between(from, to, (problem.initial.position[from] - problem.initial.position[to]).norm());
  problem.anchored(0, problem.initial.position[0] + 0.5 * out, (0.5 * out).norm());
  problem.anchored(2, problem.initial.position[2] + 0.5 * Vec3(level, down, 0), (0.5 * out).norm());
  return problem;
}

TEST(Strings, AnImpulseRunsThroughAllTautStringsAtOnce) {
  Tied problem = hammock();
  problem.options.duration = 1;
  const auto still = make_exact_simulator(problem.world, problem.initial, problem.options);
  go_to(*still, 1);
  for (Entity i = 0; i < 3; ++i)
    EXPECT_LT((still->state().position[i] - problem.initial.position[i]).norm(), 1e-15) << i;
  EXPECT_LT(still->effort().events, 40u);

  // A bullet from above and the left on A.
  const Vec3 n(0.6, -0.8, 0), g(0, -g_n, 0), speed = 5 * n;
  const Vec3 meets = problem.initial.position[0] - 0.125 * n;
  problem.ball(meets - 0.125 * speed + 0.5 * 0.125 * 0.125 * g, speed - 0.125 * g, 0.5, 0.0625, 1);
  problem.options.duration = 0.125 + 0x1p-20;
  const Outcome run = run_exact(problem);
  ASSERT_EQ(run.collisions.size(), 1u);

  // Unknowns: the changes of A's, B's and C's velocities, the impulses of four strings and that of the bullet, J.
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(14, 14);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(14), solution;
  for (int i = 0; i < 9; ++i) m(i, i) = problem.world.mass[static_cast<size_t>(i / 3)];

  const auto row = [&](int c, Entity body, const Vec3& along) {
    for (int k = 0; k < 3; ++k) {
      m(9 + c, 3 * static_cast<int>(body) + k) += along[k];
      m(3 * static_cast<int>(body) + k, 9 + c) -= along[k];
    }
  };

  for (int c = 0; c < 4; ++c) {
    const String& s = problem.world.strings[static_cast<size_t>(c)];
    const Vec3 x = problem.initial.position[s.body];
    const Vec3 along = ((s.other == no_entity ? s.anchor : problem.initial.position[s.other]) - x).normalized();
    row(c, s.body, along);
    if (s.other != no_entity) row(c, s.other, -along);
  }

  row(4, 0, n);
  m(13, 13) = 1 / 0.5;  // the bullet's own change is -J / m
  right[13] = 2 * 5;
  solution = m.fullPivLu().solve(right);
  for (int c = 0; c < 4; ++c) ASSERT_GT(solution[9 + c], 0) << "string " << c << " has a share";

  EXPECT_NEAR(run.collisions[0].impulse, solution[13], 1e-12);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT((run.end.position[static_cast<size_t>(i)] - problem.initial.position[static_cast<size_t>(i)] -
               0x1p-20 * solution.segment<3>(3 * i))
                  .norm(),
              1e-10)
        << i;
  EXPECT_NEAR(residual(problem, run), 0, 1e-11);
}

/// Seven balls in a row, each on one string or on two in a V. The first ones are lifted.
Tied cradle(double angle, bool vee, int lifted = 1) {
  Tied problem;
  const double radius = 0.0625;

  for (int k = 0; k < 7; ++k) {
    const double x = 2 * radius * k;
    const Vec3 off = k < lifted ? Vec3(-std::sin(angle), -std::cos(angle), 0) : Vec3(0, -1, 0);
    const Entity i = problem.ball(Vec3(x, 0, 0) + off, {0, 0, 0}, 1, radius, 1);

    for (const double z : {-0.75, 0.75}) {
      if (!vee && z < 0) continue;
      const Vec3 anchor(x, 0, vee ? z : 0);
      problem.anchored(i, anchor, (problem.initial.position[i] - anchor).norm());
    }
  }

  return problem;
}

TEST(Strings, TheCradleOfSevenSwingsWithThePeriodOfOnePendulum) {
  SLOW_WITH_SANITIZERS();
  for (const bool vee : {false, true}) {
    const double angle = 0.5, whole = period(1, angle);
    Tied problem = cradle(angle, vee);
    problem.options.duration = 10 * whole;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    for (int k = 1; k <= 10; ++k) {
      go_to(*simulator, (k - 0.5) * whole);
      const Vec3 last = problem.initial.position[6] + Vec3(std::sin(angle), 1 - std::cos(angle), 0);
      EXPECT_LT((simulator->state().position[6] - last).norm(), 1e-12) << vee << k;  // measured: 1.8e-13
      go_to(*simulator, k * whole);
      for (Entity i = 0; i < 7; ++i)
        EXPECT_LT((simulator->state().position[i] - problem.initial.position[i]).norm(), 1e-12)
            << vee << " " << k << ": " << i;
    }

    EXPECT_EQ(simulator->tally().body_body, 120u);
    EXPECT_EQ(simulator->tally().collisions(), 120u);
    EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-11);
  }
}

TEST(Strings, AsManyBallsOfACradleRiseAsAreLifted) {
  SLOW_WITH_SANITIZERS();
  for (int lifted = 2; lifted <= 6; ++lifted) {
    const double angle = 0.5, whole = period(1, angle);
    Tied problem = cradle(angle, false, lifted);
    problem.options.duration = 4 * whole;
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    for (int k = 1; k <= 4; ++k) {
      go_to(*simulator, (k - 0.5) * whole);

      for (Entity i = 0; i < 7; ++i) {
        const bool rises = static_cast<int>(i) >= 7 - lifted;
        const Vec3 at =
            Vec3(0.125 * i, -1, 0) + (rises ? Vec3(std::sin(angle), 1 - std::cos(angle), 0) : Vec3(0, 0, 0));
        EXPECT_LT((simulator->state().position[i] - at).norm(), 1e-11) << lifted << " " << k << ": " << i;
      }

      go_to(*simulator, k * whole);
    }

    EXPECT_NEAR(energy(problem, simulator->state()), energy(problem, problem.initial), 1e-10);
  }
}

/// A chain in a plane, from (0, 0) down, by its angles: Lagrange's equations, and Runge and Kutta's method in steps so
/// short that its error is rounding.
class ChainReference {
 public:
  ChainReference(vector<double> mass, vector<double> length, vector<double> angle)
      : mass_(std::move(mass)), length_(std::move(length)), angle_(std::move(angle)), rate_(angle_.size(), 0) {}

  vector<Vec3> after(double time, int steps) {
    const double h = time / steps;
    const size_t n = angle_.size();

    for (int k = 0; k < steps; ++k) {
      vector<double> a[4], r[4];
      const double at[] = {0, 0.5, 0.5, 1};
      for (int s = 0; s < 4; ++s) {
        vector<double> angle = angle_, rate = rate_;
        for (size_t i = 0; s > 0 && i < n; ++i) {
          angle[i] += h * at[s] * r[s - 1][i];
          rate[i] += h * at[s] * a[s - 1][i];
        }
        a[s] = accelerations(angle, rate);
        r[s] = rate;
      }

      for (size_t i = 0; i < n; ++i) {
        angle_[i] += h / 6 * (r[0][i] + 2 * r[1][i] + 2 * r[2][i] + r[3][i]);
        rate_[i] += h / 6 * (a[0][i] + 2 * a[1][i] + 2 * a[2][i] + a[3][i]);
      }
    }

    vector<Vec3> x;
    Vec3 end = Vec3::Zero();
    for (size_t i = 0; i < n; ++i) x.push_back(end += length_[i] * Vec3(std::sin(angle_[i]), -std::cos(angle_[i]), 0));
    return x;
  }

 private:
  vector<double> accelerations(const vector<double>& angle, const vector<double>& rate) const {
    const auto n = static_cast<Eigen::Index>(angle.size());
    Eigen::MatrixXd inertia(n, n);
    Eigen::VectorXd torque(n);
    const auto below = [&](Eigen::Index i) {
      double sum = 0;
      for (auto k = static_cast<size_t>(i); k < mass_.size(); ++k) sum += mass_[k];
      return sum;
    };

    for (Eigen::Index i = 0; i < n; ++i) {
      const auto p = static_cast<size_t>(i);
      torque[i] = -below(i) * g_n * length_[p] * std::sin(angle[p]);
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto q = static_cast<size_t>(j);
        const double both = below(std::max(i, j)) * length_[p] * length_[q];
        inertia(i, j) = both * std::cos(angle[p] - angle[q]);
        torque[i] -= both * std::sin(angle[p] - angle[q]) * rate[q] * rate[q];
      }
    }

    const Eigen::VectorXd a = inertia.ldlt().solve(torque);
    return {a.data(), a.data() + n};
  }

  vector<double> mass_, length_, angle_, rate_;  // kg, m, rad, rad/s
};

TEST(Strings, AChainMovesAsLagrangesEquationsOfItsAnglesSay) {
  SLOW_WITH_SANITIZERS();
  for (const bool rod : {false, true})
    for (const int n : {2, 3, 5, 10}) {
      Tied problem;
      vector<double> mass, length, angle;
      Vec3 end = Vec3::Zero();

      for (int k = 0; k < n; ++k) {
        mass.push_back(1 + 0.5 * (k % 3));
        angle.push_back((rod ? 1.2 : 0.4) + 0.05 * (k % 2));
        const Vec3 next = end + (0.5 + 0.125 * (k % 2)) * Vec3(std::sin(angle.back()), -std::cos(angle.back()), 0);

        const Entity i = problem.ball(next, {0, 0, 0}, mass.back(), 0.05);
        length.push_back((next - end).norm());
        String& s = k == 0 ? problem.anchored(i, {0, 0, 0}, length.back()) : problem.between(i, i - 1, length.back());
        s.rod = rod;
        end = next;
      }

      problem.options.duration = 0.6;
      const Outcome run = run_exact(problem);
      EXPECT_TRUE(run.collisions.empty()) << n;

      const vector<Vec3> x = ChainReference(mass, length, angle).after(0.6, 12000);
      for (Entity i = 0; i < x.size(); ++i)
        EXPECT_LT((run.end.position[i] - x[i]).norm(), 1e-11) << rod << " " << n << ": " << i;
      EXPECT_NEAR(residual(problem, run), 0, 1e-9);
    }
}

/// Balls in a plane or in space, some of them tied to each other or to anchors.
Tied random_ties(unsigned seed) {
  Random random(seed);
  const auto below = [&](int n) { return static_cast<int>(random(0, n)); };

  Tied problem;
  if (below(5) == 0) problem.world.gravity.setZero();
  if (below(2) == 0) problem.plane({0, 0, 0}, {0, 1, 0});
  const bool flat = below(3) == 0;
  const auto anywhere = [&](double low, double high) {
    return Vec3(random(-1, 1), random(low, high), flat ? 0 : random(-1, 1));
  };
  const int count = 2 + below(7);

  while (static_cast<int>(problem.world.body_count()) < count) {
    const Vec3 x = anywhere(0.2, 2.2);
    const double radius = random(0.05, 0.15);
    bool free = true;
    for (Entity i = 0; i < problem.world.body_count(); ++i)
      free = free && (problem.initial.position[i] - x).norm() > radius + problem.world.radius[i];
    if (free) problem.ball(x, 2 * anywhere(-1, 1), random(0.5, 3), radius, 0.5 * below(3));
  }

  for (int k = 0; k < count; ++k) {
    const auto body = static_cast<Entity>(below(count)), other = static_cast<Entity>(below(count));
    const bool anchored = body == other || below(2) == 0;
    const Vec3 anchor = anywhere(1, 3);

    const double apart =
        (problem.initial.position[body] - (anchored ? anchor : problem.initial.position[other])).norm();
    String& s = anchored ? problem.anchored(body, anchor, apart) : problem.between(body, other, apart);
    s.rod = below(4) == 0;

    if (s.rod) continue;
    s.length *= below(3) == 0 ? 1 : random(1, 1.5);
    s.restitution = below(3) == 0 ? random(0, 1) : 0;
  }

  problem.options.duration = 0.5;
  return problem;
}

// Measured in 700 such scenes: no string was longer by more than 1.4e-12 m.
TEST(Strings, NeitherLengthsNorEnergyDriftAmongBallsTiedAtRandom) {
  double farthest = 0, residue = 0;  // m, J
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Tied problem = random_ties(seed);
    const auto simulator = make_exact_simulator(problem.world, problem.initial, problem.options);

    double fastest = 0;  // m/s
    for (int k = 1; k <= 512; ++k) {
      go_to(*simulator, k / 1024.0);
      for (const Vec3& v : simulator->state().velocity) fastest = std::max(fastest, v.norm());
      const vector<Vec3>& x = simulator->state().position;
      for (const String& s : problem.world.strings) {
        const double over = (x[s.body] - (s.other == no_entity ? s.anchor : x[s.other])).norm() - s.length;
        farthest = std::max(farthest, s.rod ? std::abs(over) : over);
      }
    }

    const Tally& tally = simulator->tally();
    // Also of a body that a jerk reaches through others.
    EXPECT_LE(fastest, tally.fastest.speed * (1 + 1e-12)) << seed;

    residue = std::max(
        residue, std::abs(energy(problem, simulator->state()) - energy(problem, problem.initial) + tally.energy_lost));
    EXPECT_EQ(tally.doubts.contacts, 0u) << seed;
    EXPECT_EQ(tally.stepped_contact, 0) << seed;
  }

  EXPECT_LT(farthest, 2e-12);
  EXPECT_LT(residue, 1e-9);
}

TEST(Strings, AFrameWithMoreRodsThanItNeedsMovesAsARigidBody) {
  // A square with both diagonals, in a plane; a tetrahedron with a fifth point.
  for (const bool flat : {true, false}) {
    Tied problem;
    const vector<Vec3> at = flat ? vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}
                                 : vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    const Vec3 turn(0, 0, 2);

    Vec3 center = Vec3::Zero(), drift = Vec3::Zero();
    for (const Vec3& x : at) {
      problem.ball(x, turn.cross(x), 1, 0.05);
      center += x / static_cast<double>(at.size());
      drift += turn.cross(x) / static_cast<double>(at.size());
    }

    for (Entity i = 0; i < at.size(); ++i)
      for (Entity j = 0; j < i; ++j) problem.between(i, j, (at[i] - at[j]).norm()).rod = true;

    problem.options.duration = 2;
    const Outcome run = run_exact(problem);
    EXPECT_EQ(run.tally.doubts.contacts, 0u) << flat;

    for (Entity i = 0; i < at.size(); ++i)
      for (Entity j = 0; j < i; ++j)
        EXPECT_NEAR((run.end.position[i] - run.end.position[j]).norm(), (at[i] - at[j]).norm(), 1e-12) << flat;

    if (!flat) continue;
    const auto seen = [&](const Vec3& d) {
      const double c = std::cos(4.0), s = std::sin(4.0);
      return Vec3(c * d.x() - s * d.y(), s * d.x() + c * d.y(), 0);
    };

    const Vec3 now = center + 2 * drift - Vec3(0, 2 * g_n, 0);
    for (Entity i = 0; i < 4; ++i) EXPECT_LT((run.end.position[i] - now - seen(at[i] - center)).norm(), 1e-11) << i;
  }
}

}  // namespace
}  // namespace carom
