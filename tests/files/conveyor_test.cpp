// A writer's own thread: it handles every item, in order, with few in flight, and is not started for little work.
#include "files/conveyor.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>

#include "export/export_testing.h"
#include "export/tables.h"
#include "physics/world.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

using namespace testing_export;

TEST(Conveyor, UsesWhatIsSentInOrder) {
  vector<int> used;
  set<const int*> items;
  Conveyor<int> conveyor(
      [&](int& item) {
        used.push_back(item);
        items.insert(&item);
      },
      0);

  for (int i = 0; i < 1000; ++i) {
    conveyor.item() = i;
    conveyor.send();
  }
  conveyor.finish();

  ASSERT_EQ(used.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(used[static_cast<size_t>(i)], i);
  EXPECT_EQ(items.size(), conveyor.items());
}

TEST(Conveyor, ASlowReaderHoldsUpTheWriter) {
  std::atomic<int> used = 0;
  Conveyor<int> conveyor(
      [&](int&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ++used;
      },
      0);
  for (int sent = 1; sent <= 20; ++sent) {
    conveyor.send();
    // The one that is filled next is free.
    EXPECT_LT(sent - used, static_cast<int>(conveyor.items()));
  }
}

TEST(Conveyor, SeveralThreadsUseEachItemOnceAndAtTheSameTime) {
  std::mutex mutex;
  std::condition_variable changed;
  int in_use = 0, most = 0;
  set<int> used;
  Conveyor<int> conveyor(
      [&](int& item) {
        std::unique_lock lock(mutex);
        most = std::max(most, ++in_use);
        changed.notify_all();
        // The first three wait for one another, which a single thread could not do.
        if (item < 3) changed.wait(lock, [&] { return most == 3; });
        --in_use;
        EXPECT_TRUE(used.insert(item).second);
      },
      0, 3);
  EXPECT_EQ(conveyor.items(), 6U);
  for (int i = 0; i < 1000; ++i) {
    conveyor.item() = i;
    conveyor.send();
  }
  conveyor.finish();
  EXPECT_EQ(used.size(), 1000U);
  EXPECT_EQ(most, 3);
}

TEST(Conveyor, OfSeveralFailuresTheFirstItemsIsThrown) {
  for (int round = 0; round < 50; ++round) {
    Conveyor<int> conveyor(
        [&](int& item) {
          if (item == 7) std::this_thread::sleep_for(std::chrono::microseconds(200));
          if (item >= 7) throw runtime_error(to_string(item));
        },
        0, 4);

    string failure;
    try {
      for (int i = 0; i < 20; ++i) {
        conveyor.item() = i;
        conveyor.send();
      }
      conveyor.finish();
    } catch (const runtime_error& error) {
      failure = error.what();
    }
    EXPECT_EQ(failure, "7");
  }
}

TEST(Conveyor, OneForTheSenderAloneStartsNoThread) {
  int used = 0;
  Conveyor<int> conveyor([&](int&) { ++used; }, 0, 0);
  for (int i = 0; i < 100; ++i) conveyor.send();
  EXPECT_FALSE(conveyor.started());
  EXPECT_EQ(conveyor.items(), 1U);
  EXPECT_EQ(used, 100);
}

TEST(Conveyor, LittleWorkStartsNoThread) {
  int used = 0;
  Conveyor<int> conveyor([&](int&) { ++used; }, 3);
  for (int i = 1; i <= 3; ++i) {
    conveyor.send();
    EXPECT_EQ(used, i);
  }
  conveyor.finish();
  EXPECT_FALSE(conveyor.started());
  conveyor.send();
  EXPECT_TRUE(conveyor.started());
  conveyor.finish();
  EXPECT_EQ(used, 4);
}

TEST(Conveyor, WhatFailsThereIsThrownHere) {
  for (const uint64_t alone : {0U, 100U}) {
    int used = 0;
    Conveyor<int> conveyor(
        [&](int&) {
          if (++used == 5) throw runtime_error("the disk is full");
        },
        alone);

    const auto send_all = [&] {
      for (int i = 0; i < 20; ++i) conveyor.send();
      conveyor.finish();
    };
    EXPECT_THROW(send_all(), runtime_error);
    EXPECT_EQ(used, 5);
  }
}

TEST(Conveyor, IsLeftWithoutUsingWhatWaits) {
  std::atomic<int> used = 0;
  {
    Conveyor<int> conveyor(
        [&](int&) {
          ++used;
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        },
        0);

    conveyor.send();
    while (used == 0) std::this_thread::yield();
    conveyor.send();
    conveyor.send();
  }
  EXPECT_EQ(used, 1);
}

// Numbers that differ from one another in length, so that no two rows end at the same place of a piece.
State many_bodies(Entity count, double time) {
  State state;
  for (Entity i = 0; i < count; ++i) {
    const double x = 1 / (i + 1.0) + time;
    state.position.emplace_back(x, i, -x * x);
    state.velocity.emplace_back(x / 3, 0, i / 7.0);
  }
  return state;
}

Scene many_bodies_scene(Entity count) {
  Scene scene = small_scene();
  scene.world.mass.assign(count, 1);
  scene.roster.bodies = {{"one", 0, 1, false, {}}, {"none", 1, 0, true, {}}, {"gas", 1, count - 1, true, {}}};
  return scene;
}

TEST(Conveyor, ALongTrajectoryHasEveryRowOnce) {
  constexpr Entity count = 9001;
  for (const bool wide : {false, true}) {
    TempFolder temp;
    Scene scene = many_bodies_scene(count);
    scene.output.trajectory = TrajectoryOutput{0.1, wide};

    string expected = wide ? "" : "time_s,body,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";
    const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY));
    TrajectoryTable table({folder.get(), temp.path()}, scene);
    char text[number_size];
    const auto number = [&](double x) { return string(text, put_number(text, x)); };

    // At the last instants each fifth body has become part of the one before it.
    for (const double time : {0.0, 0.1, 0.2, 0.3}) {
      State state = many_bodies(count, time);
      if (time > 0.1) {
        state.part_of.resize(count);
        for (Entity i = 0; i < count; ++i) state.part_of[i] = i % 5 == 4 ? i - 1 : i;
      }

      table.add(time, state, {});
      if (wide) expected += number(time);

      for (Entity i = 0; i < count; ++i) {
        const bool part = !state.part_of.empty() && state.part_of[i] != i;
        if (part && !wide) continue;
        if (!wide) expected += number(time) + "," + (i == 0 ? "one" : "gas." + to_string(i - 1));
        for (const Vec3* vector : {&state.position[i], &state.velocity[i]})
          for (int axis = 0; axis < 3; ++axis) expected += "," + (part ? "" : number((*vector)[axis]));
        if (!wide) expected += "\n";
      }

      if (wide) expected += "\n";
    }

    table.files().front()->publish();
    string written = read(temp / "trajectory.csv");
    if (wide) written.erase(0, written.find('\n') + 1);
    ASSERT_EQ(written.size(), expected.size());
    EXPECT_TRUE(written == expected);
    EXPECT_EQ(table.files().front()->record().sha256, sha256(read(temp / "trajectory.csv")));
  }
}

TEST(Conveyor, ALongFileOfWhichNothingIsPublishedLeavesNothing) {
  TempFolder temp;
  const Scene scene = [] {
    Scene made = many_bodies_scene(5000);
    made.output.trajectory = TrajectoryOutput{0.1, false};
    return made;
  }();

  {
    const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY));
    TrajectoryTable table({folder.get(), temp.path()}, scene);
    const State state = many_bodies(5000, 0);
    for (int i = 0; i < 20; ++i) table.add(i, state, {});
  }
  EXPECT_TRUE(names_in(temp.path()).empty());
}

TEST(Conveyor, AFullDiskIsAnErrorOfTheRun) {
  TempFolder temp;
  const Descriptor folder(open(temp.path().c_str(), O_RDONLY | O_DIRECTORY));
  // No file may grow beyond 1 MiB; the signal that would come with it is off.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{rlim_t{1} << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);

  for (const size_t size : {size_t{2} << 20, size_t{8} << 20}) {  // without a thread; with one
    OutputFile file({folder.get(), temp.path()}, "large.csv");
    const auto fill = [&] {
      for (size_t done = 0; done < size; done += 1000) file.write(string(1000, 'x'));
      file.complete();
    };
    EXPECT_THROW(fill(), ExportError);
  }

  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(names_in(temp.path()).empty());
}

}  // namespace
}  // namespace carom
