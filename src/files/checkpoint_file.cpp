// The file: 8 bytes "caromckp", the hash of request and program (64 hexadecimal digits), the SHA-256 of what follows
// (64), and the checkpoint by StateWriter.
#include "files/checkpoint_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "files/folder_names.h"
#include "files/folders.h"
#include "files/hash.h"
#include "files/output_file.h"
#include "files/stored_file.h"
#include "physics/archive.h"
#include "physics/world.h"
#include "program_file.h"
#include "std.h"

namespace carom {
namespace {

constexpr string_view magic = "caromckp";
constexpr size_t hash_size = 64;
constexpr size_t head_size = magic.size() + 2 * hash_size;

/// A temporary file's, so that the folder is incomplete and other starts remove it.
constexpr const char* checkpoint_name = ".checkpoint.part";
constexpr const char* next_name = "checkpoint.next";

/// A checkpoint, and the hash of its request and program.
struct Stored {
  string request;
  Checkpoint checkpoint;
};

/// Throws ArchiveError if it is damaged.
Stored read_stored(const FilePlace& place) {
  constexpr uint64_t most = uint64_t{1} << 40;
  const string text = read_text(place.folder, checkpoint_name, most).value_or("");
  const string_view body = string_view(text).substr(min(head_size, text.size()));
  if (!text.starts_with(magic) || text.compare(head_size - hash_size, hash_size, sha256(body)) != 0)
    throw ArchiveError();

  static const World world;
  StateReader archive(body, world);
  Stored stored{text.substr(magic.size(), hash_size), {}};
  archive(stored.checkpoint);
  archive.finish();
  return stored;
}

/// The hash of the running program's file.
const string& program_hash() {
  static const string hash = [] {
    const string path = program_file();
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file) fail("read", {-1, ""}, path);
    Sha256 sum;
    string buffer(size_t{1} << 16, '\0');
    while (const size_t n = read_some(file.get(), buffer.data(), buffer.size())) sum.add({buffer.data(), n});
    return sum.hex();
  }();
  return hash;
}

}  // namespace

string CheckpointFile::hash() const {
  return sha256(program_hash() + request_());
}

optional<Checkpoint> CheckpointFile::read() {
  if (!has_checkpoint(place_)) return nullopt;
  try {
    Stored stored = read_stored(place_);
    if (stored.request != hash()) return nullopt;
    return std::move(stored.checkpoint);
  } catch (const ArchiveError&) {
    remove();
    throw;
  }
}

void CheckpointFile::write(Checkpoint checkpoint) {
  StateWriter archive;
  archive(checkpoint);
  const string body = archive.take();

  OutputFile file(place_, next_name);
  file.write(magic);
  file.write(hash());
  file.write(sha256(body));
  file.write(body);
  file.complete();

  // The parts that it counts on come first.
  if (syncfs(place_.folder) != 0) fail("write", place_, "");
  give_name(place_.folder, part_name(next_name), place_, checkpoint_name);
  file.hand_over();
  sync_names(place_);
}

void CheckpointFile::remove() {
  remove_entry(place_, checkpoint_name);
}

bool has_checkpoint(const FilePlace& place) {
  struct stat info {};
  return fstatat(place.folder, checkpoint_name, &info, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(info.st_mode);
}

optional<Checkpoint> any_checkpoint(const FilePlace& place) {
  if (!has_checkpoint(place)) return nullopt;
  try {
    return read_stored(place).checkpoint;
  } catch (const ArchiveError&) {
    return nullopt;
  }
}

optional<Checkpoint> any_checkpoint(const string& folder) {
  const Descriptor opened = open_folder(AT_FDCWD, folder.empty() ? "." : folder, true);
  return opened ? any_checkpoint({opened.get(), folder}) : nullopt;
}

}  // namespace carom
