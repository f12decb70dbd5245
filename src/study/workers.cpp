// Forks workers and passes tasks and results over sockets. Processes and not threads, so that a crash loses one task.
// A worker that ends is replaced, and its task is reported as lost.
#include "study/workers.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <thread>

#include "std.h"

namespace carom {

namespace {

constexpr int check_interval = 50;  // ms
/// A process that does not end when requested is killed after this time.
constexpr auto end_patience = std::chrono::seconds(1);

/// The header of an outcome's text.
struct Head {
  uint64_t size;
  TaskOutcome::Kind kind;
};

bool send_all(int socket, const void* bytes, size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = send(socket, from, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    from += n;
    size -= size_t(n);
  }
  return true;
}

bool receive_all(int socket, void* bytes, size_t size) {
  char* to = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t n = recv(socket, to, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to += n;
    size -= size_t(n);
  }
  return true;
}

/// Waits up to check_interval for data. If the system cannot wait, every socket is reported as ready.
bool wait_for_any(vector<pollfd>& sockets) {
  const int ready = poll(sockets.data(), sockets.size(), check_interval);
  if (ready >= 0 || errno == EINTR) return ready > 0;
  std::this_thread::sleep_for(std::chrono::milliseconds(check_interval));
  for (pollfd& socket : sockets) socket.revents = POLLIN;
  return true;
}

/// The loop of a worker, until there are no more tasks or the parent has ended.
[[noreturn]] void serve(int socket, const Tasks& tasks) {
  uint64_t task = 0;
  while (receive_all(socket, &task, sizeof task)) {
    string text;
    TaskOutcome::Kind kind = TaskOutcome::Kind::done;

    try {
      text = tasks.work(task);
    } catch (const std::bad_alloc&) {
      kind = TaskOutcome::Kind::failed;
      text = "not enough memory";
    } catch (const std::exception& error) {
      kind = TaskOutcome::Kind::failed;
      text = error.what();
    } catch (...) {
      // Interrupted together with its parent, which reports it.
      _exit(1);
    }

    const Head head{text.size(), kind};
    if (!send_all(socket, &head, sizeof head) || !send_all(socket, text.data(), text.size())) break;
  }
  _exit(0);
}

class Pool {
 public:
  Pool(const Tasks& tasks, size_t jobs) : tasks_(tasks), workers_(jobs) {}

  /// Ends the running workers with SIGTERM, so that they can clean up their files.
  ~Pool() {
    for (const Worker& worker : workers_)
      if (worker.process > 0) kill(worker.process, SIGTERM);
    end_all();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void go() {
    for (Worker& worker : workers_)
      if (!give(worker)) break;

    vector<pollfd> sockets;
    while (true) {
      sockets.clear();
      for (const Worker& worker : workers_)
        if (worker.busy) sockets.push_back({worker.socket, POLLIN, 0});
      if (sockets.empty()) break;

      const bool ready = wait_for_any(sockets);
      tasks_.stop_check();

      for (const pollfd& socket : sockets) {
        Worker& worker = *ranges::find_if(workers_, [&](const Worker& w) { return w.socket == socket.fd; });
        if (ready ? socket.revents == 0 : !has_ended(worker)) continue;
        take(worker);
        give(worker);
      }
    }
    end_all();
  }

 private:
  struct Worker {
    pid_t process = 0;
    int socket = -1;
    bool busy = false;
    size_t task = 0;
    optional<int> status{};  // set once it has ended
  };

  static bool has_ended(Worker& worker) {
    int status = 0;
    if (!worker.status && waitpid(worker.process, &status, WNOHANG) == worker.process) worker.status = status;
    return worker.status.has_value();
  }

  /// Closes the worker's input. Shutdown makes the worker see the end even if the descriptor has copies.
  static void hang_up(Worker& worker) {
    shutdown(worker.socket, SHUT_RDWR);
    close(worker.socket);
    worker.socket = -1;
  }

  /// Gives the worker time to end, then kills it.
  static void wait_for(Worker& worker, std::chrono::steady_clock::time_point limit) {
    while (!has_ended(worker) && std::chrono::steady_clock::now() < limit)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (worker.status) return;
    kill(worker.process, SIGKILL);
    int status = 0;
    while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    worker.status = status;
  }

  void end_all() {
    for (Worker& worker : workers_)
      if (worker.process > 0) hang_up(worker);
    const auto limit = std::chrono::steady_clock::now() + end_patience;
    for (Worker& worker : workers_)
      if (worker.process > 0) wait_for(worker, limit);
    workers_.clear();
  }

  /// False: the worker has ended before it sent all bytes.
  bool receive_all(Worker& worker, void* bytes, size_t size) {
    char* to = static_cast<char*>(bytes);
    while (size > 0) {
      const ssize_t n = recv(worker.socket, to, size, MSG_DONTWAIT);
      if (n > 0) {
        to += n;
        size -= size_t(n);
        continue;
      }

      if (n == 0 || (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR)) return false;

      vector<pollfd> wanted = {{worker.socket, POLLIN, 0}};
      const bool ready = wait_for_any(wanted);
      tasks_.stop_check();
      if (!ready && has_ended(worker)) return false;
    }
    return true;
  }

  /// Whether there was a task to assign.
  bool give(Worker& worker) {
    const optional<size_t> task = tasks_.next();
    if (!task) return false;
    worker.task = *task;
    worker.busy = true;

    const uint64_t number = *task;
    // A worker that has ended between two tasks is replaced.
    int status = 0;
    for (int attempt = 0; attempt < 2; ++attempt) {
      if (worker.process <= 0) start(worker);
      if (send_all(worker.socket, &number, sizeof number)) return true;
      status = end(worker);
    }

    lose(worker, status);
    return give(worker);
  }

  void start(Worker& worker) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot talk to another process");

    std::fflush(nullptr);
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process < 0) {
      const int error = errno;
      close(pair[0]);
      close(pair[1]);
      throw std::system_error(error, std::generic_category(), "cannot start another process");
    }

    if (process == 0) {
      // The worker dies with its parent, so that no process continues its work.
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(1);
      close(pair[0]);
      for (const Worker& other : workers_)
        if (other.socket >= 0) close(other.socket);
      serve(pair[1], tasks_);
    }

    close(pair[1]);
    worker.process = process;
    worker.socket = pair[0];
    worker.status.reset();
  }

  static int end(Worker& worker) {
    hang_up(worker);
    wait_for(worker, std::chrono::steady_clock::now() + end_patience);
    const int status = *worker.status;
    worker.process = 0;
    worker.status.reset();
    return status;
  }

  void take(Worker& worker) {
    TaskOutcome outcome;
    outcome.task = worker.task;
    Head head{};

    if (receive_all(worker, &head, sizeof head)) {
      outcome.kind = head.kind;
      outcome.text.resize(head.size);
      if (receive_all(worker, outcome.text.data(), head.size)) {
        worker.busy = false;
        tasks_.done(outcome);
        return;
      }
    }
    lose(worker, end(worker));
  }

  /// Reports the task of a worker with an ended process as lost.
  void lose(Worker& worker, int status) {
    worker.busy = false;
    // An interrupt also ends workers.
    tasks_.stop_check();
    TaskOutcome outcome;
    outcome.task = worker.task;
    outcome.kind = TaskOutcome::Kind::lost;
    outcome.text =
        WIFSIGNALED(status)
            ? fmt::format("its process was ended by signal {} ({}){}", WTERMSIG(status), strsignal(WTERMSIG(status)),
                          WTERMSIG(status) == SIGKILL ? ", by a user or for lack of memory" : "")
            : fmt::format("its process ended with code {}", WEXITSTATUS(status));
    tasks_.done(outcome);
  }

  const Tasks& tasks_;
  vector<Worker> workers_;
};

}  // namespace

void work_off(const Tasks& tasks, size_t jobs) {
  Pool(tasks, jobs).go();
}

}  // namespace carom
