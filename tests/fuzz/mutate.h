#pragma once
// Mutated inputs: bytes changed, removed, doubled, joined, words inserted. Determined by the seed on every machine.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace carom::fuzz {

class Mutator {
 public:
  Mutator(std::uint64_t seed, std::span<const std::string> seeds, std::span<const std::string> words)
      : state_(seed), seeds_(seeds), words_(words) {}

  /// Another input of at most this many bytes.
  std::string next(std::size_t longest);

 private:
  std::uint64_t draw(std::uint64_t below);  // 0 ... below - 1
  void change(std::string& bytes);

  std::uint64_t state_;
  std::span<const std::string> seeds_, words_;
};

}  // namespace carom::fuzz
