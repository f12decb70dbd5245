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

namespace carom::testing {

namespace fs = std::filesystem;

Workplace::Workplace() {
  std::string name = ::testing::TempDir() + "carom_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = name;
}

Workplace::~Workplace() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void Workplace::write(const std::string& name, const std::string& text) const {
  fs::create_directories(fs::path(path(name)).parent_path());
  std::ofstream(path(name), std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool Workplace::has(const std::string& name) const {
  return fs::exists(path(name));
}

std::map<std::string, std::string> Workplace::files(const std::string& name) const {
  std::map<std::string, std::string> found;
  if (!has(name)) return found;
  for (const auto& entry : fs::recursive_directory_iterator(path(name))) {
    if (!entry.is_regular_file()) continue;
    const std::string relative = entry.path().lexically_relative(path(name)).generic_string();
    if (relative.starts_with(".stdout") || relative.starts_with(".stderr")) continue;
    found[relative] = read(name + "/" + relative);
  }
  return found;
}

int Workplace::start(const std::vector<std::string>& words) const {
  const std::string out = path(".stdout"), err = path(".stderr");
  const pid_t process = fork();
  if (process != 0) return process;
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  unsetenv("NO_COLOR");
  setenv("CAROM", CAROM_PROGRAM, 1);
  const bool placed = chdir(folder_.c_str()) == 0 && dup2(open("/dev/null", O_RDONLY), 0) == 0 &&
                      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 1) == 1 &&
                      dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 2) == 2;
  std::vector<char*> argv;
  std::vector<std::string> copy = words;
  for (std::string& word : copy) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (placed) execv(argv[0], argv.data());
  _exit(127);
}

Finished Workplace::finish(int process) const {
  int status = 0;
  waitpid(process, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read(".stdout"), read(".stderr")};
}

Finished Workplace::carom(const std::vector<std::string>& words) const {
  std::vector<std::string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  return finish(start(line));
}

Finished Workplace::shell(const std::string& command) const {
  return finish(start({"/bin/sh", "-c", command}));
}

Finished Workplace::interrupted(const std::vector<std::string>& words, const std::string& sign, int signal) const {
  std::vector<std::string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  const int process = start(line);
  for (int i = 0; i < 2000 && !has(sign); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(process, signal);
  return finish(process);
}

Finished Workplace::interrupted_after(const std::vector<std::string>& words, std::chrono::milliseconds time,
                                      int signal) const {
  std::vector<std::string> line = {CAROM_PROGRAM};
  line.insert(line.end(), words.begin(), words.end());
  const int process = start(line);
  std::this_thread::sleep_for(time);
  kill(process, signal);
  return finish(process);
}

std::string two_balls(const std::string& more) {
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
