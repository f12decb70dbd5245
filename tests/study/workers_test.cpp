// Tasks by several processes.
#include "study/workers.h"
#include "std.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

namespace carom {
namespace {

struct Work {
  size_t count;
  function<string(size_t)> work;
  function<void()> stop_check = [] {};

  map<size_t, TaskOutcome> go(size_t jobs) const {
    size_t next = 0;
    map<size_t, TaskOutcome> outcomes;
    Tasks tasks;
    tasks.next = [&] { return next < count ? optional(next++) : nullopt; };
    tasks.work = work;
    tasks.done = [&](const TaskOutcome& outcome) { EXPECT_TRUE(outcomes.emplace(outcome.task, outcome).second); };
    tasks.stop_check = stop_check;
    work_off(tasks, jobs);
    return outcomes;
  }
};

TEST(Workers, DoEveryTaskOnceWhateverTheirNumber) {
  for (const size_t jobs : {1, 2, 7}) {
    const auto outcomes = Work{100, [](size_t task) { return string(task * 1000, 'x'); }}.go(jobs);
    ASSERT_EQ(outcomes.size(), 100u);
    for (const auto& [task, outcome] : outcomes) {
      EXPECT_EQ(outcome.kind, TaskOutcome::Kind::done);
      EXPECT_EQ(outcome.text.size(), task * 1000);
    }
  }
}

TEST(Workers, TaskThatThrowsFailsAloneWithItsReason) {
  const auto outcomes = Work{
      10, [](size_t task) -> string {
        if (task == 4) throw runtime_error("it is the fourth");
        return "fine";
      }}.go(2);
  EXPECT_EQ(outcomes.at(4).kind, TaskOutcome::Kind::failed);
  EXPECT_EQ(outcomes.at(4).text, "it is the fourth");
  for (const size_t task : {0, 3, 5, 9}) EXPECT_EQ(outcomes.at(task).kind, TaskOutcome::Kind::done);
}

TEST(Workers, ProcessThatIsKilledTakesOneTaskWithIt) {
  const auto outcomes = Work{
      20, [](size_t task) -> string {
        if (task % 5 == 0) kill(getpid(), SIGKILL);
        return "fine";
      }}.go(3);
  ASSERT_EQ(outcomes.size(), 20u);
  for (const auto& [task, outcome] : outcomes) {
    EXPECT_EQ(outcome.kind, task % 5 == 0 ? TaskOutcome::Kind::lost : TaskOutcome::Kind::done);
    EXPECT_EQ(outcome.text.find("signal 9") != string::npos, task % 5 == 0) << outcome.text;
  }
}

TEST(Workers, StopCheckThatThrowsEndsAllProcesses) {
  int checks = 0;
  const Work work{1000,
                  [](size_t) {
                    usleep(20'000);
                    return string();
                  },
                  [&checks] {
                    if (++checks == 3) throw runtime_error("stop");
                  }};
  EXPECT_THROW(work.go(2), runtime_error);
}

}  // namespace
}  // namespace carom
