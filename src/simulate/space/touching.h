#pragma once
// The regions, of many, that may touch a given one: four, eight or sixteen at a time, as the processor allows. The bits
// are those of may_touch (region.h).

#include "physics/entity.h"
#include "simulate/space/region.h"
#include "std.h"

namespace carom {

/// Writes those of `count` bodies with regions that may touch `region`, or (touching = false) that cannot, in their
/// order. Returns their number. `to` may be `bodies`. It needs room for `select_slack` more entries than are written.
size_t select_touching(const Region& region, const Region* regions, const Entity* bodies, size_t count, bool touching,
                       Entity* to);
inline constexpr size_t select_slack = 16;

/// The kernels that select_touching can choose from on this processor.
using SelectKernel = decltype(&select_touching);
vector<SelectKernel> select_kernels();

}  // namespace carom
