// SPDX-License-Identifier: Apache-2.0
/// @file Runs two threads through every order in which their atomic operations can take place, and
/// finds data races by happens-before [C++20, intro.races].
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <semaphore>
#include <thread>
#include <utility>
#include <vector>

namespace support {

/// Two threads of which one runs at a time. Before each atomic operation a thread hands control
/// back, and the schedule says who goes on. All schedules are gone through, depth first.
///
/// Each thread counts how far it has seen the other (a vector clock): an acquiring operation on an
/// atomic that was released raises the count. An access to plain memory that is not ordered after
/// the other thread's last conflicting access is a race, whatever the hardware would make of it.
class Interleavings {
 public:
  using Clock = std::array<std::uint64_t, 2>;

  /// The explorer that runs now; the atomics and the watched memory below report to it.
  static inline Interleavings* current = nullptr;

  /// Runs `make()`'s two functions in all orders. `make` sets up fresh shared state each time;
  /// `check` is called when both have ended.
  /// @return the number of orders
  std::size_t explore(const std::function<std::array<std::function<void()>, 2>()>& make,
                      const std::function<void()>& check) {
    current = this;
    std::size_t orders = 0;
    std::vector<Choice> choices;
    do {
      run(make(), choices);
      check();
      ++orders;
      while (!choices.empty() && !(choices.back().both && choices.back().thread == 0)) {
        choices.pop_back();
      }
      if (!choices.empty()) choices.back().thread = 1;
    } while (!choices.empty());
    current = nullptr;
    return orders;
  }

  [[nodiscard]] std::size_t races() const { return races_; }

  /// Called by a thread before each atomic operation.
  void step() {
    if (!running_) return;         // set-up and check, outside the two threads
    const std::size_t me = self_;  // changes as soon as control is handed back
    back_.release();
    go_[me].acquire();
  }

  /// The thread that runs now.
  [[nodiscard]] std::size_t self() const { return self_; }
  [[nodiscard]] bool running() const { return running_; }
  [[nodiscard]] Clock& clock() { return clocks_[self_]; }
  void tick() { ++clocks_[self_][self_]; }
  void note_race() { ++races_; }

 private:
  struct Choice {
    std::size_t thread;
    bool both;  ///< the other one could have gone on as well
  };

  void run(const std::array<std::function<void()>, 2>& functions, std::vector<Choice>& choices) {
    clocks_ = {Clock{1, 0}, Clock{0, 1}};
    std::array<bool, 2> done{false, false};
    running_ = true;
    std::array<std::thread, 2> threads;
    for (std::size_t i = 0; i < 2; ++i) {
      threads[i] = std::thread([&, i] {
        go_[i].acquire();
        functions[i]();
        done[i] = true;
        back_.release();
      });
    }
    for (std::size_t depth = 0; !(done[0] && done[1]); ++depth) {
      if (depth == choices.size()) {
        choices.push_back({done[0] ? std::size_t{1} : std::size_t{0}, !done[0] && !done[1]});
      }
      self_ = choices[depth].thread;
      go_[self_].release();
      back_.acquire();
    }
    for (auto& thread : threads) thread.join();
    running_ = false;
  }

  std::array<std::binary_semaphore, 2> go_{std::binary_semaphore(0), std::binary_semaphore(0)};
  std::binary_semaphore back_{0};
  std::array<Clock, 2> clocks_{};
  std::size_t self_ = 0;
  bool running_ = false;
  std::size_t races_ = 0;
};

/// Stands in for std::atomic: the same operations, each a step of the explorer.
/// @tparam Obeys  whether memory orders are obeyed; if not, all are relaxed, which a test of the
///                explorer itself uses
template <class T, bool Obeys = true>
class SteppedAtomic {
 public:
  SteppedAtomic(T value = {}) : value_(value) {}  // NOLINT: as std::atomic

  [[nodiscard]] T load(std::memory_order order) const {
    enter();
    acquire(order);
    return value_;
  }
  void store(T value, std::memory_order order) {
    enter();
    release(order, false);
    value_ = value;
  }
  T exchange(T value, std::memory_order order) {
    enter();
    acquire(order);
    release(order, true);
    return std::exchange(value_, value);
  }

 private:
  static void enter() { Interleavings::current->step(); }
  void acquire(std::memory_order order) const {
    auto& explorer = *Interleavings::current;
    const bool acquires = order == std::memory_order_acquire || order == std::memory_order_acq_rel;
    if (!Obeys || !acquires || !explorer.running()) return;
    for (std::size_t i = 0; i < 2; ++i) {
      explorer.clock()[i] = std::max(explorer.clock()[i], released_[i]);
    }
  }
  /// @param exchanges  an exchange continues the release sequence of the operation before it
  void release(std::memory_order order, bool exchanges) {
    auto& explorer = *Interleavings::current;
    const bool releases = order == std::memory_order_release || order == std::memory_order_acq_rel;
    if (!explorer.running()) return;
    if (Obeys && releases) {
      for (std::size_t i = 0; i < 2; ++i) {
        released_[i] = std::max(exchanges ? released_[i] : 0, explorer.clock()[i]);
      }
      explorer.tick();
    } else if (!exchanges) {
      released_ = {};
    }
  }

  T value_;
  Interleavings::Clock released_{};
};

template <class T>
using ObedientAtomic = SteppedAtomic<T, true>;
template <class T>
using RelaxedAtomic = SteppedAtomic<T, false>;

/// A number in plain memory whose accesses are watched for races.
class Watched {
 public:
  Watched() = default;
  explicit Watched(int number) : number_(number) {}
  Watched(const Watched& other) { *this = other; }
  Watched& operator=(const Watched& other) {
    other.access(false);
    access(true);
    number_ = other.number_;
    return *this;
  }
  [[nodiscard]] int number() const {
    access(false);
    return number_;
  }

 private:
  void access(bool writes) const {
    auto* explorer = Interleavings::current;
    if (explorer == nullptr || !explorer->running()) return;
    const std::size_t me = explorer->self(), other = 1 - me;
    const std::uint64_t seen = explorer->clock()[other];
    if (written_[other] > seen || (writes && read_[other] > seen)) explorer->note_race();
    (writes ? written_ : read_)[me] = explorer->clock()[me];
  }

  int number_ = 0;
  mutable std::array<std::uint64_t, 2> written_{};  ///< each thread's clock at its last write
  mutable std::array<std::uint64_t, 2> read_{};
};

}  // namespace support
