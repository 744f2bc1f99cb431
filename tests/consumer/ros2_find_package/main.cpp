// SPDX-License-Identifier: Apache-2.0
#include <articula/ros2/dds/fast_dds_transport.hpp>

int main() {
  articula::ros2::FastDdsTransport transport({.domain = 101});
  const auto writer =
      transport.advertise({.node = "/consumer", .topic = "/text", .type = "std_msgs/msg/String"});
  transport.poll(std::chrono::milliseconds(1));
  return writer->readers() == 0 ? 0 : 1;
}
