// SPDX-License-Identifier: Apache-2.0
// A view of a fake arm, for clients that are programs of their own. Prints its address, and ends
// with its standard input.
#include "fake_port.hpp"

#include "articula/view/view.hpp"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

int main(int count, char** arguments) {
  support::FakePort port;
  articula::ViewOptions options{.port = 0, .operates = true};
  if (count > 1) options.port = static_cast<std::uint16_t>(std::atoi(arguments[1]));
  const articula::View view(port, options);
  std::printf("%s\n", view.url().c_str());
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
}
