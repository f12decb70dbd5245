#pragma once
// SHA-256, with which a manifest records the content of each file.
#include <nettle/sha2.h>

#include "std.h"

namespace carom {

class Sha256 {
 public:
  Sha256() { sha256_init(&context_); }
  void add(string_view bytes);
  /// 64 lower-case hexadecimal digits of all bytes added. The hash then starts anew.
  string hex();

 private:
  sha256_ctx context_;
};

string sha256(string_view bytes);

}  // namespace carom
