#include "commands/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "paths.h"
#include "std.h"

namespace carom::testing {

namespace fs = std::filesystem;

Workplace::Workplace() {
  string name = ::testing::TempDir() + "carom_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw runtime_error("no temporary folder");
  folder_ = name;
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Workplace::write(const string& name, const string& text) const {
  fs::create_directories(fs::path(path(name)).parent_path());
  std::ofstream(path(name), std::ios::binary) << text;
}

string Workplace::read(const string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool Workplace::has(const string& name) const {
  return fs::exists(path(name));
}

map<string, string> Workplace::files(const string& name) const {
  map<string, string> found;
  if (!has(name)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(path(name))) {
    if (!entry.is_regular_file()) continue;
    const string relative = entry.path().lexically_relative(path(name)).generic_string();
    if (relative.starts_with(".stdout") || relative.starts_with(".stderr")) continue;
    found[relative] = read(name + "/" + relative);
  }
  return found;
}

int Workplace::start(const vector<string>& words) const {
  const string out = path(".stdout"), err = path(".stderr");
  const pid_t process = fork();
  if (process != 0) return process;
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  unsetenv("NO_COLOR");
  setenv("CAROM", CAROM_PROGRAM, 1);
  const bool placed = chdir(folder_.c_str()) == 0 && dup2(open("/dev/null", O_RDONLY), 0) == 0 &&
                      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 1) == 1 &&
                      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 2) == 2;

  vector<char*> argv;
  vector<string> copy = words;
  for (string& word : copy) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (placed) execv(argv[0], argv.data());
  _exit(127);
}

Finished Workplace::finish(int process) const {
  int status = 0;
  waitpid(process, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read(".stdout"), read(".stderr")};
}

Finished Workplace::carom(const vector<string>& words) const {
  vector<string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  return finish(start(line));
}

Finished Workplace::shell(const string& command) const {
  return finish(start({"/bin/sh", "-c", command}));
}

Finished Workplace::interrupted(const vector<string>& words, const string& sign, int signal) const {
  vector<string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  const int process = start(line);
  for (int i = 0; i < 2000 && !has(sign); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(process, signal);
  return finish(process);
}

Finished Workplace::interrupted_after(const vector<string>& words, std::chrono::milliseconds time, int signal) const {
  vector<string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  const int process = start(line);
  std::this_thread::sleep_for(time);
  kill(process, signal);
  return finish(process);
}

string two_balls(const string& more) {
  return "scene: 1\n"
         "title: Two balls\n"
         "gravity: [0, 0, 0]\n"
         "balls:\n"
         "  red: {mass: 10, radius: 0.11, restitution: 0.9, position: [-1, 0, 0], velocity: [2, 0, 0]}\n"
         "  blue: {mass: 10, radius: 0.11, restitution: 0.9, position: [1, 0, 0], velocity: [-2, 0, 0]}\n"
         "simulate: {duration: 1}\n" +
         more;
}

}  // namespace carom::testing
