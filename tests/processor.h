#pragma once
// What tests may expect of the present processor.

namespace carom {

/// Whether ISA-L packs by its functions for SSE4.2 and later, which all give the same bytes. Those for other processors
/// give others.
inline bool packs_by_sse42() {
#ifdef __x86_64__
  return __builtin_cpu_supports("sse4.2");
#else
  return false;
#endif
}

}  // namespace carom
