// Reads a mesh file in a child process, because a damaged file can crash assimp, hang it or fill the memory. The child
// has limits of memory, processor time and files, and sends the mesh through a pipe. The parent waits with a deadline
// and never trusts the data. A thread could not be stopped or limited like this.
#include "render/mesh.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>

#include "render/mesh_import.h"
#include "render/mesh_reply.h"
#include "std.h"
#include "yaml/joined.h"

namespace carom {
namespace {

using Clock = std::chrono::steady_clock;

// ms between two checks.
constexpr int64_t glance = 50;

function<void()>& stop_check() {
  static function<void()> function = [] {};
  return function;
}

[[noreturn]] void fail(const string& path, const string& why) {
  throw runtime_error(fmt::format("cannot read the mesh {}: {}", path, why));
}

/// Checks that the file is a regular one of permitted size with a known ending. Returns the ending in lower case.
string check_file(const string& path, const MeshLimits& limits) {
  string ending = std::filesystem::path(path).extension().string();
  if (!ending.empty()) ending.erase(0, 1);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');

  const auto& known = mesh_endings();
  if (!contains(known, ending))
    fail(path, fmt::format("meshes are read from files that end in .{}", joined(known, ", .")));

  // Opening must not wait for a queue or a device.
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) fail(path, std::strerror(errno));
  struct stat info {};
  const bool known_kind = fstat(file, &info) == 0;
  close(file);
  if (!known_kind) fail(path, std::strerror(errno));

  if (S_ISDIR(info.st_mode)) fail(path, "it is a folder");
  if (!S_ISREG(info.st_mode)) fail(path, "it is not a regular file");
  if (info.st_size == 0) fail(path, "it is empty");
  if (uint64_t(info.st_size) > limits.file_bytes)
    fail(path, fmt::format("it has {} bytes; at most {} are read", info.st_size, limits.file_bytes));

  return ending;
}

// ---- the child ----

void limit(int what, uint64_t value) {
  rlimit bound{value, value};
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(what), &now) == 0)
    bound.rlim_cur = bound.rlim_max = min<rlim_t>(value, now.rlim_max);
  if (setrlimit(static_cast<__rlimit_resource>(what), &bound) != 0) _exit(3);
}

// In bytes of address space.
uint64_t memory_now() {
  unsigned long long pages = 0;
  FILE* file = std::fopen("/proc/self/statm", "re");
  if (!file || std::fscanf(file, "%llu", &pages) != 1) pages = 0;
  if (file) std::fclose(file);
  return pages * uint64_t(sysconf(_SC_PAGESIZE));
}

void confine(const MeshLimits& limits, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(3);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE, SIGXCPU, SIGXFSZ}) ::signal(signal, SIG_DFL);
  // The parent decides.
  ::signal(SIGINT, SIG_IGN);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (dup2(nowhere, standard) < 0) _exit(3);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  limit(RLIMIT_AS, memory_now() + limits.memory_bytes);
}

void send(int pipe, const void* bytes, size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = write(pipe, from, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(3);
    from += n;
    size -= size_t(n);
  }
}

void send_trouble(int pipe, const char* text) {
  MeshReplyHead head;
  head.text = uint32_t(min<size_t>(std::strlen(text), longest_mesh_trouble));
  send(pipe, &head, sizeof head);
  send(pipe, text, head.text);
}

template <typename Item>
void send(int pipe, const vector<Item>& items) {
  send(pipe, items.data(), items.size() * sizeof(Item));
}

void send_paint(int pipe, const MeshPaint& paint) {
  send(pipe, paint.parts);
  send(pipe, paint.uv);
  send(pipe, paint.tint);
  for (const MeshTexture& texture : paint.textures) {
    for (const uint32_t side : {texture.width, texture.height}) send(pipe, &side, sizeof side);
    send(pipe, texture.rgba);
  }
}

/// What is read, and how.
struct MeshRequest {
  string path, ending;
  bool painted;
  const MeshLimits& limits;
};

[[noreturn]] void run_child(int pipe, const MeshRequest& request) {
  try {
    const ImportedMesh mesh = import_mesh(request.path, request.ending, request.painted, request.limits);
    const auto count = [](size_t size) { return uint32_t(size); };
    const MeshReplyHead head{count(mesh.vertices.size() / 3), count(mesh.triangles.size() / 3), 0,
                             count(mesh.paint.parts.size()), count(mesh.paint.textures.size())};

    send(pipe, &head, sizeof head);
    send(pipe, mesh.vertices);
    send(pipe, mesh.normals);
    send(pipe, mesh.triangles);
    if (head.parts > 0) send_paint(pipe, mesh.paint);

  } catch (const std::bad_alloc&) {
    send_trouble(pipe, "reading it takes too much memory");
  } catch (const std::exception& error) {
    send_trouble(pipe, error.what());
  } catch (...) {
    send_trouble(pipe, "it is damaged");
  }

  // This must not end or flush anything of the parent's.
  _exit(0);
}

// ---- the parent ----

/// A child process and the pipe from it. The process is killed when this object goes out of scope.
class MeshReader {
 public:
  explicit MeshReader(const MeshRequest& request)
      : deadline_(Clock::now() + std::chrono::seconds(3 * request.limits.seconds)) {
    const string& path = request.path;
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(path, std::strerror(errno));

    const pid_t parent = getpid();
    id_ = fork();
    if (id_ == 0) {
      confine(request.limits, parent);
      run_child(ends[1], request);
    }

    // The parent keeps the reading end.
    const int error = errno;
    close(ends[1]);
    pipe_ = ends[0];
    if (id_ < 0) {
      close(pipe_);
      fail(path, std::strerror(error));
    }
  }
  ~MeshReader() {
    end();
    close(pipe_);
  }
  MeshReader(const MeshReader&) = delete;
  MeshReader& operator=(const MeshReader&) = delete;

  /// False: the data have ended, or the time is over.
  bool receive(void* bytes, size_t size) {
    char* to = static_cast<char*>(bytes);
    while (size > 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
      if (left <= 0) {
        late_ = true;
        return false;
      }

      pollfd request{pipe_, POLLIN, 0};
      if (poll(&request, 1, int(min<int64_t>(left, glance))) <= 0) {
        stop_check()();
        continue;
      }

      const ssize_t n = read(pipe_, to, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      to += n;
      size -= size_t(n);
    }

    return true;
  }

  /// The reason why no more data come.
  string trouble(const MeshLimits& limits) {
    const int status = late_ ? 0 : wait();
    if (late_ || (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)))
      return fmt::format("reading it takes longer than {} s; it may be damaged", limits.seconds);
    return "it is damaged: its reader crashes";
  }

 private:
  int wait() {
    int status = 0;
    pid_t ended = 0;
    do ended = waitpid(id_, &status, 0);
    while (ended < 0 && errno == EINTR);
    id_ = -1;
    return ended < 0 ? 0 : status;
  }
  void end() {
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    wait();
  }

  Clock::time_point deadline_;
  pid_t id_ = -1;
  int pipe_ = -1;
  bool late_ = false;
};

Mesh read(const string& path, bool painted, const MeshLimits& limits) {
  const MeshRequest request{path, check_file(path, limits), painted, limits};
  MeshReader reader(request);
  try {
    return receive_mesh(
        {[&](void* bytes, size_t size) { return reader.receive(bytes, size); }, [&] { return reader.trouble(limits); }},
        limits);
  } catch (const runtime_error& error) {
    fail(path, error.what());
  }
}

}  // namespace

void check_while_reading(function<void()> function) {
  stop_check() = std::move(function);
}

Mesh read_mesh(const string& path, const MeshLimits& limits) {
  return read(path, false, limits);
}

Mesh read_painted_mesh(const string& path, const MeshLimits& limits) {
  return read(path, true, limits);
}

vector<Vec3> read_mesh_points(const string& path, const MeshLimits& limits) {
  return read_mesh(path, limits).vertices;
}

}  // namespace carom
