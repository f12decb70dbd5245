// The record of a motion on its way from the thread that simulates to the one that draws.
#include "run/record_queue.h"
#include "std.h"

#include <gtest/gtest.h>

#include <thread>

namespace carom {
namespace {

/// A simulator that has recorded these.
class Recorder final : public Simulator {
 public:
  void advance_to(double time) override { time_ = time; }
  double time() const override { return time_; }
  const State& state() override { return state_; }
  span<const Collision> collisions() const override { return collided; }
  span<const PathPiece> paths() const override { return pieces; }
  const Tally& tally() const override { return tally_; }

  vector<Collision> collided;
  vector<PathPiece> pieces;

 private:
  double time_ = 0;
  State state_;
  Tally tally_;
};

Collision collision(double time) {
  return {time, CollisionKind::body_body, 0, 1, Vec3::Zero(), Vec3::UnitX(), 1, 1, 1, 1, 0};
}

PathPiece piece(Entity body, double from) {
  return {body, from, {from, 0}};
}

vector<Recorded> all_of(RecordQueue& queue) {
  vector<Recorded> all;
  for (Recorded next; queue.next(next);) all.push_back(next);
  return all;
}

TEST(RecordQueue, PassesCollisionsJustBeforeThePiecesThatBeginWithThem) {
  // The second collision is between two doubles: its pieces hold from the later one on.
  const double late = std::nextafter(0.2, 1);
  Recorder simulator;
  simulator.collided = {collision(0.1), collision(0.2), collision(0.5)};
  simulator.pieces = {piece(0, 0.1), piece(1, 0.1), piece(0, late), piece(2, 0.3)};

  RecordQueue queue;
  queue.put(simulator);
  queue.end(true);
  const vector<Recorded> all = all_of(queue);
  ASSERT_EQ(all.size(), 7u);

  using Kind = Recorded::Kind;
  const Kind kinds[] = {Kind::collision, Kind::piece, Kind::piece,    Kind::collision,
                        Kind::piece,     Kind::piece, Kind::collision};
  const double times[] = {0.1, 0.1, 0.1, late, late, 0.3, 0.5};
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].kind, kinds[i]) << i;
    EXPECT_EQ(all[i].from(), times[i]) << i;
  }
}

TEST(RecordQueue, HoldsABoundedNumberOfPartsAndLosesNone) {
  RecordQueue queue;
  std::thread writer([&queue] {
    Recorder simulator;
    for (int i = 0; i < 100'000; ++i) {
      simulator.pieces = {piece(0, i), piece(1, i)};
      queue.put(simulator);
    }
    queue.end(true);
  });

  const vector<Recorded> all = all_of(queue);
  writer.join();
  ASSERT_EQ(all.size(), 200'000u);
  for (size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].from(), static_cast<double>(i / 2));
}

TEST(RecordQueue, WithoutAReaderDoesNotHoldTheSimulationUp) {
  RecordQueue queue;
  Recorder simulator;
  simulator.pieces = {piece(0, 0)};
  std::thread reader([&queue] { queue.leave(); });
  for (int i = 0; i < 100'000; ++i) queue.put(simulator);
  reader.join();
}

TEST(RecordQueue, OfASimulationThatFailsEndsWithWhatWasRecordedAndAnError) {
  RecordQueue queue;
  Recorder simulator;
  simulator.pieces = {piece(0, 0)};
  queue.put(simulator);
  queue.end(false);
  Recorded next;
  EXPECT_TRUE(queue.next(next));
  EXPECT_THROW(queue.next(next), RecordAbandoned);
}

}  // namespace
}  // namespace carom
