// The kernels that test many pairs at a time against the laws for one pair, for every width of the processor.
#include <gtest/gtest.h>

#include <numeric>

#include "geometry/contact_time.h"
#include "simulate/loop/straight_times.h"
#include "simulate/random.h"
#include "simulate/space/touching.h"
#include "std.h"

namespace carom {
namespace {

/// When i and j meet, by the law for a single pair.
Instant time_of(const Flights& flights, const vector<double>& radius, Entity i, Entity j, double end) {
  const Flight p = flights[i], q = flights[j];
  const Instant base = p.start < q.start ? q.start : p.start;
  const double tp = base - p.start, tq = base - q.start;
  const RelativeMotion m{q.position(tq) - p.position(tp), q.velocity(tq) - p.velocity(tp), Vec3::Zero(), 0, false};
  const double t = sphere_contact_time(m, radius[i] + radius[j], Instant{end, 0} - base);
  return t == never ? Instant{never, 0} : base + t;
}

class StraightTimes : public ::testing::TestWithParam<bool> {};

/// The kernels give the law's bits. Touching and grazing pairs and a few others are left to the law.
TEST_P(StraightTimes, HasTheBitsOfTheLawForEveryWidth) {
  constexpr Entity bodies = 400;
  constexpr double end = 3;
  const Vec3 a = GetParam() ? Vec3(0.3, -9.81, 0) : Vec3(Vec3::Zero());
  Random random;
  Flights flights(bodies, a);

  vector<double> radius(bodies), same(bodies, 0.5);
  for (Entity i = 0; i < bodies; ++i) {
    radius[i] = random(0.1, 0.6);
    flights.set(i, {Instant{random(0, 1), 0} + 0x1p-60, in_cube(random, 4), in_cube(random, 2), a});
  }
  flights.set(0, {Instant{1, 0}, Vec3::Zero(), Vec3(1, 0, 0), a});
  // Touching, grazing, and just apart.
  flights.set(1, {Instant{1, 0}, Vec3(1, 0, 0), Vec3(-1, 0, 0), a});
  flights.set(2, {Instant{1, 0}, Vec3(5, 1, 0), Vec3(-1, 0, 0), a});
  flights.set(3, {Instant{1, 0}, Vec3(1 + 0x1p-40, 0, 0), Vec3(-1, 0, 0), a});

  vector<Entity> others(bodies - 1);
  std::iota(others.begin(), others.end(), Entity{1});

  for (const StraightKernel kernel : straight_kernels()) {
    int met = 0, left = 0;
    for (const bool alike : {false, true})
      for (Entity i = 0; i < 40; ++i)
        for (const size_t count : {1u, 2u, 5u, 8u, 17u, 399u}) {
          vector<Entity> partners(others.begin(), others.begin() + static_cast<ptrdiff_t>(count));
          std::erase(partners, i);
          const vector<double>& r = alike ? same : radius;
          vector<Meet> found(partners.size());
          bool latest = true;
          for (const Entity j : partners) latest = latest && flights[j].start <= flights[i].start;

          for (const bool latest_only : {false, latest}) {
            const size_t impacts = kernel(
                {flights.cores(), alike ? nullptr : r.data(), r[i], i, partners, a, latest_only, end}, found.data());

            // Each body is one of them, or none by the law either.
            size_t next = 0;
            for (const Entity j : partners) {
              const Instant law = time_of(flights, r, i, j, end);
              if (next < impacts && found[next].with == j) {
                const Instant time = found[next++].time;
                if (time.hi == unsure) {
                  ++left;
                  continue;
                }

                EXPECT_EQ(time, law) << i << " and " << j;
                ++met;
              } else {
                EXPECT_EQ(law.hi, never) << i << " and " << j;
              }
            }

            EXPECT_EQ(next, impacts);
          }
        }

    EXPECT_GT(met, 500);
    EXPECT_GT(left, 3);
    EXPECT_LT(left, met / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Fall, StraightTimes, ::testing::Bool());

TEST(Touching, IsTheSameForEveryWidth) {
  Random random;
  vector<Region> regions(300);
  for (Region& r : regions) {
    const Vec3 at = in_cube(random, 4);
    r = {static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z()),
         static_cast<float>(random(0.1, 2))};
  }

  regions[1] = regions[0];
  regions[2].half = std::numeric_limits<float>::infinity();

  vector<Entity> bodies(regions.size());
  std::iota(bodies.begin(), bodies.end(), Entity{0});

  for (const SelectKernel kernel : select_kernels())
    for (const size_t count : {0u, 1u, 3u, 4u, 15u, 16u, 17u, 299u})
      for (const bool touching : {false, true})
        for (const Region& region : regions) {
          vector<Entity> expected;
          for (size_t k = 0; k < count; ++k)
            if (may_touch(region, regions[k]) == touching) expected.push_back(bodies[k]);

          vector<Entity> found(bodies);
          found.resize(bodies.size() + select_slack);
          found.resize(kernel(region, regions.data(), found.data(), count, touching, found.data()));
          ASSERT_EQ(found, expected);
        }
}

}  // namespace
}  // namespace carom
