// The parts of the stepped simulator that hold its data: clock, paths, events, clusters, members, counts.
#include <gtest/gtest.h>

#include "physics/contact_problem.h"
#include "physics/disjoint_sets.h"
#include "simulate/build.h"
#include "simulate/stepped_awake.h"
#include "simulate/stepped_bounces.h"
#include "simulate/stepped_clock.h"
#include "simulate/stepped_clusters.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_free_motion.h"
#include "simulate/stepped_group_members.h"
#include "simulate/stepped_paths.h"
#include "simulate/stepped_places.h"

namespace carom {
namespace {

Problem two_balls() {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({5, 0, 0}, {-1, 0, 0});
  problem.plane({0, -1, 0}, {0, 1, 0});
  return problem;
}

TEST(StepClock, StepsEndAtMultiplesWhereForcesChangeAndAtTheEnd) {
  World world;
  world.forces = {{Drag{1, 0.5, Vec3::Zero()}, 0.25, 0.7}};
  StepClock clock(world, 1.05, 0.1);
  std::vector<double> ends, changes;
  while (clock.to() < clock.duration()) {
    clock.advance();
    ends.push_back(clock.to());
    if (clock.forces_change()) changes.push_back(clock.from());
  }
  const std::vector<double> expected = {0.1, 0.2,     0.25,    3 * 0.1, 4 * 0.1,  5 * 0.1, 6 * 0.1,
                                        0.7, 7 * 0.1, 8 * 0.1, 9 * 0.1, 10 * 0.1, 1.05};
  EXPECT_EQ(ends, expected);  // 7 * 0.1 is one rounding above 0.7
  EXPECT_EQ(changes, (std::vector<double>{0.25, 0.7}));
}

TEST(StepClock, RefusesStepsThatDoNotMoveIt) {
  StepClock clock(World(), 1e20, 1e19);
  clock.advance();
  StepClock still(World(), 1, 0);
  EXPECT_THROW(still.advance(), SimulationError);
}

TEST(FreeMotion, UnderConstantForcesIsTheMethodsOwnStep) {
  Problem problem = two_balls();
  problem.world.gravity = {0, -10, 0};
  const StepClock clock(problem.world, 1, 0.5);
  for (const auto& [method, fall] :
       {std::pair(Integrator::euler, 2.5), std::pair(Integrator::verlet, 1.25), std::pair(Integrator::rk4, 1.25)}) {
    SteppedOptions options;
    options.integrator = method;
    const FreeMotion free(problem.world, options, clock);
    Vec3 x = {0, 0, 0}, v = {1, 0, 0};
    Path path;
    free.carry(0, 0.5, x, v, path);
    EXPECT_EQ(x, Vec3(0.5, -fall, 0));
    EXPECT_EQ(v, Vec3(1, -5, 0));
    EXPECT_EQ(path.position(0.5), x);
  }
}

TEST(FreeMotion, BooksTheKineticEnergyThatDragTakesAsWork) {
  Problem problem = two_balls();
  problem.world.forces = {{Drag{1, 0, Vec3::Zero()}}};
  const StepClock clock(problem.world, 1, 0.01);
  const FreeMotion free(problem.world, {}, clock);
  EXPECT_TRUE(free.works());
  EXPECT_FALSE(free.constant());
  const Vec3 x0 = {1, 0, 0}, v0 = {3, 1, 0};
  Vec3 x = x0, v = v0;
  Path path;
  free.carry(0, 0.01, x, v, path);
  const double gain = 0.5 * (v.squaredNorm() - v0.squaredNorm());
  EXPECT_NEAR(free.work(0, x0, v0, x, v, 0.01), gain, 1e-9 * std::abs(gain));
}

TEST(FreeMotion, BooksNoWorkOfASpringThatActsForEver) {  // it has a potential
  Problem problem = two_balls();
  problem.world.forces = {{Spring{{0, 0, 0}, 4, 0, 0}}};
  const StepClock clock(problem.world, 1, 0.01);
  const FreeMotion free(problem.world, {}, clock);
  EXPECT_EQ(free.work(0, {1, 0, 0}, {0, 1, 0}, {1, 0.01, 0}, {0, 1, 0}, 0.01), 0);
}

TEST(StepPaths, ACutPathIsKeptAsAPieceAndHasANewVersion) {
  const Problem problem = two_balls();
  StepPaths paths(problem.world, problem.initial);
  paths.cut(0, 0.25, {0.25, 0, 0}, {2, 0, 0}, false);
  ASSERT_EQ(paths.pieces.size(), 1u);
  EXPECT_EQ(paths.pieces[0].to, 0.25);
  EXPECT_EQ(paths.pieces[0].path.v, Vec3(1, 0, 0));
  EXPECT_EQ(paths.start[0], 0.25);
  EXPECT_EQ(paths.version_of(0), 1u);
  EXPECT_EQ(paths.version_of(1), 0u);
  paths.cut(0, 0.25, {0.25, 0, 0}, {3, 0, 0}, false);
  EXPECT_EQ(paths.pieces.size(), 1u) << "of no length";
}

TEST(StepPaths, FixedThingsStandStill) {
  const Problem problem = two_balls();
  const StepPaths paths(problem.world, problem.initial);
  EXPECT_EQ(paths.from(2, 0.5).position(1), Vec3(0, -1, 0));
  EXPECT_EQ(paths.velocity_of(2), Vec3(0, 0, 0));
}

TEST(StepPaths, ImpulsesOfTheWorldComeFirst) {
  Problem problem = two_balls();
  problem.world.impulse = {Vec3(0, 2, 0), Vec3(0, 0, 0)};
  const StepPaths paths(problem.world, problem.initial);
  EXPECT_EQ(paths.v[0], Vec3(1, 2, 0));
  EXPECT_EQ(paths.end_v[0], paths.v[0]);
}

TEST(StepEvents, ComeByTimeThenReleasesThenByNumber) {
  const Problem problem = two_balls();
  const StepPaths paths(problem.world, problem.initial);
  StepEvents events(paths);
  events.push(0.2, StepEventKind::impact, 0, 1, 0);
  events.push(0.1, StepEventKind::impact, 1, 2, 0);
  events.push(0.1, StepEventKind::impact, 0, 2, 0);
  events.push(0.1, StepEventKind::release, 1, 2, 0);
  std::vector<std::pair<double, Entity>> order;
  for (StepEvent event; events.pop(event);) order.emplace_back(event.time, event.a);
  EXPECT_EQ(order, (std::vector<std::pair<double, Entity>>{{0.1, 1}, {0.1, 0}, {0.1, 1}, {0.2, 0}}));
}

TEST(StepEvents, OfAPathThatHasEndedAreVoid) {
  const Problem problem = two_balls();
  StepPaths paths(problem.world, problem.initial);
  StepEvents events(paths);
  events.push(0.1, StepEventKind::impact, 0, 1, 0);
  events.push(0.2, StepEventKind::impact, 0, 2, 0);
  paths.cut(1, 0.05, {5, 0, 0}, {0, 0, 0}, false);
  StepEvent event;
  ASSERT_TRUE(events.pop(event));
  EXPECT_EQ(event.b, 2u);
  EXPECT_FALSE(events.pop(event));
}

TEST(Clusters, KnowTheirBodiesAndContactsUntilTheyAreTakenApart) {
  Clusters clusters(4);
  const std::uint32_t c = clusters.create();
  clusters.add(c, 3);
  clusters.add(c, 1);
  clusters[c].contacts = {{1, 3, 0, true, 2}, {1, 7, 0, false, 0}};
  clusters[c].order_bodies();
  EXPECT_EQ(clusters[c].bodies, (std::vector<Entity>{1, 3}));
  EXPECT_EQ(clusters[c].contacts[0].of_b, 1u);
  EXPECT_EQ(clusters[c].contacts[1].of_b, ContactConstraint::fixed);
  EXPECT_TRUE(clusters.in_contact(3, 1));
  EXPECT_FALSE(clusters.in_contact(3, 7));
  EXPECT_TRUE(clusters[c].moves());
  clusters.remove(c);
  EXPECT_FALSE(clusters.holds(1));
  EXPECT_FALSE(clusters[c].in_use());
  EXPECT_EQ(clusters.create(), c) << "it is used again";
}

TEST(AwakeBodies, AreInOrderWhereAStepBegins) {
  AwakeBodies awake(4);
  awake.keep_if([](Entity i) { return i > 1; });
  awake.wake(0);
  awake.wake(3);
  EXPECT_EQ(std::vector<Entity>(awake.list().begin(), awake.list().end()), (std::vector<Entity>{2, 3, 0}));
  awake.keep_if([](Entity) { return true; });
  EXPECT_EQ(std::vector<Entity>(awake.list().begin(), awake.list().end()), (std::vector<Entity>{0, 2, 3}));
}

TEST(GroupMembers, LeaveAfterAFewStepsWithoutContact) {
  GroupMembers members(2);
  members.join(1);
  int steps = 0;
  for (; members.joined(1); ++steps) members.count_step(1);
  EXPECT_EQ(steps, stepped_tolerance::group_steps);
  EXPECT_FALSE(members.joined(0));
}

TEST(GroupMembers, ThatCameWithinTheStepHaveACarrierOrStand) {
  GroupMembers members(3);
  members.enter_step(0);
  members.enter_step(1, 0);
  members.enter_step(2, 2);
  EXPECT_TRUE(members.from_start(0) && !members.carried(0) && !members.stands(0));
  EXPECT_TRUE(!members.from_start(1) && members.carried(1) && !members.stands(1));
  EXPECT_TRUE(!members.from_start(2) && !members.carried(2) && members.stands(2));
  EXPECT_FALSE(members.has(7)) << "a fixed thing";
  members.end_step(1);
  EXPECT_FALSE(members.in_step(1));
}

TEST(BounceLimits, EndABounceShorterThanAStep) {
  Problem problem = two_balls();
  SteppedOptions options;
  options.step = 0.01;
  const BounceLimits limits(problem.world, options, true);
  // A bounce at e = 0.5 from 0.1 m/s takes 2 * 0.05 / 10 s.
  EXPECT_FALSE(limits.slow(0.5, 0.1001, 10));
  EXPECT_TRUE(limits.slow(0.5, 0.0999, 10));
  EXPECT_FALSE(limits.slow(1, 0.0001, 10)) << "elastic";
  EXPECT_FALSE(limits.slow(0.5, 0.0001, -1)) << "nothing drives them together";
}

TEST(BounceLimits, EndBouncesThatAccumulateInAStep) {
  Problem problem = two_balls();
  BounceLimits limits(problem.world, {}, true);
  for (std::uint32_t k = 0; k < stepped_tolerance::many_impacts; ++k) limits.count_impact(0, 1, 0.5);
  EXPECT_FALSE(limits.ends_in_contact(0, 1, 0.5, 1, 0, 0));
  limits.count_impact(0, 2, 0.5);
  EXPECT_TRUE(limits.ends_in_contact(0, 1, 0.5, 1, 0, 0));
  EXPECT_FALSE(limits.ends_in_contact(0, 1, 1, 1, 0, 0)) << "elastic";
  EXPECT_TRUE(limits.joins_group(0));
  limits.begin_step(0);
  EXPECT_FALSE(limits.joins_group(0));
}

TEST(BodyPlaces, AreThoseOfTheListThatWasNumberedLast) {
  BodyPlaces places(5);
  const std::vector<Entity> first = {4, 0}, second = {3, 4, 1};
  places.number(first);
  EXPECT_EQ(places[4], 0u);
  places.number(second);
  EXPECT_EQ(places[4], 1u);
  EXPECT_TRUE(places.in(second, 1));
  EXPECT_FALSE(places.in(second, 0));
  EXPECT_FALSE(places.in(second, 2));
}

TEST(DisjointSets, AreOneAfterAJoin) {
  DisjointSets sets(5);
  sets.join(0, 1);
  sets.join(3, 4);
  EXPECT_EQ(sets.root(0), sets.root(1));
  EXPECT_NE(sets.root(0), sets.root(3));
  sets.join(1, 4);
  EXPECT_EQ(sets.root(0), sets.root(3));
  EXPECT_NE(sets.root(2), sets.root(0));
}

}  // namespace
}  // namespace carom
