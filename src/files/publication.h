#pragma once
// Files that are whole get their names, all of them or, for who looks later, none: the manifest that names them stands
// as `next_manifest` from the moment that decides until the last one has its name. Where it stands, the folder is made
// what it says by any later command. Before that moment nothing of the folder's former state is touched.
#include <string>
#include <vector>

#include "files/output_file.h"
#include "files/run_folder.h"

namespace carom {

/// A part's name: of what it means for other programs, the folder is not whole.
inline constexpr const char* next_manifest = ".manifest.json.next.part";

/// Of `files` and the manifest, which are complete: names follow bytes, the manifest's name follows the others'. What
/// the folder's former manifest names and this one does not is removed, and all other parts. Throws ExportError; what
/// was decided by then is finished by the next command.
void publish(const FilePlace& place, Durability durability, const std::vector<PartFile*>& files, OutputFile& manifest);

/// Finishes what an interrupted publish() decided. The folder must be locked by the caller. Throws ExportError.
void finish_publication(const FilePlace& place, Durability durability);

/// The same for a folder that is to be read: one that is not there, where nothing was decided, or that another run is
/// writing, is left as it is. Throws ExportError.
void settle_folder(const std::string& path);

/// Parts of files, why a run failed, and series' folders without files go; `spared`: a part that stays. Throws
/// ExportError.
void remove_leavings(const FilePlace& place, std::string_view spared = {});

/// Removes the named files of a run. Throws ExportError.
void remove_files(const FilePlace& place, const std::vector<std::string>& names);

}  // namespace carom
