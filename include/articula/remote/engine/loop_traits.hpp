// SPDX-License-Identifier: Apache-2.0
/// @file The kind of a Remote's loop, from its type.
#pragma once

#include "articula/core/joint_vector.hpp"

#include <type_traits>
#include <utility>

namespace articula::remote {

/// Whether a loop has modes, as a SupervisedControlLoop.
template <class LoopType>
inline constexpr bool is_supervised = requires(LoopType& loop) { loop.request_activation(); };

/// The hardware of a loop.
template <class LoopType>
using HardwareOf = std::remove_cvref_t<decltype(std::declval<LoopType&>().hardware())>;

/// Whether the hardware of a loop is simulated: joints can be put into another state and pulled.
template <class LoopType>
inline constexpr bool is_simulated =
    requires(HardwareOf<LoopType>& hardware, const JointVector<LoopType::joint_count>& numbers) {
      hardware.set_state(numbers, numbers);
      hardware.set_external_effort(numbers);
      hardware.true_state();
    };

}  // namespace articula::remote
