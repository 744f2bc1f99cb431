// SPDX-License-Identifier: Apache-2.0
/// @file A robot of the kind of a described one, with other masses, inertias, lengths and friction.
#pragma once

#include "articula/core/finite.hpp"
#include "articula/core/refuse.hpp"
#include "articula/dynamics/engine/input_numbers.hpp"
#include "articula/model/build_model.hpp"
#include "articula/model/robot.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace articula {

namespace detail {

template <DescribedRobot R>
using ModelOf = std::remove_cvref_t<decltype(model_of(R{}))>;

/// The model of a changed description, as `compile_model` makes it of the robot's own.
template <DescribedRobot R>
[[nodiscard]] ModelOf<R> changed_model(
    const std::remove_cvref_t<decltype(R::description)>& changed) {
  const DescriptionFault fault = find_fault(changed.name, changed.gravity, changed.links,
                                            changed.joints, changed.allow_unphysical);
  if (fault.rule != Rule::none) {
    refuse({"varied robot '", changed.name.view(), "': '", fault.element.view(),
            "': ", to_string(fault.rule)});
  }
  const ModelSize size = model_size(changed.joints);
  if (size.joints != ModelOf<R>::joint_count || size.bodies != ModelOf<R>::body_count) {
    refuse({"varied robot '", changed.name.view(), "' has ", size.joints, " joints and ",
            size.bodies, " moving bodies; '", R::description.name.view(), "' has ",
            ModelOf<R>::joint_count, " and ", ModelOf<R>::body_count});
  }
  constexpr std::size_t links = std::remove_cvref_t<decltype(R::description)>{}.links.size();
  return build_model<ModelOf<R>::joint_count, ModelOf<R>::body_count>(
      changed.name, changed.gravity, changed.links, changed.joints, std::array<LinkFrame, links>{},
      changed.right_angle_tolerance);
}

}  // namespace detail

/// A robot that differs from a described one in numbers: masses, inertias, lengths, inertias of
/// drives, damping, friction, limits. All functions take it in place of R. The equations of motion
/// run as programs of the compiler, with these numbers as inputs, at almost the speed of R:
///
///     auto heavier = Q2d::description;
///     heavier.links[5].mass *= 1.2;
///     Simulator<VariedRobot<Q2d>> simulator{VariedRobot<Q2d>(heavier)};
///
/// The type knows which numbers can differ. The tree, the kinds and order of the joints, the
/// directions of their axes, gravity, mimic joints and shared rotors are those of R. A number of
/// the canonical mechanism (see canonical_form) that is 0 for R stays 0; damping, friction and
/// limits may differ even then.
template <DescribedRobot R>
class VariedRobot : public detail::ModelOf<R> {
 public:
  using Nominal = R;
  using ModelType = detail::ModelOf<R>;
  using Description = std::remove_cvref_t<decltype(R::description)>;
  static constexpr int joint_count = ModelType::joint_count;
  static constexpr int body_count = ModelType::body_count;
  static constexpr int number_count = detail::input_count<R>();

  /// The robot as described.
  VariedRobot() : VariedRobot(model_of(R{})) {}

  /// A changed copy of R::description.
  /// @throws std::invalid_argument if the description has a fault, naming element and rule, or
  ///         differs in what is not a number of this type, naming what
  explicit VariedRobot(const Description& changed)
      : VariedRobot(detail::changed_model<R>(changed), changed.right_angle_tolerance) {}

  /// A changed copy of model_of(R()): numbers of its `mechanism` and its `joints` may differ. The
  /// canonical mechanism is recomputed.
  /// @throws std::invalid_argument as above, and if a mass is negative or a number is not finite
  explicit VariedRobot(const ModelType& changed)
      : VariedRobot(changed, R::description.right_angle_tolerance) {}

  /// The numbers that are inputs of the programs, body by body, see for_each_number.
  [[nodiscard]] const std::array<double, std::size_t{number_count}>& numbers() const noexcept {
    return numbers_;
  }

 private:
  using Message = detail::MessageParts;

  VariedRobot(ModelType changed, double right_angle_tolerance) : ModelType(std::move(changed)) {
    check_kind();
    this->canonical = canonical_form(this->mechanism, right_angle_tolerance).mechanism;
    take_numbers();
  }

  [[noreturn]] void refuse(Message parts) const {
    detail::refuse({"varied robot '", this->name.view(), "': ", detail::message_of(parts)});
  }
  [[nodiscard]] std::string_view joint_name(int body) const {
    return this->moving_joints[body].view();
  }

  /// Refuses what is not a number of this type, and numbers that no robot has.
  void check_kind() const {
    const ModelType& nominal = model_of(R{});
    if (!(this->mechanism.gravity == nominal.mechanism.gravity)) {
      refuse({"gravity differs from that of '", nominal.name.view(), "'"});
    }
    for (int i = 0; i < body_count; ++i) {
      const Body &own = this->mechanism.bodies[i], &other = nominal.mechanism.bodies[i];
      const Coupling &coupling = this->mechanism.couplings[i],
                     &same = nominal.mechanism.couplings[i];
      if (!(this->moving_joints[i] == nominal.moving_joints[i]) || own.parent != other.parent ||
          own.prismatic != other.prismatic) {
        refuse({"joint ", i, " is '", joint_name(i), "', not '", nominal.moving_joints[i].view(),
                "' at the same place of the tree"});
      }
      if (coupling.joint != same.joint || coupling.multiplier != same.multiplier ||
          coupling.offset != same.offset) {
        refuse({"joint '", joint_name(i), "' mimics in another way"});
      }
      if (own.sharing_body != other.sharing_body || own.shared_inertia != other.shared_inertia) {
        refuse({"joint '", joint_name(i), "' has other shared rotors"});
      }
      if (!(own.inertia.mass >= 0) || !(own.reflected_inertia >= 0)) {
        refuse({"the body of joint '", joint_name(i), "' has the mass ", own.inertia.mass,
                " kg and the reflected inertia ", own.reflected_inertia,
                "; both must be numbers >= 0"});
      }
    }
    for (const JointProperties& joint : this->joints) {
      const auto is_possible = [](double x) { return is_finite(x) && x >= 0; };
      if (!is_possible(joint.damping) || !is_possible(joint.friction)) {
        refuse({"joint '", joint.name.view(), "' has the damping ", joint.damping,
                " and the friction ", joint.friction, "; both must be numbers >= 0"});
      }
      const JointLimits& limits = joint.limits;
      if (!(limits.lower <= limits.upper) || !(limits.effort >= 0) || !(limits.velocity >= 0)) {
        refuse({"joint '", joint.name.view(), "' has the limits ", limits.lower, " .. ",
                limits.upper, ", velocity ", limits.velocity, ", effort ", limits.effort,
                "; the lower must not exceed the upper, the others must be >= 0"});
      }
    }
  }

  /// Takes the numbers that are inputs. What rounding leaves of a zero is 0.
  void take_numbers() {
    static constexpr std::array<std::string_view, BodyNumbers<double>::count> names{
        "x of the joint's origin", "y of the joint's origin",
        "z of the joint's origin", "mass",
        "first moment x",          "first moment y",
        "first moment z",          "second moment xx",
        "second moment xy",        "second moment xz",
        "second moment yy",        "second moment yz",
        "second moment zz",        "reflected inertia"};
    constexpr auto is_input = detail::input_mask<R>();
    // A number that must be 0 is a difference of others, as large as mass, length and their
    // product.
    double length = 1, mass = 0;
    for (const Body& body : this->mechanism.bodies) {
      const Vector3<double>& t = body.placement.translation;
      length += std::max({detail::magnitude(t.x), detail::magnitude(t.y), detail::magnitude(t.z)});
      mass += body.inertia.mass;
    }
    const double rounding = 1e-12 * length * length * std::max(mass, 1.0);
    std::size_t place = 0, next = 0;
    for (int i = 0; i < body_count; ++i) {
      check_axis(i);
      const auto numbers = numbers_of<double>(this->canonical.bodies[i]);
      std::size_t kind = 0;
      for_each_number(numbers, [&](double number) {
        const std::string_view what = names[kind++];
        if (!is_finite(number)) {
          refuse({what, " of the body of joint '", joint_name(i), "' is not finite"});
        }
        if (is_input[place++]) {
          numbers_[next++] = number;
        } else if (detail::magnitude(number) > rounding) {
          refuse({what, " of the body of joint '", joint_name(i), "' is ", number,
                  " in the canonical mechanism; it is 0 for '", R::description.name.view(),
                  "' and must stay 0"});
        }
      });
    }
  }

  void check_axis(int body) const {
    const auto& own = this->canonical.bodies[body].placement.rotation.rows;
    const auto& nominal = model_of(R{}).canonical.bodies[body].placement.rotation.rows;
    for (std::size_t row = 0; row < 3; ++row) {
      const Vector3<double> difference = own[row] - nominal[row];
      if (!(dot(difference, difference) <= 1e-24)) {
        refuse({"the axis of joint '", joint_name(body), "' has another direction"});
      }
    }
  }

  std::array<double, std::size_t{number_count}> numbers_{};
};

namespace detail {

template <DescribedRobot R>
inline constexpr bool is_model<VariedRobot<R>> = true;

/// The robot of R's kind with the numbers of a model; none if VariedRobot<R> does not take them.
/// Real-time: no (set-up).
template <DescribedRobot R>
[[nodiscard]] std::optional<VariedRobot<R>> robot_of_kind(const ModelOf<R>& model) {
  try {
    return VariedRobot<R>(model);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // a number of another kind: a model has no such bounds
  }
}

}  // namespace detail

}  // namespace articula
