// inotify wakes; the files' own stamps decide. Events have names only, and a name in a folder may be reached through a
// link. Folders are watched and not files, because a rename gives the name to another file.
#include "commands/file_watch.h"

#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "std.h"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int check_interval = 50;  // ms
/// Several saves in a row count as one.
constexpr auto quiet = std::chrono::milliseconds(100);
/// A file is gone for a moment while an editor replaces it.
constexpr auto patience = std::chrono::milliseconds(500);
/// Where inotify reports nothing, as on some network file systems.
constexpr auto look_anyway = std::chrono::seconds(1);

}  // namespace

FileWatch::FileWatch() : events_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {}

FileWatch::Stamp FileWatch::stamp_of(const string& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0) return {};
  const auto ns =
      static_cast<uint64_t>(info.st_mtim.tv_sec) * 1'000'000'000 + static_cast<uint64_t>(info.st_mtim.tv_nsec);
  return {static_cast<uint64_t>(info.st_ino), static_cast<uint64_t>(info.st_size), ns};
}

void FileWatch::watch_folder(const string& file) {
  if (!events_) return;
  constexpr uint32_t events = IN_CLOSE_WRITE | IN_MODIFY | IN_MOVED_TO | IN_MOVED_FROM | IN_CREATE | IN_DELETE;
  std::error_code error;
  // The folder of a link, and that of the file behind it.
  for (const std::filesystem::path& path :
       {std::filesystem::path(file), std::filesystem::weakly_canonical(file, error)}) {
    const string folder = path.parent_path().empty() ? "." : path.parent_path().string();
    inotify_add_watch(events_.get(), folder.c_str(), events);
  }
}

void FileWatch::follow(const std::set<string>& files) {
  std::map<string, Stamp> stamps;
  for (const string& file : files) {
    const auto known = stamps_.find(file);
    if (known == stamps_.end()) watch_folder(file);
    stamps[file] = known == stamps_.end() ? stamp_of(file) : known->second;
  }
  stamps_ = std::move(stamps);
}

/// Whether there was an event. Waits for one, but not long.
bool FileWatch::wait() const {
  pollfd events{events_.get(), POLLIN, 0};
  if (poll(&events, events_ ? 1 : 0, check_interval) <= 0) return false;
  array<char, 4096> buffer{};
  while (read(events_.get(), buffer.data(), buffer.size()) > 0) {
  }
  return true;
}

std::set<string> FileWatch::changed(const function<void()>& stop_check) {
  std::set<string> changed;
  std::set<string> gone;
  Clock::time_point looked, last;
  while (true) {
    stop_check();
    const Clock::time_point now = Clock::now();
    if (wait() || now - looked > look_anyway || !changed.empty()) {
      looked = now;
      for (auto& [file, stamp] : stamps_) {
        const Stamp current = stamp_of(file);
        if (current == stamp) continue;
        if (current == Stamp())
          gone.insert(file);
        else
          gone.erase(file);
        stamp = current;
        changed.insert(file);
        last = now;
      }
    }
    if (!changed.empty() && now - last > (gone.empty() ? quiet : patience)) return changed;
  }
}

}  // namespace carom
