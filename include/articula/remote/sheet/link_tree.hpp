// SPDX-License-Identifier: Apache-2.0
/// @file The tree of links of a model, with the placements of their joints.
#pragma once

#include "articula/model/robot.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace articula::remote {

/// A link in the tree, and the joint that carries it.
struct TreeLink {
  std::string_view name{};
  int parent = -1;              ///< index of the parent link; -1 for the root
  std::string_view joint{};     ///< its carrier; empty for the root
  int moving_body = -1;         ///< the body that its carrier moves; -1 if the carrier is fixed
  Placement<double> origin{};   ///< its frame in the parent link's, with all joints at 0
  Placement<double> on_body{};  ///< its frame in the frame of its body, or of the base
  int body = -1;                ///< the body that it is a part of; -1 for the base
};

/// The inverse of a placement.
[[nodiscard]] inline Placement<double> inverse(const Placement<double>& placement) {
  const Matrix3<double> back = placement.rotation.transposed();
  return {back, back * -placement.translation};
}

/// The links of a robot as a tree, in the order of Model::links. A model does not tell to which of
/// several welded links a joint is attached; the motion is the same for each. The tree gives the
/// same order again when it is read: each link is attached as deep as the order of joint names
/// allows. Real-time: no (allocates).
template <Robot R>
[[nodiscard]] std::vector<TreeLink> link_tree(const R& robot) {
  const auto& model = model_of(robot);
  std::vector<TreeLink> tree;
  std::vector<std::string_view> last_child;  // by link, the joint attached to it last
  for (const LinkFrame& frame : model.links) {
    TreeLink link{.name = frame.name.view(),
                  .joint = frame.carrier.view(),
                  .on_body = frame.placement,
                  .body = frame.body};
    int parent_body = frame.body;
    for (std::size_t i = 0; i < model.moving_joints.size(); ++i) {
      if (model.moving_joints[i] == frame.carrier) {
        link.moving_body = static_cast<int>(i);
        parent_body = model.mechanism.bodies[i].parent;
      }
    }
    // From the last link to the root: those to which a link that comes now can be attached.
    int at = static_cast<int>(tree.size()) - 1;
    const auto fits = [&](int candidate) {
      const auto i = static_cast<std::size_t>(candidate);
      return tree[i].body == parent_body && last_child[i] < link.joint;
    };
    while (at >= 0 && !fits(at)) at = tree[static_cast<std::size_t>(at)].parent;
    link.parent = at;
    if (at >= 0) {
      const auto parent = static_cast<std::size_t>(at);
      last_child[parent] = link.joint;
      Placement<double> placement = frame.placement;
      if (link.moving_body >= 0) {
        const auto moved = static_cast<std::size_t>(link.moving_body);
        placement = model.mechanism.bodies[moved].placement * placement;
      }
      link.origin = inverse(tree[parent].on_body) * placement;
    }
    tree.push_back(link);
    last_child.emplace_back();
  }
  return tree;
}

}  // namespace articula::remote
