// SPDX-License-Identifier: Apache-2.0
/// @file Conversion of a description to a model: ordered joints, welded links, axes along z.
#pragma once

#include "articula/model/canonical_mechanism.hpp"
#include "articula/model/model.hpp"
#include "articula/model/validation.hpp"

#include <algorithm>
#include <span>

namespace articula {

/// The numbers of joints and bodies of a model.
struct ModelSize {
  int joints = 0;  ///< joints that move and mimic no other
  int bodies = 0;  ///< moving bodies
};

/// The size of the model that build_model makes from these joints.
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

/// Fills a model depth first, siblings by joint name, as urdfdom and Pinocchio order joints.
template <class AnyModel>
struct ModelBuilder {
  std::span<const Link> links;
  std::span<const Joint> joints;
  AnyModel& model;
  JointArray<const Joint*, AnyModel::body_count> carriers{};  ///< joint by body
  int joint_count = 0;
  int body_count = 0;
  std::size_t link_count = 0;

  /// @param name       of the link
  /// @param body       index of its moving body, -1 for the base
  /// @param placement  the link's frame in the frame of that body
  /// @param carrier    the joint that carries it
  constexpr void add_link(const Name& name, int body, const Placement<double>& placement,
                          const Name& carrier) {
    const Link& link = links[index_of(links, name)];
    model.links[link_count++] = {name, body, placement, carrier};
    if (body >= 0) {
      Inertia<double>& inertia = model.mechanism.bodies[body].inertia;
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

    const Matrix3<double> rotation = rotation_of_z_onto(direction_of(joint.axis));
    const int body = body_count++;
    model.mechanism.bodies[body] = {.parent = parent,
                                    .prismatic = joint.type == JointType::prismatic,
                                    .placement = frame * Placement<double>{rotation, {}},
                                    .inertia = {},
                                    .reflected_inertia = joint.reflected_inertia};
    carriers[body] = &joint;
    model.moving_joints[body] = joint.name;
    if (joint.mimic.joint.empty()) {
      model.mechanism.couplings[body] = {joint_count, 1, 0};
      model.joints[joint_count++] = properties_of(joints, joint);
    }
    add_link(joint.child, body, {rotation.transposed(), {}}, joint.name);
  }

  /// Couples bodies on mimic joints to the mimicked joints, and bodies that share rotors.
  constexpr void couple() {
    for (int body = 0; body < AnyModel::body_count; ++body) {
      share_rotors(body);
      const auto [mimicked, multiplier, offset] = carriers[body]->mimic;
      for (int i = 0; i < AnyModel::joint_count; ++i) {
        if (!(model.joints[i].name == mimicked)) continue;
        model.mechanism.couplings[body] = {i, multiplier, offset};
      }
    }
  }

  constexpr void share_rotors(int body) {
    const auto [other, inertia] = carriers[body]->shared_rotors;
    if (other.empty()) return;
    for (int i = 0; i < AnyModel::body_count; ++i) {
      if (!(carriers[i]->name == other)) continue;
      model.mechanism.bodies[body].shared_inertia = inertia;
      model.mechanism.bodies[body].sharing_body = i;
    }
  }

  /// The child joint of a link whose name comes after another's: a span of one, empty at the end.
  /// (With -fsanitize=undefined, g++ 12 does not accept a pointer as a condition in a constant
  /// expression.)
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

/// Makes the model of a description without fault.
/// @tparam N       number of joints, from model_size
/// @tparam Bodies  number of moving bodies, from model_size
/// @tparam Kinematic  whether its masses are not known: then it is a KinematicModel
/// @param name     of the robot
/// @param gravity  acceleration of free fall in the root link's frame [m/s^2], 3 x 1
/// @param links    all links
/// @param joints   all joints
/// @param frames   storage of the link frames: a container with one element per link
/// @param right_angle_tolerance  see canonical_form
/// @pre            find_fault finds none
/// Real-time: no (set-up or compile time).
template <int N, int Bodies = N, bool Kinematic = false, class LinkFrames>
[[nodiscard]] constexpr Model<N, Bodies, LinkFrames, Kinematic> build_model(
    const Name& name, const Vector3<double>& gravity, std::span<const Link> links,
    std::span<const Joint> joints, LinkFrames frames,
    double right_angle_tolerance = default_right_angle_tolerance) {
  Model<N, Bodies, LinkFrames, Kinematic> model{.name = name, .links = frames};
  model.mechanism.gravity = gravity;
  detail::ModelBuilder<Model<N, Bodies, LinkFrames, Kinematic>> builder{links, joints, model};
  for (const Link& link : links) {
    const bool is_root = std::none_of(joints.begin(), joints.end(),
                                      [&](const Joint& joint) { return joint.child == link.name; });
    if (is_root) builder.add_link(link.name, -1, {}, {});
  }
  builder.couple();
  model.canonical = canonical_form(model.mechanism, right_angle_tolerance).mechanism;
  return model;
}

}  // namespace articula
