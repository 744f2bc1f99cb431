// SPDX-License-Identifier: Apache-2.0
/// @file What WebAssembly programs do instead of throwing: they print the message and end.
///
/// Debian's C++ library for WebAssembly has no exceptions. Link this file with programs that are
/// compiled with -Xclang -fignore-exceptions; see docs/webassembly.md.

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <typeinfo>

// The two functions that compilers call for `throw` [Itanium C++ ABI, section 2.4].
extern "C" {

void* __cxa_allocate_exception(std::size_t size) noexcept { return std::malloc(size); }

[[noreturn]] void __cxa_throw(void* exception, std::type_info* type, void (*)(void*)) {
  const char* message = type->name();
  if (*type == typeid(std::invalid_argument) || *type == typeid(std::runtime_error) ||
      *type == typeid(std::logic_error)) {
    message = static_cast<std::exception*>(exception)->what();
  }
  std::fprintf(stderr, "error: %s\n", message);
  std::exit(1);
}
}
