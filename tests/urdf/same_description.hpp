// SPDX-License-Identifier: Apache-2.0
/// @file Whether descriptions are the same, bit for bit.
#pragma once

#include <articula/urdf/read_urdf.hpp>

#include <bit>
#include <cstdint>
#include <vector>

namespace support {

/// All numbers of a link or joint, by their bits.
class Bits {
 public:
  Bits& operator<<(double x) {
    bits_.push_back(std::bit_cast<std::uint64_t>(x));
    return *this;
  }
  Bits& operator<<(const articula::Vector3<double>& a) { return *this << a.x << a.y << a.z; }
  Bits& operator<<(const articula::Symmetric3<double>& m) {
    return *this << m.xx << m.xy << m.xz << m.yy << m.yz << m.zz;
  }
  friend bool operator==(const Bits&, const Bits&) = default;

 private:
  std::vector<std::uint64_t> bits_{};
};

[[nodiscard]] inline bool same(const articula::Link& a, const articula::Link& b) {
  const auto bits = [](const articula::Link& l) {
    return Bits{} << l.mass << l.center_of_mass << l.inertia << l.inertia_orientation;
  };
  return a.name == b.name && bits(a) == bits(b);
}

[[nodiscard]] inline bool same(const articula::Joint& a, const articula::Joint& b) {
  const auto bits = [](const articula::Joint& j) {
    return Bits{} << j.origin << j.orientation << j.axis << j.limits.lower << j.limits.upper
                  << j.limits.velocity << j.limits.effort << j.limits.acceleration << j.limits.jerk
                  << j.limits.soft_lower << j.limits.soft_upper << j.limits.soft_rate << j.damping
                  << j.friction << j.reflected_inertia << j.mimic.multiplier << j.mimic.offset
                  << j.shared_rotors.inertia;
  };
  return a.name == b.name && a.type == b.type && a.parent == b.parent && a.child == b.child &&
         a.mimic.joint == b.mimic.joint && a.shared_rotors.joint == b.shared_rotors.joint &&
         bits(a) == bits(b);
}

/// True if a description known at compile time and one read at run time are the same.
template <class Description>
[[nodiscard]] bool same(const Description& a, const articula::UrdfDescription& description) {
  const articula::UrdfContents& b = *description;
  if (!(a.name == b.name) || !((Bits{} << a.gravity) == (Bits{} << b.gravity)) ||
      a.allow_unphysical != b.allow_unphysical || a.kinematic != b.kinematic ||
      a.right_angle_tolerance != b.right_angle_tolerance || a.links.size() != b.links.size() ||
      a.joints.size() != b.joints.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    if (!same(a.links[i], b.links[i])) return false;
  }
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    if (!same(a.joints[i], b.joints[i])) return false;
  }
  return true;
}

}  // namespace support
