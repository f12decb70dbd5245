#pragma once
#include "simulate/disjoint_sets.h"

namespace carom {
using Parts = DisjointSets;
}
