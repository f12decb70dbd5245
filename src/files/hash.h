#pragma once
// SHA-256: how a manifest tells whether a file still is what a run wrote.
#include <nettle/sha2.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }
  void add(std::string_view bytes);
  std::string hex();  // 64 lower-case digits, of all that was added; then starts anew

 private:
  sha256_ctx context_;
};

std::string sha256(std::string_view bytes);

}  // namespace carom
