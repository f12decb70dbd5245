#pragma once
// Numbers drawn from ranges by a seed, for sweeps: independently, or as a Latin hypercube.

#include "numerics/random.h"
#include "std.h"
#include "yaml/decimal.h"

namespace carom {

/// The numbers from `from` to `to`, from < to.
struct SampledRange {
  Decimal from, to;
  bool log = false;    // uniform in the logarithm; 0 < from
  bool whole = false;  // whole numbers, both ends included
};

enum class Sampling : uint8_t {
  random,  // independent of one another
  latin    // one in each of `count` equal parts of the range, in random order
};

/// `count` numbers as decimals, the same on every machine. Empty: the range needs more than 15 digits.
/// Numbers that need not be whole are multiples of a power of ten between the ends, without these.
/// It is the largest that leaves 100,000 numbers in the range and 1000 in each part of a Latin hypercube.
/// All of them are equally likely, so that the mean is that of the range. With `log` numbers have as few digits.
/// More `random` numbers begin with those of fewer.
vector<string> samples(const SampledRange& range, Sampling sampling, uint64_t count, Random& random);

}  // namespace carom
