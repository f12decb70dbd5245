// Writes the scene, and the JSON Schema of this version beside it. An editor then completes keys without a network.
#include "commands/commands.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>

#include "commands/report.h"
#include "commands/starting_scene.h"
#include "commands/terminal.h"
#include "commands/text.h"
#include "files/folder_writer.h"
#include "files/stored_file.h"
#include "scene/scene.h"
#include "scene/schema.h"
#include "std.h"
#include "yaml/diagnostics.h"

namespace carom {

namespace fs = std::filesystem;

namespace {

constexpr string_view schema_name = "scene.schema.json";

fs::path scene_path(const string& name) {
  fs::path path(name);
  const string ending = path.extension().string();
  if (ending != ".yaml" && ending != ".yml") path += ".yaml";
  const string file = path.filename().string();
  // Longer names leave no room for the names of a run's folder and files.
  if (path.stem().empty() || name.ends_with('/') || !is_plain_name(file) || file.front() == '-' || file.size() > 150) {
    throw UsageError(
        fmt::format("{} is not a name for a scene; name a file such as demos/first.yaml, without control characters, "
                    "backslashes or a dot or dash at its start",
                    in_backticks(name)));
  }
  return path;
}

/// Creates the folder if necessary and opens it.
Descriptor opened(const string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail("make", {-1, folder}, "", error.message());
  Descriptor open = open_folder(AT_FDCWD, folder, true);
  if (!open) fail("open", {-1, folder}, "");
  return open;
}

/// Throws UsageError if a folder has the name, or any other file has it and --force is not given.
void refuse_existing(const FilePlace& place, const string& name, bool force) {
  struct stat info {};
  if (fstatat(place.folder, name.c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0) {
    if (!is_absent(errno)) fail("look at", place, name);
    return;
  }
  const string path = printable((fs::path(place.path) / name).lexically_normal().string());
  if (S_ISDIR(info.st_mode)) throw UsageError(fmt::format("{} is a folder", path), "choose another name");
  if (!force)
    throw UsageError(fmt::format("{} exists already", path), "choose another name, or overwrite it with --force");
}

/// A schema of another version is replaced; any other file of that name stays.
bool is_schema(const FilePlace& place) {
  constexpr uint64_t most = 10'000'000;
  const string whole = json_schema("scene"), start = whole.substr(0, whole.find("\"description\""));
  const auto text = read_text(place.folder, string(schema_name), most);
  return text && text->starts_with(start);
}

int write_new(const Options& options) {
  const fs::path path = scene_path(options.operands.front());
  const string file = path.filename().string(), parent = path.parent_path().string();
  const string folder = parent.empty() ? "." : parent;
  const Descriptor open = opened(folder);
  const FilePlace place{open.get(), folder};
  refuse_existing(place, file, options.force);
  refuse_existing(place, string(schema_name), options.force || is_schema(place));

  OutputFile schema(place, string(schema_name)), scene(place, file);
  schema.write(json_schema("scene"));
  scene.write(starting_scene());
  schema.complete();
  scene.complete();
  schema.publish();
  scene.publish();

  const string beside = (path.parent_path() / schema_name).string();
  return print_end(options, 0, {{"scene", path.string()}, {"schema", beside}},
                   fmt::format("wrote {} and {}\n", printable(path.string()), printable(beside)));
}

}  // namespace

const Command new_command = {
    "new",
    write_new,
    "writes a scene to start from, with comments",
    "  carom new first                                       writes first.yaml and scene.schema.json\n"
    "  carom new demos/second.yaml                           the same in demos/, created if necessary\n",
    "The scene runs as it is. With the schema beside it, an editor with a YAML language server completes\n"
    "and checks keys. Exit codes: 0 done, 1 a file could not be written, 2 the command line is wrong or the\n"
    "file exists already.",
    {{"--force", "overwrite existing files"}},
    "NAME",
    "the scene file, with or without .yaml and a folder",
    "name the scene: carom {} first",
    1,
    1};

}  // namespace carom
