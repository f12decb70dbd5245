#pragma once
// Slabs of space: what threads take of a large crowd. They depend on its places alone, and mirror images of a crowd
// have mirror images of its slabs.

#include "simulate/crowd/crowd.h"
#include "std.h"

namespace carom {

/// Orders the members by slabs along the widest axis, and in each slab by name. Slabs have as many members each. On
/// average they are several times as thick as most rows are long: the radii of both bodies and `beyond_radii` (m). A
/// small crowd is one slab. The rows become those of other numbers.
void arrange_in_slabs(Crowd& crowd, double beyond_radii);

/// The pairs of each part of the rows, in the order of their names.
vector<vector<CrowdRows::Pair>> pairs_of_parts(const CrowdRows& rows, span<const CrowdRows::Pair> pairs);

}  // namespace carom
