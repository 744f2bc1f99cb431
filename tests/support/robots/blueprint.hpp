// SPDX-License-Identifier: Apache-2.0
/// @file A robot's description whose size is not known at compile time.
#pragma once

#include <articula/model/build_model.hpp>

#include <vector>

namespace support {

/// A robot's description as a value that tests can put together piece by piece.
struct Blueprint {
  articula::Name name{"blueprint"};
  articula::Vector3<double> gravity{0, 0, -9.81};
  std::vector<articula::Link> links{};
  std::vector<articula::Joint> joints{};

  [[nodiscard]] articula::DescriptionFault fault() const {
    return articula::find_fault(name, gravity, links, joints);
  }
  /// @tparam N       number of joints that move and mimic no other
  /// @tparam Bodies  number of joints that move
  template <int N, int Bodies = N>
  [[nodiscard]] articula::Model<N, Bodies> model() const {
    return articula::build_model<N, Bodies>(name, gravity, links, joints,
                                            std::vector<articula::LinkFrame>(links.size()));
  }
};

/// The blueprint of a description.
template <class Description>
[[nodiscard]] Blueprint blueprint_of(const Description& d) {
  return {d.name, d.gravity, {d.links.begin(), d.links.end()}, {d.joints.begin(), d.joints.end()}};
}

}  // namespace support
