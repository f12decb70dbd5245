#pragma once
// The films of compared runs, side by side.

#include "export/side_by_side.h"
#include "std.h"
#include "study/run_list.h"

namespace carom {

/// The film of each run, labelled with the words of its scene: its title if the runs' titles differ, or the name of its
/// folder, unless the runs are those of a sweep; and its varied values.
/// Throws ExportError. Its text names what a run lacks and the remedy.
vector<FilmTile> film_tiles(const RunSet& runs);

}  // namespace carom
