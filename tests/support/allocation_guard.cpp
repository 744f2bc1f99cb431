// SPDX-License-Identifier: Apache-2.0
#include "allocation_guard.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdlib>

namespace {

// Plain thread-locals with constant initialisers: reading them allocates nothing.
constinit thread_local bool armed = false;
constinit thread_local std::size_t violation_count = 0;
constinit thread_local const char* first_call = "none";

void note(const char* call) noexcept {
  if (!armed) return;
  if (violation_count == 0) first_call = call;
  ++violation_count;
}

}  // namespace

namespace articula::testing {

AllocationGuard::AllocationGuard() noexcept {
  violation_count = 0;
  first_call = "none";
  armed = true;
}

AllocationGuard::~AllocationGuard() { armed = false; }

void AllocationGuard::disarm() noexcept { armed = false; }

std::size_t AllocationGuard::violations() const noexcept { return violation_count; }

const char* AllocationGuard::first_violation() const noexcept { return first_call; }

}  // namespace articula::testing

// The program's own definitions take precedence over those of the C library, for the libraries it
// loads as well; operator new and delete of libstdc++ end up here. glibc's allocator stays
// reachable under its second names.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) noexcept {
  note("malloc");
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  note("calloc");
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  note("realloc");
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  note("memalign");
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  note("aligned_alloc");
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  note("posix_memalign");
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

void free(void* memory) noexcept {
  note("free");
  __libc_free(memory);
}

}  // extern "C"
