// carom_fuzz_scenes [SCENES [FIRST_SEED]]: random scenes of everything at once, loaded and run by their engines. Each
// thousand has its own process, so that a crash or a hang is one finding. carom_fuzz_scenes write FOLDER SCENES: these
// as files. carom_fuzz_scenes hash FILE...: a line for each file, with a hash of whole states and all records. The hash
// does not depend on the compiler. The scene of a seed does, by the order in which a call's arguments are drawn.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "fuzz/any_scene.h"
#include "fuzz/memory_file.h"
#include "fuzz/simulation.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "std.h"

namespace carom::fuzz {
namespace {

constexpr double patience = 10;  // s of CPU time
constexpr unsigned hang = 120;   // s of the clock

/// The outcome of a scene, in one line through a pipe.
struct Line {
  char engine[12] = "";
  bool accepted = false, stopped = false, violated = false;
};

Line try_scene(uint64_t seed) {
  const AnyScene made = make_any_scene(seed);
  Line line;
  unique_ptr<Scene> scene;
  const MemoryFile file(made.yaml());
  try {
    scene = make_unique<Scene>(load_scene(file.path()));
  } catch (const SceneError&) {
    return line;
  }

  const Outcome outcome = simulate(*scene, patience);
  line.accepted = true;
  line.stopped = !outcome.stopped.empty();
  line.violated = !outcome.violations.empty();
  std::snprintf(line.engine, sizeof line.engine, "%s", outcome.engine.c_str());

  if (line.violated) {
    string text = "\nseed " + to_string(seed) + " (" + made.scene.family + ", " + outcome.engine + "):\n";
    for (const string& violation : outcome.violations) text += "  " + violation + "\n";
    std::printf("%s---8<---\n%s--->8---\n", text.c_str(), made.yaml().c_str());
    std::fflush(stdout);
  }
  return line;
}

int write(const string& folder, uint64_t scenes) {
  for (uint64_t seed = 0; seed < scenes; ++seed)
    std::ofstream(folder + "/" + to_string(seed) + ".yaml") << make_any_scene(seed).yaml();
  return 0;
}

int hash(span<char*> files) {
  for (const char* file : files) try {
      const Outcome outcome = simulate(load_scene(file), patience);
      std::printf("%s %s %016llx %s\n", file, outcome.engine.c_str(), static_cast<unsigned long long>(outcome.hash),
                  outcome.stopped.c_str());
    } catch (const SceneError& error) {
      std::printf("%s refused %zu\n", file, error.count);
    }
  return 0;
}

struct Counts {
  uint64_t run = 0, stopped = 0, violated = 0;
};

int run(uint64_t scenes, uint64_t first) {
  map<string, Counts> by_engine;
  uint64_t refused = 0, crashed = 0, violated = 0;

  // A process for a thousand scenes, so that one that crashes takes only the rest of them along.
  const uint64_t end = first + scenes;
  for (uint64_t seed = first; seed < end;) {
    int ends[2];
    if (pipe(ends) != 0) return 1;
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
      for (uint64_t k = seed; k < end && k < seed + 1000; ++k) {
        alarm(hang);
        const Line line = try_scene(k);
        if (::write(ends[1], &line, sizeof line) != sizeof line) _exit(1);
      }
      _exit(0);
    }

    close(ends[1]);
    for (Line line; read(ends[0], &line, sizeof line) == sizeof line; ++seed) {
      if (!line.accepted) {
        ++refused;
        continue;
      }
      Counts& counts = by_engine[line.engine];
      ++counts.run;
      counts.stopped += line.stopped;
      counts.violated += line.violated;
      violated += line.violated;
    }

    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);

    if (!WIFSIGNALED(status) && WEXITSTATUS(status) == 0) continue;
    std::printf("\nseed %llu: it %s\n---8<---\n%s--->8---\n", static_cast<unsigned long long>(seed),
                !WIFSIGNALED(status)          ? "throws what it must not"
                : WTERMSIG(status) == SIGALRM ? "hangs"
                                              : strsignal(WTERMSIG(status)),
                make_any_scene(seed).yaml().c_str());
    ++crashed;
    ++seed;
  }

  std::printf("\n%-10s %9s %9s %9s\n", "engine", "scenes", "stopped", "violated");
  for (const auto& [engine, counts] : by_engine)
    std::printf("%-10s %9llu %9llu %9llu\n", engine.c_str(), static_cast<unsigned long long>(counts.run),
                static_cast<unsigned long long>(counts.stopped), static_cast<unsigned long long>(counts.violated));
  std::printf("%llu scenes, %llu refused by the loader, %llu violated, %llu crashed\n",
              static_cast<unsigned long long>(scenes), static_cast<unsigned long long>(refused),
              static_cast<unsigned long long>(violated), static_cast<unsigned long long>(crashed));
  return violated + crashed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace carom::fuzz

int main(int count, char** arguments) {
  const carom::string word = count > 1 ? arguments[1] : "";
  if (word == "write" && count == 4) return carom::fuzz::write(arguments[2], std::strtoull(arguments[3], nullptr, 10));
  if (word == "hash") return carom::fuzz::hash(std::span(arguments, static_cast<size_t>(count)).subspan(2));
  const auto number = [&](int k, uint64_t otherwise) {
    return count > k ? std::strtoull(arguments[k], nullptr, 10) : otherwise;
  };
  return carom::fuzz::run(number(1, 100'000), number(2, 0));
}
