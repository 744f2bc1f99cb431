// SPDX-License-Identifier: Apache-2.0
/// @file Services without a meaning of their own.
#pragma once

#include "articula/ros2/fields.hpp"

namespace articula::ros2::std_srvs {

namespace srv {

/// A request without values.
template <class Layout>
struct Empty {
  static constexpr TypeName ros_type = "std_srvs/srv/Empty";

  struct Request {
    static constexpr TypeName ros_type = "std_srvs/srv/Empty_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    static constexpr TypeName ros_type = "std_srvs/srv/Empty_Response";
    static constexpr FieldNames<0> ros_fields{};
  };
};

/// Turns something on or off.
template <class Layout>
struct SetBool {
  static constexpr TypeName ros_type = "std_srvs/srv/SetBool";

  struct Request {
    bool data = false;

    static constexpr TypeName ros_type = "std_srvs/srv/SetBool_Request";
    static constexpr FieldNames<1> ros_fields{"data"};
  };
  struct Response {
    bool success = false;
    Text<Layout> message{};

    static constexpr TypeName ros_type = "std_srvs/srv/SetBool_Response";
    static constexpr FieldNames<2> ros_fields{"success", "message"};
  };
};

/// Starts something.
template <class Layout>
struct Trigger {
  static constexpr TypeName ros_type = "std_srvs/srv/Trigger";

  struct Request {
    static constexpr TypeName ros_type = "std_srvs/srv/Trigger_Request";
    static constexpr FieldNames<0> ros_fields{};
  };
  struct Response {
    bool success = false;
    Text<Layout> message{};

    static constexpr TypeName ros_type = "std_srvs/srv/Trigger_Response";
    static constexpr FieldNames<2> ros_fields{"success", "message"};
  };
};

}  // namespace srv

}  // namespace articula::ros2::std_srvs
