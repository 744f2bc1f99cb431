// SPDX-License-Identifier: Apache-2.0
/// @file A robot as a URDF document with shapes, for viewers.
#pragma once

#include "articula/model/joint_type_name.hpp"
#include "articula/remote/sheet/link_shapes.hpp"
#include "articula/remote/sheet/link_tree.hpp"
#include "articula/text/xml_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace articula::remote {

namespace detail {

using XmlText = articula::detail::XmlText;

/// Stands for a limit that a joint does not have, where URDF demands a number.
inline constexpr double no_limit = 1e9;

[[nodiscard]] inline double finite_limit(double limit) {
  return std::isfinite(limit) ? limit : std::copysign(no_limit, limit);
}

/// The roll, pitch, yaw of a rotation [rad].
[[nodiscard]] inline Vector3<double> roll_pitch_yaw(const Matrix3<double>& r) {
  // Roll follows from the rotation and yaw, so that the three agree even at a pitch of pi/2.
  const double yaw = std::atan2(r.rows[1].x, r.rows[0].x), s = std::sin(yaw), c = std::cos(yaw);
  return {std::atan2(s * r.rows[0].z - c * r.rows[1].z, c * r.rows[1].y - s * r.rows[0].y),
          std::atan2(-r.rows[2].x, std::hypot(r.rows[0].x, r.rows[1].x)), yaw};
}

inline void add_origin(XmlText& xml, const Placement<double>& placement) {
  const Vector3<double> rpy = roll_pitch_yaw(placement.rotation), xyz = placement.translation;
  xml.add("origin", {{"xyz", xyz.x, xyz.y, xyz.z}, {"rpy", rpy.x, rpy.y, rpy.z}});
}

/// A colour of the palette, by LinkShape::Part.
struct Colour {
  const char* name;
  const char* rgba;
};
inline constexpr std::array<Colour, 5> palette{{{"base", "0.27 0.30 0.34 1"},
                                                {"bone", "0.93 0.53 0.18 1"},
                                                {"other_bone", "0.82 0.84 0.87 1"},
                                                {"joint", "0.16 0.36 0.60 1"},
                                                {"tip", "0.75 0.22 0.17 1"}}};

inline void add_shape(XmlText& xml, const LinkShape& shape) {
  xml.open("visual");
  add_origin(xml, shape.placement);
  xml.open("geometry");
  switch (shape.kind) {
    case LinkShape::Kind::cylinder:
      xml.add("cylinder", {{"radius", shape.size.x}, {"length", shape.size.z}});
      break;
    case LinkShape::Kind::box:
      xml.add("box", {{"size", shape.size.x, shape.size.y, shape.size.z}});
      break;
    case LinkShape::Kind::sphere:
      xml.add("sphere", {{"radius", shape.size.x}});
      break;
  }
  xml.close();
  xml.add("material", {{"name", palette[static_cast<std::size_t>(shape.part)].name}});
  xml.close();
}

/// The inertia of a body at its own link, about the centre of mass and in the link's orientation.
inline void add_inertial(XmlText& xml, const TreeLink& link, const Body& body) {
  if (!(body.inertia.mass > 0)) return;
  const Inertia<double> own = moved(inverse(link.on_body), body.inertia);
  const Vector3<double> centre = (1 / own.mass) * own.first_moment;
  const Symmetric3<double> away = parallel_axis(0.5 * own.first_moment, centre), &i = own.moment;
  xml.open("inertial");
  add_origin(xml, {Matrix3<double>::identity(), centre});
  xml.add("mass", {{"value", own.mass}});
  xml.add("inertia", {{"ixx", i.xx - away.xx},
                      {"ixy", i.xy - away.xy},
                      {"ixz", i.xz - away.xz},
                      {"iyy", i.yy - away.yy},
                      {"iyz", i.yz - away.yz},
                      {"izz", i.zz - away.zz}});
  xml.close();
}

/// The limits of a mimic joint, from those of the joint that it mimics. They are wider by rounding,
/// so that a reader does not narrow the mimicked joint's.
[[nodiscard]] inline JointLimits limits_of_mimic(const JointLimits& mimicked,
                                                 const Coupling& coupling) {
  JointLimits limits;
  const double size = std::abs(coupling.multiplier);
  if (size == 0) {
    limits.lower = limits.upper = coupling.offset;
    return limits;
  }
  const double a = coupling.multiplier * finite_limit(mimicked.lower) + coupling.offset;
  const double b = coupling.multiplier * finite_limit(mimicked.upper) + coupling.offset;
  const auto rounding = [](double x) { return 1e-12 * (1 + std::abs(x)); };
  limits.lower = std::min(a, b) - rounding(std::min(a, b));
  limits.upper = std::max(a, b) + rounding(std::max(a, b));
  limits.velocity = finite_limit(mimicked.velocity) * size * (1 + 1e-12);
  return limits;
}

/// Type, limits, damping and mimic of the joint that moves a body.
struct JointText {
  JointType type = JointType::fixed;
  JointLimits limits{};
  double damping = 0, friction = 0;  ///< [N m s/rad, N m] or [N s/m, N]
  std::string mimicked{};
  Coupling coupling{};
};

template <Robot R>
[[nodiscard]] JointText joint_text(const R& robot, std::size_t body) {
  const auto& model = model_of(robot);
  JointText text;
  text.coupling = model.mechanism.couplings[body];
  const JointProperties& joint = model.joints[static_cast<std::size_t>(text.coupling.joint)];
  const bool is_bounded = std::isfinite(joint.limits.lower) || std::isfinite(joint.limits.upper) ||
                          text.coupling.multiplier == 0;
  if (joint.name == model.moving_joints[body]) {
    text.limits = joint.limits;
    text.damping = joint.damping;
    text.friction = joint.friction;
  } else {
    text.mimicked = std::string(joint.name.view());
    text.limits = limits_of_mimic(joint.limits, text.coupling);
  }
  text.type = model.mechanism.bodies[body].prismatic ? JointType::prismatic
              : is_bounded                           ? JointType::revolute
                                                     : JointType::continuous;
  return text;
}

inline void add_limits(XmlText& xml, JointType type, const JointLimits& limits) {
  if (type == JointType::continuous) {
    if (limits.velocity >= no_limit && limits.effort >= no_limit) return;
    xml.add("limit",
            {{"effort", finite_limit(limits.effort)}, {"velocity", finite_limit(limits.velocity)}});
    return;
  }
  xml.add("limit", {{"lower", finite_limit(limits.lower)},
                    {"upper", finite_limit(limits.upper)},
                    {"effort", finite_limit(limits.effort)},
                    {"velocity", finite_limit(limits.velocity)}});
}

/// The joint that carries a link.
template <Robot R>
void add_joint(XmlText& xml, const R& robot, const std::vector<TreeLink>& tree,
               const TreeLink& link) {
  const bool moves = link.moving_body >= 0;
  const auto body = static_cast<std::size_t>(std::max(link.moving_body, 0));
  const JointText text = moves ? joint_text(robot, body) : JointText{};
  xml.open("joint", {{"name", link.joint}, {"type", to_string(text.type)}});
  add_origin(xml, link.origin);
  xml.add("parent", {{"link", tree[static_cast<std::size_t>(link.parent)].name}});
  xml.add("child", {{"link", link.name}});
  if (moves) {
    const Vector3<double>& axis =
        link.on_body.rotation.rows[2];  // the body's z in the link's frame
    xml.add("axis", {{"xyz", axis.x, axis.y, axis.z}});
    add_limits(xml, text.type, text.limits);
    if (text.damping != 0 || text.friction != 0) {
      xml.add("dynamics", {{"damping", text.damping}, {"friction", text.friction}});
    }
    if (!text.mimicked.empty()) {
      xml.add("mimic", {{"joint", text.mimicked},
                        {"multiplier", text.coupling.multiplier},
                        {"offset", text.coupling.offset}});
    }
  }
  xml.close();
}

}  // namespace detail

/// A robot as a URDF document: links with inertias, joints with axes, limits, friction and mimics,
/// and the shapes of link_shapes. load_urdf makes the same robot from it, up to rounding. Joints
/// and links have the same order. What a URDF has no place for is missing: gravity, inertias of
/// rotors, limits of acceleration and jerk; and soft limits are. Links that are welded together
/// have their mass at one of them. A limit that a joint does not have is 1e9 where URDF demands
/// one.
/// @throws std::invalid_argument if a name has a control character, which XML cannot hold
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::string urdf_text(const R& robot) {
  const auto& model = model_of(robot);
  const std::vector<TreeLink> tree = link_tree(robot);
  const auto shapes = link_shapes(robot, tree);
  detail::XmlText xml;
  xml.open("robot", {{"name", model.name.view()}});
  for (const detail::Colour& colour : detail::palette) {
    xml.open("material", {{"name", colour.name}});
    xml.add("color", {{"rgba", colour.rgba}});
    xml.close();
  }
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const TreeLink& link = tree[i];
    xml.open("link", {{"name", link.name}});
    constexpr bool has_masses = !std::remove_cvref_t<decltype(model)>::kinematic;
    if (has_masses && link.moving_body >= 0) {
      detail::add_inertial(xml, link,
                           model.mechanism.bodies[static_cast<std::size_t>(link.moving_body)]);
    }
    for (const LinkShape& shape : shapes[i]) detail::add_shape(xml, shape);
    xml.close();
  }
  for (std::size_t i = 1; i < tree.size(); ++i) detail::add_joint(xml, robot, tree, tree[i]);
  xml.close();
  return xml.text();
}

}  // namespace articula::remote
