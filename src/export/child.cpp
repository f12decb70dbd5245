// Starts programs with posix_spawn from a list of arguments, without a shell.
// Outputs go to memory files and not to pipes, so that the program never blocks on a reader and no thread has to read.
// Input goes through a socket, because sending with MSG_NOSIGNAL raises no SIGPIPE.
#include "export/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include "files/file_place.h"
#include "std.h"

namespace carom {
namespace {

using Clock = std::chrono::steady_clock;

/// A file in memory. A program can write any amount to it and never waits for a reader.
Descriptor memory_file() {
  Descriptor file(memfd_create("carom", MFD_CLOEXEC));
  if (!file) throw ExportError(string("cannot start a program: ") + std::strerror(errno));
  return file;
}

string text_of(int file) {
  string text(1 << 20, '\0');
  size_t size = 0;
  while (size < text.size()) {
    const ssize_t n = pread(file, text.data() + size, text.size() - size, off_t(size));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", {-1, "the output of a program"}, "");
    if (n == 0) break;
    size += size_t(n);
  }
  text.resize(size);
  return text;
}

constexpr auto glance = std::chrono::milliseconds(50);  // between two calls of stop_check()

function<void()>& stop_check() {
  static function<void()> function = [] {};
  return function;
}

/// This program ignores these signals. A started program gets their default actions.
constexpr int ignored[] = {SIGPIPE, SIGXFSZ};

}  // namespace

void check_while_waiting(function<void()> function) {
  stop_check() = std::move(function);
}

optional<string> find_program(const string& name) {
  const char* path = std::getenv("PATH");
  string_view rest = path ? path : "";
  while (!rest.empty()) {
    const string_view folder = rest.substr(0, rest.find(':'));
    rest.remove_prefix(min(rest.size(), folder.size() + 1));
    if (folder.empty()) continue;

    std::error_code error;
    const std::filesystem::path file = std::filesystem::absolute(std::filesystem::path(folder) / name, error);
    struct stat info {};
    if (error) continue;

    if (stat(file.c_str(), &info) != 0) {
      if (!is_absent(errno) && errno != EACCES) fail("look for", {-1, string(folder)}, name);
    } else if (S_ISREG(info.st_mode) && access(file.c_str(), X_OK) == 0) {
      return file.string();
    }
  }
  return nullopt;
}

Child::Child(const vector<string>& arguments, int folder, bool fed) : output_(memory_file()), errors_(memory_file()) {
  // A socket and not a pipe, because sending to it can avoid SIGPIPE without a signal handler.
  Descriptor theirs;
  if (fed) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
      throw ExportError("cannot start " + arguments[0] + ": " + std::strerror(errno));
    input_ = Descriptor(pair[0]);
    theirs = Descriptor(pair[1]);
  } else {
    theirs = Descriptor(open("/dev/null", O_RDONLY | O_CLOEXEC));
  }

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addfchdir_np(&actions, folder);
  posix_spawn_file_actions_adddup2(&actions, theirs.get(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output_.get(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors_.get(), STDERR_FILENO);

  // The program gets an empty signal mask and default actions, whatever this one ignores or blocks.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, defaults;
  sigemptyset(&none);
  sigemptyset(&defaults);
  for (const int signal : ignored) sigaddset(&defaults, signal);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

  vector<char*> list;
  list.reserve(arguments.size() + 1);
  for (const string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  const int error = posix_spawn(&id_, arguments[0].c_str(), &actions, &attributes, list.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    id_ = -1;
    throw ExportError("cannot start " + arguments[0] + ": " + std::strerror(error));
  }
}

Child::~Child() {
  kill();
}

Child::Sent Child::send(const void* bytes, size_t size, std::chrono::milliseconds patience) {
  const char* from = static_cast<const char*>(bytes);
  auto limit = Clock::now() + patience;
  while (size > 0) {
    if (abandoned_) return Sent::abandoned;

    const ssize_t n = ::send(input_.get(), from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n >= 0) {
      from += n;
      size -= size_t(n);
      limit = Clock::now() + patience;
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      // The program is busy. Wait for room, a little at a time.
      pollfd request{input_.get(), POLLOUT, 0};
      const int ready = poll(&request, 1, int(glance.count()));
      if (ready < 0 && errno != EINTR) std::this_thread::sleep_for(glance);
      stop_check()();

      if (ready > 0) continue;
      if (has_ended()) return Sent::closed;
      if (Clock::now() >= limit) return Sent::stuck;
    } else if (errno != EINTR) {
      return Sent::closed;
    }
  }
  return Sent::all;
}

void Child::end_input() {
  // Shut down first. The program then reads the end even if the descriptor has copies.
  if (input_) shutdown(input_.get(), SHUT_RDWR);
  input_.reset();
}

bool Child::has_ended() {
  if (exit_code_) return true;
  int status = 0;
  const pid_t ended = waitpid(id_, &status, WNOHANG);
  if (ended == id_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  else if (ended < 0 && errno != EINTR)
    // Another part of this program has already waited for it.
    exit_code_ = 127;
  return exit_code_.has_value();
}

optional<int> Child::wait(std::chrono::milliseconds patience) {
  const auto limit = Clock::now() + patience;
  std::chrono::microseconds pause(200);
  while (!has_ended() && !abandoned_ && Clock::now() < limit) {
    stop_check()();
    std::this_thread::sleep_for(pause);
    pause = min(pause * 2, std::chrono::microseconds(20'000));
  }
  return exit_code_;
}

void Child::kill() {
  if (id_ < 0 || exit_code_) return;
  ::kill(id_, SIGKILL);
  int status = 0;
  while (!exit_code_ && waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  exit_code_ = 128 + SIGKILL;
}

string Child::output() const {
  return text_of(output_.get());
}
string Child::errors() const {
  return text_of(errors_.get());
}

}  // namespace carom
