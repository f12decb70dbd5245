#pragma once
// Asks memory for what is needed soon.

namespace carom {

inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");  // lest the compiler takes a function that does nothing else for one without effect
}

}  // namespace carom
