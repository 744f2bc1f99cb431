// SPDX-License-Identifier: Apache-2.0
/// @file Simulated hardware whose feedback is one period old.
#pragma once

#include <articula/core/hardware.hpp>

namespace support {

/// Simulated hardware whose feedback is one period old, as that of drives which sample at SYNC and
/// obey at SYNC.
template <class Simulation>
class OnePeriodLate : public Simulation {
 public:
  static constexpr int joint_count = Simulation::joint_count;

  OnePeriodLate() { static_cast<void>(Simulation::read(sampled_)); }

  [[nodiscard]] articula::Status read(articula::JointState<joint_count>& state) noexcept {
    state = sampled_;
    return articula::Status::ok;
  }
  template <class Command>
  [[nodiscard]] articula::Status write(const Command& command) noexcept {
    const articula::Status status = Simulation::read(sampled_);
    return status == articula::Status::ok ? Simulation::write(command) : status;
  }

 private:
  articula::JointState<joint_count> sampled_{};
};

}  // namespace support
