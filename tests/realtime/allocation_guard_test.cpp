// SPDX-License-Identifier: Apache-2.0
// The guard of the other tests in this folder, on itself.
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "allocation_guard.hpp"
#include "catch.hpp"

using articula::testing::AllocationGuard;
using articula::testing::heap_calls_in;

namespace {

// The compiler may drop an allocation that nobody looks at. It cannot know who looks here.
void* volatile seen = nullptr;

struct alignas(64) CacheLine {
  double value[8] = {};
};

}  // namespace

TEST_CASE("the guard is silent where the heap is not touched") {
  double sum = 0.0;
  CHECK(heap_calls_in([&] {
          for (int i = 0; i < 100; ++i) sum += i;
        }) == 0);
  CHECK(sum == 4950.0);
}

TEST_CASE("the guard counts each call of the C functions") {
  CHECK(heap_calls_in([] {
          seen = std::malloc(8);
          std::free(seen);
        }) == 2);
  CHECK(heap_calls_in([] {
          seen = std::calloc(2, 8);
          seen = std::realloc(seen, 64);
          std::free(seen);
        }) == 3);
  CHECK(heap_calls_in([] {
          seen = std::aligned_alloc(64, 64);
          std::free(seen);
        }) == 2);
  CHECK(heap_calls_in([] {
          void* memory = nullptr;
          if (posix_memalign(&memory, 64, 64) != 0) return;
          seen = memory;
          std::free(seen);
        }) == 2);
}

TEST_CASE("the guard counts operator new and delete") {
  CHECK(heap_calls_in([] {
          auto* number = new int(1);
          seen = number;
          delete number;
        }) == 2);
  CHECK(heap_calls_in([] {
          auto line = std::make_unique<CacheLine>();
          seen = line.get();
        }) == 2);
}

TEST_CASE("the guard counts what containers and exceptions do") {
  CHECK(heap_calls_in([] {
          std::vector<double> numbers(100);
          seen = numbers.data();
        }) == 2);
  CHECK(heap_calls_in([] {
          std::string text(100, 'a');  // too long to be kept inside the object
          seen = text.data();
        }) == 2);
  CHECK(heap_calls_in([] {
          try {
            throw std::runtime_error("thrown");
          } catch (const std::exception&) {
          }
        }) > 0);
}

TEST_CASE("the guard names the first call") {
  AllocationGuard guard;
  seen = std::calloc(1, 8);
  std::free(seen);
  guard.disarm();
  CHECK(guard.violations() == 2);
  CHECK(std::string(guard.first_violation()) == "calloc");
}

TEST_CASE("the guard watches its own thread and only while armed") {
  AllocationGuard guard;
  guard.disarm();
  seen = std::malloc(8);
  std::free(seen);
  CHECK(guard.violations() == 0);
  CHECK(std::string(guard.first_violation()) == "none");

  std::size_t elsewhere = 1;
  std::thread other([&] {
    elsewhere = heap_calls_in([] {});
    seen = std::malloc(8);
    std::free(seen);
  });
  other.join();
  CHECK(elsewhere == 0);
  CHECK(guard.violations() == 0);
}
