#pragma once
// Publishes complete files: either all of them receive their final names, or none does for a later reader.
// The new manifest has the name `next_manifest` from the moment of decision until the last file has its final name.
// Any later command that finds `next_manifest` completes the publication.
// Before the moment of decision, the former content of the folder is untouched.

#include "files/output_file.h"
#include "std.h"

namespace carom {

/// Whether a file survives a power failure once it has its final name.
/// A deferred file may then be lost, which a reader detects by size and hash.
/// For many small runs the caller syncs the file system from time to time (sync_file_system).
enum class Durability { synced, deferred };

/// The file in the folder of a failed run of a sweep. It holds the reason as text.
inline constexpr const char* failure_file = "error.txt";

/// A temporary name. To other programs the folder is therefore incomplete.
inline constexpr const char* next_manifest = ".manifest.json.next.part";

/// Publishes `files` and the manifest, which must be complete. Bytes are synced before names.
/// The files are renamed before the manifest.
/// Files of the folder's former manifest that the new one does not name are removed, and all other temporary files.
/// Throws ExportError. The next command completes a committed publication.
void publish(const FilePlace& place, Durability durability, const vector<PartFile*>& files, OutputFile& manifest);

/// Finishes an interrupted publish(). The caller must hold the folder's lock. Throws ExportError.
void finish_publication(const FilePlace& place, Durability durability);

/// The same before a folder is read. An absent folder stays as it is.
/// So does one without a committed publication, or one that another run is writing. Throws ExportError.
void settle_folder(const string& path);

/// Removes temporary files, the reason of a failed run, and folders of series without files. Throws ExportError.
/// `spared`: a temporary file that stays.
void remove_leavings(const FilePlace& place, string_view spared = {});

/// Removes the named files of a run. Throws ExportError.
void remove_files(const FilePlace& place, const vector<string>& names);

}  // namespace carom
