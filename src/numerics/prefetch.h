#pragma once
// Loads memory into the cache ahead of its use.

namespace carom {

inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // Without this, the compiler may remove a call to a function that does nothing else.
  asm volatile("");
}

}  // namespace carom
