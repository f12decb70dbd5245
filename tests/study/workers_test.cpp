// Tasks by several processes.
#include "study/workers.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <map>
#include <stdexcept>

namespace carom {
namespace {

struct Work {
  std::size_t count;
  std::function<std::string(std::size_t)> work;
  std::function<void()> stop_check = [] {};

  std::map<std::size_t, TaskOutcome> go(std::size_t jobs) const {
    std::size_t next = 0;
    std::map<std::size_t, TaskOutcome> outcomes;
    Tasks tasks;
    tasks.next = [&] { return next < count ? std::optional(next++) : std::nullopt; };
    tasks.work = work;
    tasks.done = [&](const TaskOutcome& outcome) { EXPECT_TRUE(outcomes.emplace(outcome.task, outcome).second); };
    tasks.stop_check = stop_check;
    work_off(tasks, jobs);
    return outcomes;
  }
};

TEST(Workers, DoEveryTaskOnceWhateverTheirNumber) {
  for (const std::size_t jobs : {1, 2, 7}) {
    const auto outcomes = Work{100, [](std::size_t task) { return std::string(task * 1000, 'x'); }}.go(jobs);
    ASSERT_EQ(outcomes.size(), 100u);
    for (const auto& [task, outcome] : outcomes) {
      EXPECT_EQ(outcome.kind, TaskOutcome::Kind::done);
      EXPECT_EQ(outcome.text.size(), task * 1000);
    }
  }
}

TEST(Workers, TaskThatThrowsFailsAloneWithItsReason) {
  const auto outcomes = Work{
      10, [](std::size_t task) -> std::string {
        if (task == 4) throw std::runtime_error("it is the fourth");
        return "fine";
      }}.go(2);
  EXPECT_EQ(outcomes.at(4).kind, TaskOutcome::Kind::failed);
  EXPECT_EQ(outcomes.at(4).text, "it is the fourth");
  for (const std::size_t task : {0, 3, 5, 9}) EXPECT_EQ(outcomes.at(task).kind, TaskOutcome::Kind::done);
}

TEST(Workers, ProcessThatIsKilledTakesOneTaskWithIt) {
  const auto outcomes = Work{
      20, [](std::size_t task) -> std::string {
        if (task % 5 == 0) kill(getpid(), SIGKILL);
        return "fine";
      }}.go(3);
  ASSERT_EQ(outcomes.size(), 20u);
  for (const auto& [task, outcome] : outcomes) {
    EXPECT_EQ(outcome.kind, task % 5 == 0 ? TaskOutcome::Kind::lost : TaskOutcome::Kind::done);
    EXPECT_EQ(outcome.text.find("signal 9") != std::string::npos, task % 5 == 0) << outcome.text;
  }
}

TEST(Workers, StopCheckThatThrowsEndsAllProcesses) {
  int checks = 0;
  const Work work{1000,
                  [](std::size_t) {
                    usleep(20'000);
                    return std::string();
                  },
                  [&checks] {
                    if (++checks == 3) throw std::runtime_error("stop");
                  }};
  EXPECT_THROW(work.go(2), std::runtime_error);
}

}  // namespace
}  // namespace carom
