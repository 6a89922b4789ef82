// An operator new that counts, for tests of code that must not allocate. Only one file of a program
// may include it, because it replaces the operator for the whole program. With sanitizers, which
// replace the operator themselves, nothing is counted.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROTORUB_COUNTS_ALLOCATIONS 0
#else
#define ROTORUB_COUNTS_ALLOCATIONS 1
#endif

namespace rotorub::test {
inline std::atomic<std::int64_t> allocations{0};
}

#if ROTORUB_COUNTS_ALLOCATIONS
// g++ 12 inlines one of a pair and mistakes the other for the library's.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
// The unaligned and the aligned form; the array forms call these.
void* operator new(std::size_t size) {
  ++rotorub::test::allocations;
  if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++rotorub::test::allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
