// The parts of the stepped simulator that move bodies: clusters, the impact predictor, releases, impacts, the contact
// group, views.
#include <gtest/gtest.h>

#include <cmath>

#include "physics/touch.h"
#include "simulate/build.h"
#include "simulate/stepped_binding.h"
#include "simulate/stepped_group.h"
#include "simulate/stepped_impact_predictor.h"
#include "simulate/stepped_impacts.h"
#include "simulate/stepped_motion.h"
#include "simulate/stepped_releases.h"
#include "simulate/stepped_view.h"

namespace carom {
namespace {

constexpr double g = 10;  // m/s^2

SteppedOptions steps_of(double step) {
  SteppedOptions options;
  options.duration = 100;
  options.step = step;
  return options;
}

/// All parts, at the beginning of the first step.
struct Parts {
  explicit Parts(const Problem& problem, double step = 0.01) : shared(problem.world, problem.initial, steps_of(step)) {
    shared.clock.advance();
  }
  void begin_all() {
    for (const Entity i : shared.awake.list()) motion.begin(i);
  }

  StepShared shared;
  StepMotion motion{shared};
  StepEvents events{shared.paths};
  StepImpactPredictor predictor{shared, events};
  ClusterBinding binding{shared, motion, predictor.neighbours()};
  StepImpacts impacts{shared, motion, predictor, binding, events};
  ContactGroup group{shared, motion, predictor};
  StepView view{shared, motion.of_clusters(), group};
};

/// A ball of 2 kg on a fixed one, both of 0.5 m, at this angle from the top, sliding down at this speed (m/s).
Problem ball_on_ball(double angle, double speed) {
  Problem problem;
  problem.world.gravity = {0, -g, 0};
  problem.ball({std::sin(angle), std::cos(angle), 0}, {speed * std::cos(angle), -speed * std::sin(angle), 0}, 2, 0.5,
               0);
  problem.obstacle({0, 0, 0}, Volume::sphere(0.5));
  return problem;
}

/// Balls of 1 kg and 0.5 m one on another on a floor, e = 0.
Problem tower(int balls, double speed = 0) {
  Problem problem;
  problem.world.gravity = {0, -g, 0};
  for (int k = 0; k < balls; ++k) problem.ball({0, 0.5 + k, 0}, {0, -speed, 0}, 1, 0.5, 0);
  problem.plane({0, 0, 0}, {0, 1, 0});
  return problem;
}

std::uint32_t make_cluster(Parts& parts, std::vector<ClusterContact> contacts) {
  const std::uint32_t c = parts.shared.clusters.create();
  parts.shared.clusters.add(c, 0);
  parts.shared.clusters[c].contacts = std::move(contacts);
  parts.shared.clusters[c].order_bodies();
  return c;
}

TEST(ClusterMotion, KeepsToTheSurfaceOfAnActiveContact) {
  const Problem problem = ball_on_ball(0.3, 1);
  Parts parts(problem);
  const Cluster& cluster = parts.shared.clusters[make_cluster(parts, {{0, 1, 0, true, 0}})];
  ClusterState state = parts.motion.of_clusters().start(cluster);
  parts.motion.of_clusters().carry(cluster, 0.01, state);
  EXPECT_NEAR(state.end_x[0].norm(), 1, 1e-15);
  EXPECT_NEAR(state.end_v[0].dot(state.end_x[0]), 0, 1e-15);
  const double energy = state.end_v[0].squaredNorm() / 2 + g * state.end_x[0].y();
  EXPECT_NEAR(energy, 0.5 + g * std::cos(0.3), 1e-9);
}

TEST(ClusterMotion, ForceOfAnActiveContactIsWeightLessWhatTheBendTakes) {
  const Problem problem = ball_on_ball(0.3, 1);
  Parts parts(problem);
  const Cluster& cluster = parts.shared.clusters[make_cluster(parts, {{0, 1, 0, true, 0}})];
  const ClusterState state = parts.motion.of_clusters().start(cluster);
  std::vector<Vec3> a(1);
  std::vector<ContactConstraint> pairs;
  parts.motion.of_clusters().accelerate(cluster, state, state.x, state.v, a, pairs);
  EXPECT_NEAR(pairs[0].force, 2 * (g * std::cos(0.3) - 1), 1e-13);
}

TEST(ClusterMotion, MakesAContactActiveThatClosesOnItsPath) {
  const Problem problem = tower(1);
  Parts parts(problem);
  Cluster& cluster = parts.shared.clusters[make_cluster(parts, {{0, 1, 0, false, 0}})];
  ClusterState state = parts.motion.of_clusters().start(cluster);
  parts.motion.of_clusters().carry_and_activate(cluster, 0.01, state);
  EXPECT_TRUE(cluster.contacts[0].active);
  EXPECT_EQ(state.end_x[0].y(), 0.5);
}

TEST(ClusterBinding, OfATowerAtRestSleepsUnderItsForces) {
  const Problem problem = tower(3);
  Parts parts(problem);
  std::vector<Entity> bodies = {1};
  parts.binding.bind(bodies, 0);
  EXPECT_EQ(bodies, (std::vector<Entity>{0, 1, 2}));
  ASSERT_TRUE(parts.shared.clusters.asleep(2));
  const Cluster& cluster = parts.shared.clusters[parts.shared.clusters.of(0)];
  ASSERT_EQ(cluster.contacts.size(), 3u);
  EXPECT_NEAR(cluster.contacts[1].force, 3 * g, 1e-12);  // the first body's with the second, then with the floor
  EXPECT_EQ(parts.shared.log.tally().resting, 3u);
}

TEST(ClusterBinding, BooksTheApproachThatContactTakes) {
  const Problem problem = tower(2, 0.01);
  Parts parts(problem);
  std::vector<Entity> bodies = {0};
  parts.binding.bind(bodies, 0);
  EXPECT_EQ(parts.shared.paths.v[1].norm(), 0);
  EXPECT_NEAR(parts.shared.log.tally().energy_lost, 2 * 0.5 * 0.01 * 0.01, 1e-18);
}

TEST(ClusterBinding, LeavesBodiesAloneThatSeparate) {
  const Problem problem = tower(1, -1);
  Parts parts(problem);
  std::vector<Entity> bodies = {0};
  parts.binding.bind(bodies, 0);
  EXPECT_FALSE(parts.shared.clusters.holds(0));
}

TEST(StepImpactPredictor, FindTheTimeAtWhichTwoPathsMeet) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({2, 0, 0}, {-1, 0, 0});
  problem.ball({50, 0, 0}, {-1, 0, 0});
  Parts parts(problem, 1);
  parts.begin_all();
  parts.predictor.predict_step();
  StepEvent event;
  ASSERT_TRUE(parts.events.pop(event));
  EXPECT_EQ(event.time, 0.5);
  EXPECT_EQ(event.b, 1u);
  EXPECT_FALSE(parts.events.pop(event));
}

// A ball leaves another one where the force turns to zero: cos(angle) = v^2 / g at a distance of 1 m.
TEST(Releases, ComeWhereTheForceTurnsToZero) {
  const double angle = 0.8, speed = std::sqrt(g * std::cos(angle)) - 0.01;
  const Problem problem = ball_on_ball(angle, speed);
  Parts parts(problem);
  Cluster& cluster = parts.shared.clusters[make_cluster(parts, {{0, 1, 0, true, 0}})];
  parts.motion.begin(cluster);
  predict_releases(parts.shared, parts.motion.of_clusters(), cluster, parts.events);
  StepEvent event;
  ASSERT_TRUE(parts.events.pop(event));
  EXPECT_EQ(event.kind, StepEventKind::release);
  ClusterState state = parts.motion.of_clusters().start(cluster);
  parts.motion.of_clusters().carry(cluster, event.time, state);
  EXPECT_NEAR(state.end_v[0].squaredNorm(), g * state.end_x[0].y(), 1e-6);
}

TEST(StepImpacts, OfEqualElasticBallsSwapVelocities) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({2, 0, 0}, {-1, 0, 0});
  Parts parts(problem, 1);
  parts.begin_all();
  parts.predictor.predict_step();
  for (StepEvent event; parts.events.pop(event);) parts.impacts.process(event);
  EXPECT_EQ(parts.shared.paths.end_v[0], Vec3(-1, 0, 0));
  EXPECT_EQ(parts.shared.paths.end_x[1], Vec3(2, 0, 0));
  ASSERT_EQ(parts.shared.log.collisions().size(), 1u);
  EXPECT_EQ(parts.shared.log.collisions()[0].time, 0.5);
  EXPECT_EQ(parts.shared.paths.pieces.size(), 2u);
}

TEST(StepImpacts, ThatComeToRestEndInContact) {
  Problem problem = tower(1);
  problem.initial.position[0].y() = 0.50001;  // reached at 0.014 m/s
  Parts parts(problem);
  parts.begin_all();
  parts.predictor.predict_step();
  for (StepEvent event; parts.events.pop(event);) parts.impacts.process(event);
  EXPECT_TRUE(parts.shared.clusters.holds(0));
  EXPECT_NEAR(parts.shared.paths.end_x[0].y(), 0.5, 1e-15);
}

TEST(StepView, ShowsABodyBeforeAndAfterAnImpactInTheStep) {
  Problem problem;
  problem.ball({0, 0, 0}, {1, 0, 0});
  problem.ball({2, 0, 0}, {-1, 0, 0});
  Parts parts(problem, 1);
  parts.begin_all();
  parts.predictor.predict_step();
  for (StepEvent event; parts.events.pop(event);) parts.impacts.process(event);
  EXPECT_EQ(parts.view.state(0.25).position[0], Vec3(0.25, 0, 0));
  parts.view.clear();
  EXPECT_EQ(parts.view.state(0.75).position[0], Vec3(0.25, 0, 0));
  EXPECT_EQ(parts.view.state(0.75).velocity[0], Vec3(-1, 0, 0));
}

TEST(StepView, GivesForcesInOrderWithoutChangingWhatTheyAre) {
  const Problem problem = tower(3);
  Parts parts(problem);
  std::vector<Entity> bodies = {1};
  parts.binding.bind(bodies, 0);
  for (int again = 0; again < 2; ++again) {
    const auto forces = parts.view.forces(0.005);
    ASSERT_EQ(forces.size(), 3u);
    EXPECT_NEAR(forces[0].force, 2 * g, 1e-12);
    EXPECT_NEAR(forces[1].force, 3 * g, 1e-12);
    EXPECT_NEAR(forces[2].force, g, 1e-12);
  }
}

GroupBodies all_bodies(const Parts& parts) {
  GroupBodies bodies;
  const StepShared& s = parts.shared;
  for (const Entity i : s.awake.list())
    bodies.add(s.world, i, s.paths.x[i], s.paths.v[i], s.free.acceleration(i, s.paths.x[i], s.paths.v[i]));
  return bodies;
}

TEST(GroupContacts, FindEachPairOnceAndMoreAtAHigherSpeed) {
  Problem problem = tower(3);
  problem.ball({3, 0.5, 0}, {0, 0, 0});
  Parts parts(problem);
  parts.begin_all();
  for (const Entity i : parts.shared.awake.list()) parts.predictor.cover_path(i);
  const GroupBodies bodies = all_bodies(parts);
  GroupContacts contacts(parts.shared, parts.predictor, true);
  contacts.start(bodies, 0.1);
  contacts.find(bodies);
  EXPECT_EQ(contacts.list().size(), 4u);  // three of the tower, two of them with another ball, and one of the last ball
  EXPECT_TRUE(contacts.searched(0));
  contacts.find(bodies);
  EXPECT_EQ(contacts.list().size(), 4u);
  contacts.raise(0, 210);
  EXPECT_FALSE(contacts.searched(0));
  contacts.find(bodies);
  EXPECT_EQ(contacts.list().size(), 5u);  // 2 m to the last ball
}

TEST(GroupForces, AreThoseOfTheLastStep) {
  const Problem problem = tower(2);
  const Parts parts(problem);
  const GroupBodies bodies = all_bodies(parts);
  GroupForces forces(2);
  GroupContact contact{0, 1, 0, 1, {0, 1, 0}, 0, 0};
  contact.impulse = 0.2;
  forces.remember(bodies, {contact}, 0.01);
  EXPECT_EQ(forces.between(0, 1), 20);
  EXPECT_EQ(forces.between(0, 2), 0);
  forces.remember(bodies, {}, 0.01);
  EXPECT_EQ(forces.between(0, 1), 0);
}

TEST(GroupStep, LetsATowerStand) {
  const Problem problem = tower(4);
  Parts parts(problem);
  const GroupBodies bodies = all_bodies(parts);
  GroupContacts contacts(parts.shared, parts.predictor, false);
  contacts.start(bodies, g * 0.01);
  parts.begin_all();
  for (const Entity i : parts.shared.awake.list()) parts.predictor.cover_path(i);
  contacts.find(bodies);
  GroupStep step(parts.shared);
  step.find_velocities(bodies, contacts.list());
  step.find_displacements(bodies, contacts.list());
  step.find_pressed(bodies, contacts.list());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_LT(step.end_v(k).norm(), 0.05 * 2 * g * 0.01) << k;  // the accuracy of velocities, by a step's fall
    EXPECT_LT(step.drift(k).norm() * 0.01, 2e-3) << k;          // the overlap that is allowed
    EXPECT_TRUE(step.pressed(k)) << k;
  }
}

TEST(GroupRest, PutsAPartToSleepThatHasBeenSlowForAWhile) {
  const Problem problem = tower(3);
  Parts parts(problem);
  const GroupBodies bodies = all_bodies(parts);
  GroupRest rest(parts.shared, parts.predictor);
  GroupContacts contacts(parts.shared, parts.predictor, false);
  contacts.start(bodies, g * 0.01);
  parts.begin_all();
  for (const Entity i : parts.shared.awake.list()) {
    parts.predictor.cover_path(i);
    parts.shared.paths.stay(i);
  }
  contacts.find(bodies);
  for (std::uint32_t k = 0; k < stepped_tolerance::slow_steps; ++k) {
    rest.put_to_rest(bodies, contacts.list());
    EXPECT_FALSE(parts.shared.clusters.any_asleep());
    for (const Entity i : bodies.entity) rest.note(i, true, 0, g);
  }
  rest.put_to_rest(bodies, contacts.list());
  ASSERT_TRUE(parts.shared.clusters.asleep(0) && parts.shared.clusters.asleep(2));
  double floor = 0;
  for (const ContactForce& force : parts.view.forces(0))
    if (force.b == 3) floor += force.force;
  EXPECT_NEAR(floor, 3 * g, 1e-5);
}

TEST(ContactGroup, TakesInWhatItsBodiesMayMeetAndGivesTheForces) {
  const Problem problem = tower(3);
  Parts parts(problem);
  parts.shared.group.join(0);
  parts.begin_all();
  parts.group.step();
  EXPECT_TRUE(parts.shared.group.from_start(2));
  EXPECT_EQ(parts.shared.log.tally().resting, 3u);
  std::vector<ContactForce> forces;
  parts.group.add_forces(forces);
  double floor = 0;
  for (const ContactForce& force : forces)
    if (force.b == 3) floor += force.force;
  EXPECT_NEAR(floor, 3 * g, 0.05 * 3 * g);
  EXPECT_GT(parts.shared.paths.end_x[0].y(), 0.5 - 1e-3);
}

}  // namespace
}  // namespace carom
