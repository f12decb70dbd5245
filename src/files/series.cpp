// Writes each file of a series through OutputFile, so that every file is complete as soon as its name exists.
// The complete files of a series stay even if the run fails later.
#include "files/series.h"

#include <cstring>

#include "files/stored_file.h"
#include "std.h"

namespace carom {

string Series::put(const string& name, string_view bytes) {
  return put(int64_t(records_.size()), name, bytes);
}

string Series::put(int64_t number, const string& file_name, string_view bytes) {
  OutputFile file(place_, file_name);
  // In one piece, so that a large file starts no thread of its own.
  char* const to = file.room(bytes.size());
  std::memcpy(to, bytes.data(), bytes.size());
  file.written(to + bytes.size());
  file.publish();
  folder_.keep();

  FileRecord record = file.record();
  record.name.insert(0, string(files_.folder) + "/");
  const string name = record.name;
  const std::lock_guard lock(mutex_);
  records_.insert_or_assign(number, std::move(record));
  return name;
}

/// Whether all files that are recorded are there.
bool Series::has_all() const {
  return all_of(records_, [this](const auto& entry) {
    const FileRecord& record = entry.second;
    const optional<FileRecord> stored = read_record(place_.folder, record.name.substr(files_.folder.size() + 1));
    return stored && stored->bytes == record.bytes && stored->sha256 == record.sha256;
  });
}

vector<FileRecord> Series::records() const {
  const std::lock_guard lock(mutex_);
  vector<FileRecord> records;
  for (const auto& [number, record] : records_) records.push_back(record);
  return records;
}

}  // namespace carom
