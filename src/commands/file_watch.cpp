// Looks at the files' stamps again and again, which works on every file system and through links.
#include "commands/file_watch.h"

#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "std.h"

namespace carom {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto look_interval = std::chrono::milliseconds(50);
/// Several saves in a row count as one.
constexpr auto quiet = std::chrono::milliseconds(100);
/// A file is gone for a moment while an editor replaces it.
constexpr auto patience = std::chrono::milliseconds(500);

}  // namespace

FileWatch::Stamp FileWatch::stamp_of(const string& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0) return {};
  const auto ns = uint64_t(info.st_mtim.tv_sec) * 1'000'000'000 + uint64_t(info.st_mtim.tv_nsec);
  return {uint64_t(info.st_ino), uint64_t(info.st_size), ns};
}

void FileWatch::follow(const set<string>& files) {
  map<string, Stamp> stamps;
  for (const string& file : files) {
    const auto known = stamps_.find(file);
    stamps[file] = known == stamps_.end() ? stamp_of(file) : known->second;
  }
  stamps_ = std::move(stamps);
}

set<string> FileWatch::changed(const function<void()>& stop_check) {
  set<string> changed, gone;
  Clock::time_point last;
  while (true) {
    stop_check();
    const Clock::time_point now = Clock::now();
    for (auto& [file, stamp] : stamps_) {
      const Stamp current = stamp_of(file);
      if (current == stamp) continue;
      stamp = current;
      changed.insert(file);
      last = now;

      if (current == Stamp())
        gone.insert(file);
      else
        gone.erase(file);
    }

    if (!changed.empty() && now - last > (gone.empty() ? quiet : patience)) return changed;
    std::this_thread::sleep_for(look_interval);
  }
}

}  // namespace carom
