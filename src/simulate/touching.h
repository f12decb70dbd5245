#pragma once
// Which of many regions may touch one: four, eight or sixteen at a time, whatever the processor has; the same bits as
// may_touch (region.h).
#include <cstddef>
#include <vector>

#include "physics/entity.h"
#include "simulate/region.h"

namespace carom {

/// Writes those of `count` bodies whose regions may touch `region`, or (touching = false) those whose do not, in their
/// order; gives how many. `to` may be `bodies`; it needs room for `select_slack` more than it gets.
std::size_t select_touching(const Region& region, const Region* regions, const Entity* bodies, std::size_t count,
                            bool touching, Entity* to);
inline constexpr std::size_t select_slack = 16;

/// What select_touching chooses from, on this processor.
using SelectKernel = decltype(&select_touching);
std::vector<SelectKernel> select_kernels();

}  // namespace carom
