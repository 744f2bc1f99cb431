// SPDX-License-Identifier: Apache-2.0
/// @file From a description to a model: order the tree, weld what does not move, turn axes to z.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/model.hpp"
#include "articula/model/validation.hpp"

#include <array>
#include <span>

namespace articula {

/// How many joints and bodies the model of a description has.
struct ModelSize {
  int joints = 0;  ///< that move and mimic no other
  int bodies = 0;  ///< that move
};

/// The size of the model that build_model makes of these joints.
[[nodiscard]] constexpr ModelSize model_size(std::span<const Joint> joints) noexcept {
  ModelSize size;
  for (const Joint& joint : joints) {
    if (joint.type == JointType::fixed) continue;
    ++size.bodies;
    if (joint.mimic.joint.empty()) ++size.joints;
  }
  return size;
}

namespace detail {

/// Fills a model while walking down the tree, depth first, siblings by joint name: the order of
/// joints that urdfdom and Pinocchio give.
template <class AnyModel>
struct ModelBuilder {
  std::span<const Link> links;
  std::span<const Joint> joints;
  AnyModel& model;
  std::array<const Joint*, AnyModel::body_count> carriers{};  ///< of the bodies
  int joint_count = 0;
  int body_count = 0;
  std::size_t link_count = 0;

  /// @param name       the link to place
  /// @param body       index of the moving body that it belongs to, -1 for the base
  /// @param placement  the link's frame in the frame of that body
  /// @param carrier    the joint that carries it
  constexpr void add_link(const Name& name, int body, const Placement<double>& placement,
                          const Name& carrier) {
    const Link& link = links[static_cast<std::size_t>(index_of(links, name))];
    model.links[link_count++] = {name, body, placement, carrier};
    if (body >= 0) {
      Inertia<double>& inertia = model.mechanism.bodies[static_cast<std::size_t>(body)].inertia;
      inertia = inertia + moved(placement, inertia_of(link));
    }
    for (auto joint = next_child(name, {}); !joint.empty();
         joint = next_child(name, joint.front().name)) {
      add_joint(joint.front(), body, placement);
    }
  }

  constexpr void add_joint(const Joint& joint, int parent, const Placement<double>& parent_link) {
    const Placement<double> frame =
        parent_link * Placement<double>{rotation_from_rpy(joint.orientation), joint.origin};
    if (joint.type == JointType::fixed) return add_link(joint.child, parent, frame, joint.name);

    const Matrix3<double> turn = rotation_of_z_onto(direction_of(joint.axis));
    const int body = body_count++;
    const auto index = static_cast<std::size_t>(body);
    model.mechanism.bodies[index] = {.parent = parent,
                                     .prismatic = joint.type == JointType::prismatic,
                                     .placement = frame * Placement<double>{turn, {}},
                                     .inertia = {},
                                     .reflected_inertia = joint.reflected_inertia};
    carriers[index] = &joint;
    model.moving_joints[index] = joint.name;
    if (joint.mimic.joint.empty()) {
      model.mechanism.couplings[index] = {joint_count, 1, 0};
      model.joints[static_cast<std::size_t>(joint_count++)] = properties_of(joints, joint);
    }
    add_link(joint.child, body, {turn.transposed(), {}}, joint.name);
  }

  /// Couples the bodies on mimic joints to the joints that they follow, and those that share
  /// rotors.
  constexpr void couple() {
    for (std::size_t body = 0; body < carriers.size(); ++body) {
      share_rotors(body);
      const auto [followed, multiplier, offset] = carriers[body]->mimic;
      if (followed.empty()) continue;
      for (std::size_t i = 0; i < model.joints.size(); ++i) {
        if (!(model.joints[i].name == followed)) continue;
        model.mechanism.couplings[body] = {static_cast<int>(i), multiplier, offset};
      }
    }
  }

  constexpr void share_rotors(std::size_t body) {
    const auto [other, inertia] = carriers[body]->shared_rotors;
    if (other.empty()) return;
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      if (!(carriers[i]->name == other)) continue;
      model.mechanism.bodies[body].shared_inertia = inertia;
      model.mechanism.bodies[body].sharing_body = static_cast<int>(i);
    }
  }

  /// The joint on this link whose name follows another's: a span of one, empty at the end.
  constexpr std::span<const Joint> next_child(const Name& link, const Name& previous) const {
    std::span<const Joint> next;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Joint& joint = joints[j];
      if (joint.parent == link && previous < joint.name &&
          (next.empty() || joint.name < next.front().name)) {
        next = joints.subspan(j, 1);
      }
    }
    return next;
  }
};

}  // namespace detail

/// The model of a description without fault.
/// @tparam N       number of joints, as model_size has it
/// @tparam Bodies  number of moving bodies, likewise
/// @tparam Kinematic  whether its masses are not known: then it is a KinematicModel
/// @param name     of the robot
/// @param gravity  acceleration of free fall in the root link's frame [m/s^2], 3 x 1
/// @param links    all links
/// @param joints   all joints
/// @param frames   where the link frames go: a container of as many elements as there are links
/// @param right_angle_tolerance  see canonical_form
/// @pre            find_fault finds none
/// Real-time: no (set-up or compile time).
template <int N, int Bodies = N, bool Kinematic = false, class LinkFrames>
[[nodiscard]] constexpr Model<N, Bodies, LinkFrames, Kinematic> build_model(
    const Name& name, const Vector3<double>& gravity, std::span<const Link> links,
    std::span<const Joint> joints, LinkFrames frames,
    double right_angle_tolerance = default_right_angle_tolerance) {
  Model<N, Bodies, LinkFrames, Kinematic> model{.name = name,
                                                .mechanism = {},
                                                .canonical = {},
                                                .joints = {},
                                                .moving_joints = {},
                                                .links = frames};
  model.mechanism.gravity = gravity;
  detail::ModelBuilder<Model<N, Bodies, LinkFrames, Kinematic>> builder{links, joints, model};
  for (const Link& link : links) {
    if (detail::carrier_of(joints, link.name).empty()) builder.add_link(link.name, -1, {}, {});
  }
  builder.couple();
  model.canonical = canonical_form(model.mechanism, right_angle_tolerance).mechanism;
  return model;
}

}  // namespace articula
