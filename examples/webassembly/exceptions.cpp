// SPDX-License-Identifier: Apache-2.0
/// @file Exceptions for WebAssembly programs.
///
/// Debian's C++ library for WebAssembly has no exceptions, but its compiler and all present
/// browsers have them. Link this file with programs that are compiled with -fwasm-exceptions; see
/// docs/webassembly.md. Source: [Itanium C++ ABI, sections 2 and 2.9.5]; tables of the exception
/// handling as LLVM writes them for WebAssembly.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <typeinfo>

namespace {

/// What stands before each thrown object.
struct alignas(16) Header {
  const std::type_info* type = nullptr;
  void* (*destroy)(void*) = nullptr;  ///< destructors return their object in WebAssembly
  void* adjusted = nullptr;           ///< the object as its handler sees it
  Header* below = nullptr;            ///< the exception that was being handled before
  int handlers = 0;  ///< that have begun and not ended; negative once it was thrown on

  [[nodiscard]] void* object() noexcept { return this + 1; }
};

Header* handled = nullptr;  ///< the exception whose handler began last

// The descriptions of classes, as the ABI lays them out behind std::type_info.
struct SingleBase : std::type_info {
  const std::type_info* base;
};
struct ManyBases : std::type_info {
  struct Base {
    const std::type_info* type;
    std::intptr_t offset_and_flags;  ///< flags: 1 virtual, 2 public
  };
  unsigned flags, count;
  Base bases[1];  ///< `count` of them
};

/// Where the table of the virtual functions of a type_info begins, which tells its kind.
[[nodiscard]] const void* kind_of(const std::type_info* type) noexcept {
  const void* table = nullptr;
  std::memcpy(&table, static_cast<const void*>(type), sizeof table);
  return table;
}

}  // namespace

extern "C" {
extern const char single_base_table[] __asm__("_ZTVN10__cxxabiv120__si_class_type_infoE");
extern const char many_bases_table[] __asm__("_ZTVN10__cxxabiv121__vmi_class_type_infoE");
}

namespace {

/// The part of an object of a class that is of another class; nullptr if there is none.
[[nodiscard]] char* part_of(char* object, const std::type_info* type,
                            const std::type_info* wanted) noexcept {
  constexpr std::size_t before_functions = 2 * sizeof(void*);
  if (*type == *wanted) return object;
  if (kind_of(type) == single_base_table + before_functions) {
    return part_of(object, static_cast<const SingleBase*>(type)->base, wanted);
  }
  if (kind_of(type) != many_bases_table + before_functions) return nullptr;
  const auto* many = static_cast<const ManyBases*>(type);
  for (unsigned i = 0; i < many->count; ++i) {
    const ManyBases::Base& base = many->bases[i];
    std::intptr_t offset = base.offset_and_flags >> 8;
    if ((base.offset_and_flags & 2) == 0) continue;
    if ((base.offset_and_flags & 1) != 0) {  // the offset stands in the object's own table
      const char* table = nullptr;
      std::memcpy(&table, object, sizeof table);
      std::memcpy(&offset, table + offset, sizeof offset);
    }
    if (char* part = part_of(object + offset, base.type, wanted)) return part;
  }
  return nullptr;
}

/// A table in memory, read number by number.
struct Reader {
  const unsigned char* at;

  std::uintptr_t unsigned_number() noexcept {
    std::uintptr_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      value |= static_cast<std::uintptr_t>(*at & 0x7f) << shift;
      if ((*at++ & 0x80) == 0) return value;
    }
  }
  std::intptr_t signed_number() noexcept {
    std::uintptr_t value = 0;
    unsigned shift = 0, byte = 0;
    do {
      byte = *at++;
      value |= static_cast<std::uintptr_t>(byte & 0x7f) << shift;
      shift += 7;
    } while ((byte & 0x80) != 0);
    if ((byte & 0x40) != 0 && shift < 8 * sizeof value) value |= ~std::uintptr_t(0) << shift;
    return static_cast<std::intptr_t>(value);
  }
};

/// The handler at a place that takes an exception: its number in the table of types; 0: none.
/// @param table  of the function
/// @param place  number of the place in it
[[nodiscard]] int handler_for(Header& header, const unsigned char* table, std::uintptr_t place) {
  constexpr unsigned omitted = 0xff;
  Reader reader{table};
  if (*reader.at++ != omitted) std::abort();  // the start of places, which LLVM leaves out
  const unsigned char* types = nullptr;
  if (*reader.at++ != omitted) {
    const std::uintptr_t length = reader.unsigned_number();
    types = reader.at + length;
  }
  ++reader.at;  // the encoding of places
  const std::uintptr_t places_length = reader.unsigned_number();
  const unsigned char* const actions = reader.at + places_length;
  std::uintptr_t action = 0;
  for (std::uintptr_t i = 0; i <= place; ++i) {
    static_cast<void>(reader.unsigned_number());
    action = reader.unsigned_number();
  }
  if (action == 0) return 0;
  reader.at = actions + action - 1;
  for (;;) {
    const std::intptr_t number = reader.signed_number();
    const unsigned char* const here = reader.at;
    const std::intptr_t next = reader.signed_number();
    if (number < 0) std::terminate();  // a dynamic exception specification
    if (number > 0) {
      const std::type_info* wanted = nullptr;
      std::memcpy(&wanted, types - static_cast<std::size_t>(number) * sizeof wanted, sizeof wanted);
      char* const object = static_cast<char*>(header.object());
      char* const part = wanted == nullptr ? object : part_of(object, header.type, wanted);
      if (part != nullptr) {
        header.adjusted = part;
        return static_cast<int>(number);
      }
    }
    if (next == 0) return 0;
    reader.at = here + next;
  }
}

}  // namespace

extern "C" {

/// The compiler's code writes where an exception has arrived, and reads which handler takes it.
struct LandingPad {
  std::uintptr_t place;
  const unsigned char* table;
  std::uintptr_t handler;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* exception) {
  __wasm_lpad_context.handler = static_cast<std::uintptr_t>(handler_for(
      *static_cast<Header*>(exception), __wasm_lpad_context.table, __wasm_lpad_context.place));
  return 0;
}

void* __cxa_allocate_exception(std::size_t size) noexcept {
  void* const memory = std::calloc(1, sizeof(Header) + size);
  if (memory == nullptr) std::terminate();
  return static_cast<Header*>(memory) + 1;
}
void __cxa_free_exception(void* object) noexcept { std::free(static_cast<Header*>(object) - 1); }

[[noreturn]] void __cxa_throw(void* object, std::type_info* type, void* (*destroy)(void*)) {
  Header& header = static_cast<Header*>(object)[-1];
  header.type = type;
  header.destroy = destroy;
  header.adjusted = object;
  __builtin_wasm_throw(0, &header);
}

void* __cxa_begin_catch(void* exception) noexcept {
  Header& header = *static_cast<Header*>(exception);
  header.handlers = (header.handlers < 0 ? -header.handlers : header.handlers) + 1;
  if (handled != &header) {
    header.below = handled;
    handled = &header;
  }
  return header.adjusted;
}
void* __cxa_get_exception_ptr(void* exception) noexcept {
  return static_cast<Header*>(exception)->adjusted;
}
void __cxa_end_catch() {
  Header& header = *handled;
  const bool is_thrown_on = header.handlers < 0;
  header.handlers += is_thrown_on ? 1 : -1;
  if (header.handlers != 0) return;
  handled = header.below;
  if (is_thrown_on) return;
  if (header.destroy != nullptr) header.destroy(header.object());
  std::free(&header);
}
[[noreturn]] void __cxa_rethrow() {
  if (handled == nullptr) std::terminate();
  handled->handlers = -handled->handlers;
  __builtin_wasm_throw(0, handled);
}
}
