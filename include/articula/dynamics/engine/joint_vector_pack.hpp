// SPDX-License-Identifier: Apache-2.0
/// @file The concept of the joint vectors of several robots.
#pragma once

#include "articula/model/robot.hpp"

#include <concepts>

namespace articula {

/// Joint vectors of several robots of one kind: JointVectors with a column for each, or a
/// JointVector over a pack (or over any scalar but double).
template <class Q, class R>
concept JointVectorPack = (Q::ColsAtCompileTime >= 2 &&
                           std::same_as<Q, JointVectors<joint_count<R>, Q::ColsAtCompileTime>>) ||
                          (!std::same_as<typename Q::Scalar, double> &&
                           std::same_as<Q, JointVector<joint_count<R>, typename Q::Scalar>>);

}  // namespace articula
