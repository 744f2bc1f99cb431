// SPDX-License-Identifier: Apache-2.0
// Links and joints asked for by name, checked by the compiler.
#include <articula/dynamics/jacobian.hpp>
#include <articula/robots/q2d.hpp>

constexpr auto tool = articula::link_index(articula::Q2d{}, "tool_link");
constexpr auto elbow = articula::joint_index(articula::Q2d{}, "elbow_active_joint");

#ifdef UNKNOWN_LINK
constexpr auto mistake = articula::link_index(articula::Q2d{}, "tool_lnik");
#endif
#ifdef UNKNOWN_LINK_OF_POSE
const auto mistake =
    articula::forward_kinematics<"tool_lnik">(articula::Q2d{}, articula::JointVector<2>::Zero());
#endif
#ifdef UNKNOWN_LINK_OF_JACOBIAN
const auto mistake =
    articula::jacobian<"tool_lnik">(articula::Q2d{}, articula::JointVector<2>::Zero());
#endif
#ifdef UNKNOWN_JOINT
constexpr auto mistake = articula::joint_index(articula::Q2d{}, "elbow_active_jiont");
#endif
#ifdef FIXED_JOINT
constexpr auto mistake = articula::joint_index(articula::Q2d{}, "elbow_passive_joint");
#endif
#ifdef NAME_TOO_LONG
constexpr articula::Name mistake =
    "a_name_of_sixty_four_characters_which_is_one_more_than_it_may_be";
#endif

int main() { return static_cast<int>(tool.value) * elbow - 6; }
