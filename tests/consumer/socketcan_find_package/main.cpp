// SPDX-License-Identifier: Apache-2.0
#include <articula/articula.hpp>
#include <articula/robots/q2d_can.hpp>

#include <cstdio>
#include <exception>
#include <string_view>

// The interface does not exist, so the arm must be refused, by name.
int main() try {
  articula::Loop<articula::Q2dCan, articula::PidPlusGravity> loop(articula::Q2dCan("none0"));
  return loop.update() == articula::Status::ok ? 1 : 2;
} catch (const std::exception& error) {
  std::printf("%s\n", error.what());
  return std::string_view(error.what()).find("none0") != std::string_view::npos ? 0 : 3;
}
