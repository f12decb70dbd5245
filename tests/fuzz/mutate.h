#pragma once
// Mutated inputs: bytes changed, removed, doubled, cut off, joined, other numbers, words inserted. Determined by the
// seed on every machine.

#include "std.h"

namespace carom::fuzz {

class Mutator {
 public:
  Mutator(uint64_t seed, span<const string> seeds, span<const string> words)
      : state_(seed), seeds_(seeds), words_(words) {}

  /// Another input of at most this many bytes.
  string next(size_t longest);

 private:
  uint64_t draw(uint64_t below);  // 0 ... below - 1
  void change(string& bytes);

  uint64_t state_;
  span<const string> seeds_, words_;
};

}  // namespace carom::fuzz
