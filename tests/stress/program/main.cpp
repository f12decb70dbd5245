// The long stress run: carom_stress [SCENES [FIRST_SEED]]. Two processes share the scenes; one that crashes or hangs is
// replaced, and its scene is a failure like any other.
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <new>

#include "std.h"
#include "stress/check.h"

namespace carom::stress {
namespace {

constexpr int workers = 2;
constexpr size_t most_families = 32;
constexpr unsigned hang = 60;  // s of CPU time that a scene, with all of its runs, may take

struct Counts {
  std::atomic<uint64_t> scenes, violated, collisions, stopped, crowds;
};
struct Shared {
  std::atomic<uint64_t> next;  // seed
  array<std::atomic<uint64_t>, workers> current;
  array<Counts, most_families> family;
};

void report(const RandomScene& scene, const vector<string>& violations) {
  string text = "\nseed " + to_string(scene.seed) + " (" + scene.family + ") is violated:\n";
  for (const string& v : violations) text += "  " + v + "\n";
  text += "---8<---\n" + as_yaml(scene) + "--->8---\n";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

Counts& counts_of(Shared& shared, uint64_t seed) {
  return shared.family[seed % family_names().size()];
}

/// In every second round through the families fixed things move.
RandomScene scene_of(uint64_t seed) {
  RandomScene scene = make_scene(seed);
  return seed / family_names().size() % 2 == 0 ? scene : with_motions(std::move(scene));
}

[[noreturn]] void work(Shared& shared, size_t worker, uint64_t end) {
  for (uint64_t seed; (seed = shared.next++) < end;) {
    shared.current[worker] = seed;
    itimerval limit{{0, 0}, {hang, 0}};
    setitimer(ITIMER_VIRTUAL, &limit, nullptr);

    const RandomScene scene = scene_of(seed);
    Verdict verdict = check(scene);
    for (string& violation : check_stepped(scene).violations) verdict.violations.push_back(std::move(violation));

    Counts& counts = counts_of(shared, seed);
    ++counts.scenes;
    counts.collisions += verdict.collisions;
    counts.stopped += verdict.stopped;
    counts.crowds += verdict.crowds;

    if (verdict.violations.empty()) continue;
    ++counts.violated;
    report(scene, verdict.violations);
  }
  _exit(0);
}

pid_t start(Shared& shared, size_t worker, uint64_t end) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) work(shared, worker, end);
  return child;
}

int run(uint64_t scenes, uint64_t first) {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return 1;
  Shared& shared = *new (memory) Shared{};

  shared.next = first;
  const uint64_t end = first + scenes;
  array<pid_t, workers> children;
  for (size_t k = 0; k < workers; ++k) children[k] = start(shared, k, end);

  const auto done = [&] {
    uint64_t sum = 0;
    for (const Counts& c : shared.family) sum += c.scenes;
    return sum;
  };

  const auto failed = [&] {
    uint64_t sum = 0;
    for (const Counts& c : shared.family) sum += c.violated;
    return sum;
  };

  std::time_t reported = std::time(nullptr);
  for (int running = workers; running > 0;) {
    int status;
    const pid_t child = waitpid(-1, &status, WNOHANG);

    for (size_t k = 0; child > 0 && k < workers; ++k) {
      if (children[k] != child) continue;
      if (!WIFSIGNALED(status)) {
        --running;
        continue;
      }

      const uint64_t seed = shared.current[k];
      ++counts_of(shared, seed).scenes;
      ++counts_of(shared, seed).violated;
      report(scene_of(seed),
             {WTERMSIG(status) == SIGVTALRM ? "it hangs" : string("it crashes: ") + strsignal(WTERMSIG(status))});
      children[k] = start(shared, k, end);
    }

    if (child > 0) continue;

    const timespec nap{0, 50'000'000};
    nanosleep(&nap, nullptr);
    if (std::time(nullptr) - reported < 10) continue;
    reported = std::time(nullptr);
    std::fprintf(stderr, "%llu of %llu scenes, %llu violated\n", static_cast<unsigned long long>(done()),
                 static_cast<unsigned long long>(scenes), static_cast<unsigned long long>(failed()));
  }

  std::printf("\n%-10s %9s %9s %9s %9s %12s\n", "family", "scenes", "violated", "stopped", "crowds", "collisions");
  for (size_t k = 0; k < family_names().size(); ++k) {
    const Counts& c = shared.family[k];
    std::printf("%-10s %9llu %9llu %9llu %9llu %12llu\n", family_names()[k], static_cast<unsigned long long>(c.scenes),
                static_cast<unsigned long long>(c.violated), static_cast<unsigned long long>(c.stopped),
                static_cast<unsigned long long>(c.crowds), static_cast<unsigned long long>(c.collisions));
  }

  std::printf("%llu scenes, %llu violated\n", static_cast<unsigned long long>(done()),
              static_cast<unsigned long long>(failed()));
  return failed() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace carom::stress

int main(int count, char** arguments) {
  const auto number = [&](int k, uint64_t otherwise) {
    return count > k ? std::strtoull(arguments[k], nullptr, 10) : otherwise;
  };
  return carom::stress::run(number(1, 100'000), number(2, 0));
}
