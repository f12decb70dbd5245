// Searches the table of outputs for a name, so that a new series needs no code here. Opened folders are kept, because a
// series may have many files.
#include "files/series_folders.h"

#include "files/folders.h"
#include "scene/film_format.h"
#include "scene/output_kinds.h"
#include "std.h"

namespace carom {

const OutputKind* output_with_series(string_view name) {
  const size_t slash = name.find('/');
  if (slash == string_view::npos) return nullptr;
  for (const OutputKind& kind : output_kinds())
    if (kind.series.folder == name.substr(0, slash) && kind.series.has(name.substr(slash + 1))) return &kind;
  return nullptr;
}

const OutputKind* output_of(string_view name) {
  if (const OutputKind* kind = output_with_series(name)) return kind;
  for (const OutputKind& kind : output_kinds())
    if (kind.has_file(name)) return &kind;
  return nullptr;
}

bool depends_on_look(string_view name) {
  const OutputKind* kind = output_of(name);
  return kind != nullptr ? kind->draws : film_format(name).has_value();
}

FileSpot SeriesFolders::spot(string_view name) {
  const size_t slash = name.find('/');
  if (slash == string_view::npos) return {folder_, string(name)};
  return {open(name.substr(0, slash)), string(name.substr(slash + 1))};
}

int SeriesFolders::open(string_view name) {
  const auto found = opened_.find(name);
  if (found != opened_.end()) return found->second.get();
  return opened_.emplace(name, open_folder(folder_, string(name), false)).first->second.get();
}

vector<string> series_folder_names() {
  vector<string> names;
  for (const OutputKind& kind : output_kinds())
    if (!kind.series.folder.empty()) names.emplace_back(kind.series.folder);
  return names;
}

}  // namespace carom
