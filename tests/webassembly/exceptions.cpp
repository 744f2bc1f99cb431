// SPDX-License-Identifier: Apache-2.0
// Throws and catches in every way, and prints what happens: the same in WebAssembly and natively.
#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

struct Noisy {
  explicit Noisy(const char* own) : name(own) {}
  Noisy(const Noisy& other) : name(other.name) { std::printf("copy of %s\n", name); }
  Noisy& operator=(const Noisy&) = delete;
  ~Noisy() { std::printf("end of %s\n", name); }
  const char* name;
};
struct Left {
  virtual ~Left() = default;
  int left = 1;
};
struct Right {
  virtual ~Right() = default;
  int right = 2;
};
struct Both : Left, Right {};
struct Hidden : private Left, public Right {};
struct Top {
  virtual ~Top() = default;
  int top = 3;
};
struct ByVirtual : Left, virtual Top {};

void refuse(int x) {
  const Noisy local("local");
  if (x > 2) throw std::invalid_argument("too large: " + std::to_string(x));
  std::printf("fine: %d\n", x);
}

void rethrow() {
  try {
    refuse(7);
  } catch (const std::exception& error) {
    std::printf("on with %s\n", error.what());
    throw;
  }
}

template <class Thrown, class Caught>
void pass(const char* what) {
  try {
    try {
      throw Thrown();
    } catch (const Caught&) {
      std::printf("%s: caught\n", what);
    }
  } catch (...) {
    std::printf("%s: not caught\n", what);
  }
}

}  // namespace

int main() {
  for (int x = 2; x < 5; ++x) {
    try {
      refuse(x);
    } catch (const std::runtime_error&) {
      std::puts("wrong handler");
    } catch (const std::logic_error& error) {
      std::printf("caught %s\n", error.what());
    }
  }
  try {
    rethrow();
  } catch (const std::invalid_argument& error) {
    std::printf("caught again: %s\n", error.what());
  }
  try {
    throw 5;
  } catch (long) {
    std::puts("wrong type");
  } catch (int number) {
    std::printf("caught %d\n", number);
  }
  try {
    throw Noisy("thrown");
  } catch (const Noisy& noisy) {
    std::printf("caught %s\n", noisy.name);
    try {
      throw std::out_of_range("within a handler");
    } catch (const std::exception& error) {
      std::printf("caught %s\n", error.what());
    }
    std::printf("still %s\n", noisy.name);
  }
  pass<Both, Left>("first base");
  pass<Both, Right>("second base");
  pass<Hidden, Left>("private base");
  pass<Hidden, Right>("public base");
  pass<ByVirtual, Top>("virtual base");
  pass<Left, Both>("derived class");
  try {
    throw Both();
  } catch (const Right& right) {
    std::printf("the part: %d\n", right.right);
  }
  try {
    throw ByVirtual();
  } catch (const Top& top) {
    std::printf("the part: %d\n", top.top);
  }
  try {
    static_cast<void>(std::string("short").substr(9));
  } catch (const std::out_of_range&) {
    std::puts("the C++ library throws");
  }
}
