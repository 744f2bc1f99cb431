// SPDX-License-Identifier: Apache-2.0
/// @file Shapes to draw a robot of which only the motion is known: bones and joints.
#pragma once

#include "articula/remote/sheet/link_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace articula::remote {

/// A shape to draw at a link.
struct LinkShape {
  enum class Kind : unsigned char { cylinder, box, sphere };
  enum class Part : unsigned char { base, bone, other_bone, joint, tip };
  Kind kind = Kind::sphere;
  Part part = Part::bone;
  Placement<double> placement{};  ///< in the link's frame; cylinders are along z
  Vector3<double> size{};  ///< box: edges; cylinder: radius, radius, length; sphere: radius [m]
};

namespace detail {

[[nodiscard]] inline double length_of(const Vector3<double>& a) { return std::sqrt(dot(a, a)); }

/// The furthest distance along links from the root to any link [m]. A prismatic joint adds its
/// range, if it has one.
template <Robot R>
[[nodiscard]] double reach_of(const R& robot, const std::vector<TreeLink>& tree) {
  const auto& model = model_of(robot);
  std::vector<double> distance(tree.size(), 0);
  double reach = 0;
  for (std::size_t i = 1; i < tree.size(); ++i) {
    distance[i] =
        distance[static_cast<std::size_t>(tree[i].parent)] + length_of(tree[i].origin.translation);
    if (tree[i].moving_body >= 0) {
      const auto body = static_cast<std::size_t>(tree[i].moving_body);
      if (!model.mechanism.bodies[body].prismatic) {
        const Inertia<double>& inertia = model.mechanism.bodies[body].inertia;
        const double tip = inertia.mass > 0 ? length_of(inertia.first_moment) / inertia.mass : 0;
        reach = std::max(reach, distance[i] + tip);
      }
    }
    reach = std::max(reach, distance[i]);
  }
  return reach > 0 ? reach : 1;
}

/// The shapes of a robot, collected by body.
template <Robot R>
class ShapeMaker {
 public:
  ShapeMaker(const R& robot, const std::vector<TreeLink>& tree)
      : robot_(robot), tree_(tree), reach_(reach_of(robot, tree)) {}

  [[nodiscard]] std::vector<std::vector<LinkShape>> shapes() const {
    std::vector<std::vector<LinkShape>> result(tree_.size());
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      if (i > 0 && tree_[i].moving_body < 0) continue;  // the shapes of a body are at its own link
      result[i] = shapes_of(i);
    }
    return result;
  }

 private:
  /// Points to which a body reaches, in the frame of its own link. They are the joints that it
  /// carries; if there is none, the links that are welded to it. If there is none of these, the
  /// point is beyond its centre of mass.
  [[nodiscard]] std::vector<Vector3<double>> ends_of(std::size_t own, bool& is_tip) const {
    const Placement<double> back = inverse(tree_[own].on_body);
    std::vector<Vector3<double>> joints, welded;
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      if (i == own) continue;
      if (tree_[i].moving_body < 0 && tree_[i].body == tree_[own].body) {
        welded.push_back((back * tree_[i].on_body).translation);
      }
      if (tree_[i].moving_body < 0) continue;
      const auto& body =
          model_of(robot_).mechanism.bodies[static_cast<std::size_t>(tree_[i].moving_body)];
      if (body.parent == tree_[own].body) {
        joints.push_back((back * body.placement * tree_[i].on_body).translation);
      }
    }
    is_tip = joints.empty();
    if (!joints.empty()) return joints;
    if (!welded.empty() || tree_[own].body < 0) return welded;
    const auto& inertia =
        model_of(robot_).mechanism.bodies[static_cast<std::size_t>(tree_[own].body)].inertia;
    if (!(inertia.mass > 0)) return {};
    return {back.rotation * ((2 / inertia.mass) * inertia.first_moment)};
  }

  [[nodiscard]] double thickness(double length) const {
    return std::clamp(0.1 * length, 0.006 * reach_, 0.028 * reach_);
  }

  void add_joint(std::size_t own, double radius, std::vector<LinkShape>& shapes) const {
    const bool slides = model_of(robot_)
                            .mechanism.bodies[static_cast<std::size_t>(tree_[own].moving_body)]
                            .prismatic;
    // The axis is the body's z; the link's frame has the body's origin.
    const Placement<double> along{tree_[own].on_body.rotation.transposed(), {}};
    const double width = 1.5 * radius, length = 4 * radius;
    if (slides) {
      shapes.push_back(
          {LinkShape::Kind::box, LinkShape::Part::joint, along, {2 * width, 2 * width, length}});
    } else {
      shapes.push_back(
          {LinkShape::Kind::cylinder, LinkShape::Part::joint, along, {width, width, length}});
    }
  }

  [[nodiscard]] std::vector<LinkShape> shapes_of(std::size_t own) const {
    std::vector<LinkShape> shapes;
    bool is_tip = false;
    const std::vector<Vector3<double>> ends = ends_of(own, is_tip);
    double longest = 0;
    for (const Vector3<double>& end : ends) longest = std::max(longest, length_of(end));
    const bool is_base = tree_[own].body < 0;
    const double radius = is_base ? 0.028 * reach_ : thickness(longest);
    if (is_base) {
      shapes.push_back(
          {LinkShape::Kind::cylinder, LinkShape::Part::base, {}, {3 * radius, 3 * radius, radius}});
    } else {
      add_joint(own, radius, shapes);
    }
    int moving_depth = 0;
    for (int at = static_cast<int>(own); at > 0; at = tree_[static_cast<std::size_t>(at)].parent) {
      if (tree_[static_cast<std::size_t>(at)].moving_body >= 0) ++moving_depth;
    }
    const auto part = is_base                 ? LinkShape::Part::base
                      : moving_depth % 2 == 0 ? LinkShape::Part::other_bone
                                              : LinkShape::Part::bone;
    for (const Vector3<double>& end : ends) {
      const double length = length_of(end);
      if (length < radius) continue;
      const Placement<double> middle{rotation_of_z_onto(direction_of(end)), 0.5 * end};
      shapes.push_back({LinkShape::Kind::cylinder, part, middle, {radius, radius, length}});
      if (is_tip && !is_base) {
        const double size = 1.3 * radius;
        shapes.push_back({LinkShape::Kind::sphere,
                          LinkShape::Part::tip,
                          {Matrix3<double>::identity(), end},
                          {size, size, size}});
      }
    }
    return shapes;
  }

  const R& robot_;
  const std::vector<TreeLink>& tree_;
  double reach_;
};

}  // namespace detail

/// Shapes of a robot of which only the motion is known. A bone leads from the frame of each body's
/// own link to each joint that the body carries, or to its tool. Cylinders lie along the axes of
/// revolute joints and boxes along those of prismatic ones. Their sizes follow from the robot's
/// reach.
/// @param tree  link_tree(robot)
/// @return      shapes by link, in the order of the tree
/// Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::vector<std::vector<LinkShape>> link_shapes(const R& robot,
                                                              const std::vector<TreeLink>& tree) {
  return detail::ShapeMaker<R>(robot, tree).shapes();
}

}  // namespace articula::remote
