// SPDX-License-Identifier: Apache-2.0
/// @file The C++ header of a description.
#include "header_text.hpp"

#include <articula/urdf/read_urdf.hpp>

#include "catch.hpp"
#include "urdf_text.hpp"

#include <cmath>
#include <limits>

using namespace articula;
using Catch::Contains;

namespace {

UrdfContents pendulum() { return *read_urdf(support::pendulum()); }

std::string header_of(const UrdfContents& contents, const HeaderNames& names = {"R", ""}) {
  return header_text(UrdfDescription(contents), names);
}

}  // namespace

TEST_CASE("A header is C++ that people can read") {
  UrdfContents description = pendulum();
  description.file = "somewhere/pendulum.urdf";
  CHECK(header_of(description, {"Pendulum", "lab::robots"}) ==
        R"(// Made by articula_add_robot from pendulum.urdf. Edit that file instead.
#pragma once

#include <articula/model/description.hpp>

#include <array>

namespace lab::robots {

/// The robot 'r'.
struct Pendulum {
  static constexpr articula::RobotDescription description{
      .name = "r",
      .gravity = {0, 0, -9.81},
      .links = std::to_array<articula::Link>({
          {.name = "base"},
          {.name = "rod",
           .mass = 2,
           .inertia = {.xx = 1,
                       .yy = 1,
                       .zz = 1}},
      }),
      .joints = std::to_array<articula::Joint>({
          {.name = "pivot",
           .type = articula::JointType::continuous,
           .parent = "base",
           .child = "rod"},
      })};
};

}  // namespace lab::robots
)");
}

TEST_CASE("Numbers keep all their digits and their sign") {
  UrdfContents description = *read_urdf(
      support::robot("<link name=\"base\"/>" + support::solid("rod") + support::solid("bob") +
                     support::joint("pivot", "continuous", "base", "rod") +
                     support::joint("other", "continuous", "rod", "bob")));
  description.gravity = {0.1, -0.0, 1.0 / 3};
  description.links[1].mass = std::nextafter(2.0, 3.0);
  description.links[1].center_of_mass = {1e50, 5e-324, -1.7976931348623157e-48};
  description.joints[0].reflected_inertia = 0.125;
  description.joints[1].reflected_inertia = 2;
  description.joints[0].shared_rotors = {"other", -0.5};
  const std::string text = header_of(description);
  CHECK_THAT(text, Contains(".reflected_inertia = 0.125"));
  CHECK_THAT(text, Contains(".shared_rotors = {") && Contains(".inertia = -0.5"));
  CHECK_THAT(text, Contains("{0.1, -0.0, 0.3333333333333333}"));
  CHECK_THAT(text, Contains(".mass = 2.0000000000000004"));
  CHECK_THAT(text, Contains("{1e+50, 5e-324, -1.7976931348623157e-48}"));
}

TEST_CASE("Names cannot break out of their quotes") {
  UrdfContents description = pendulum();
  description.name = "a\"b\\c\nd\x7F";
  description.file = "dir/evil\\\n.urdf\\";
  const std::string text = header_of(description);
  CHECK_THAT(text, Contains(R"(.name = "a\"b\\c\012d\177")"));
  CHECK_THAT(text, Contains("from evil\\\\\\012.urdf\\\\. Edit"));
}

TEST_CASE("Notices become comments, unphysical robots say so") {
  const UrdfDescription robot =
      read_urdf(URDF_FILES "/unphysical.urdf", {.allow_unphysical = true});
  const std::string text = header_text(robot, {"R", ""});
  CHECK_THAT(text, Contains("/// - link 'flat': the inertia breaks the triangle inequality"));
  CHECK_THAT(text, Contains(",\n      .allow_unphysical = true};"));
}

TEST_CASE("What C++ does not accept as a name is refused") {
  for (const char* name : {"", "1st", "my-robot", "a b", "x;", "a::b"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(header_of(pendulum(), {name, ""}), std::invalid_argument);
  }
  for (const char* name : {"::", "a::", "1", "a-b", "a b"}) {
    CAPTURE(name);
    CHECK_THROWS_AS(header_of(pendulum(), {"R", name}), std::invalid_argument);
  }
}

TEST_CASE("A tolerance for right angles is written if it is not the usual one") {
  UrdfContents description = pendulum();
  CHECK_THAT(header_of(description), !Contains("right_angle_tolerance"));
  description.right_angle_tolerance = 0.5e-8;
  CHECK_THAT(header_of(description),
             Contains(".allow_unphysical = false,\n      .right_angle_tolerance = 5e-09};"));
}
