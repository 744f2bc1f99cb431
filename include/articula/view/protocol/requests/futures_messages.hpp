// SPDX-License-Identifier: Apache-2.0
/// @file Questions for futures from clients, and the answers to them.
#pragma once

#include "articula/remote/forecast/futures_question.hpp"
#include "articula/remote/sheet/robot_sheet.hpp"
#include "articula/view/protocol/requests/requests.hpp"

#include <array>

namespace articula::view {

/// Of the service /futures.
inline constexpr std::array futures_members{
    Member{"gains", Kind::gain_by_name},    Member{"count", Kind::integer},
    Member{"horizon", Kind::number},        Member{"samples", Kind::integer},
    Member{"seed", Kind::integer},          Member{"mass", Kind::number},
    Member{"friction", Kind::number},       Member{"delay", Kind::integer},
    Member{"position_noise", Kind::number}, Member{"velocity_noise", Kind::number},
    Member{"start", Kind::object},          Member{"history", Kind::objects},
    Member{"references", Kind::objects},    Member{"reference_step", Kind::number},
    Member{"steps", Kind::number_by_name}};

/// Reads a question whose members were checked, and checks those of its start and its references.
/// The port checks their ranges.
[[nodiscard]] Asked read_futures(const Json& call);

/// The answer of the service /futures. Of each joint it has the quantiles of all futures at each
/// sample, and some futures as they are. Infinite margins are null.
[[nodiscard]] Json futures_json(const remote::FuturesAnswer& answer,
                                const remote::RobotSheet& robot);

}  // namespace articula::view
