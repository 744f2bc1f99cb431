// SPDX-License-Identifier: Apache-2.0
/// @file A loop in a browser, with the options of a command line. POSIX; target articula::view.
#pragma once

#include "articula/core/refuse.hpp"
#include "articula/text/numbers.hpp"
#include "articula/view/show.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

namespace articula {

/// Options of `show` that a command line changes:
///
/// | option | meaning |
/// |---|---|
/// | --port 8765 | ViewOptions::port |
/// | --address 127.0.0.1 | ViewOptions::address |
/// | --token <text> | ViewOptions::token |
/// | --read-only | clients watch only |
/// | --view | opens the address on this machine |
/// | --seconds 10 | ShowOptions::seconds |
/// | --priority 80 | ShowOptions::thread: its priority, with the program's memory locked; 0: as any
/// other |
///
/// Without --token the variable ARTICULA_TOKEN is used, which other users cannot read.
/// @param options  what neither names
/// @param count    number of words, as that of `main`
/// @param words    the words, of which the first is the program
/// @throws std::invalid_argument naming the word and what was expected
/// Real-time: no (allocates, throws).
[[nodiscard]] inline ShowOptions with_arguments(ShowOptions options, int count,
                                                const char* const* words) {
  const char* const token = std::getenv("ARTICULA_TOKEN");
  if (token != nullptr && *token != 0) options.view.token = token;
  for (int i = 1; i < count; ++i) {
    const std::string_view option = words[i];
    const auto text = [&]() -> std::string_view {
      if (++i >= count) detail::refuse({"option ", option, ": its value is missing"});
      return words[i];
    };
    const auto number = [&](double most) {
      const std::string_view value = text();
      const auto x = detail::number_of(value);
      if (!x || !(*x >= 0 && *x <= most)) {
        detail::refuse({"option ", option, ": '", value, "' is not a number within 0 .. ", most});
      }
      return *x;
    };
    const auto whole = [&](double most) {
      const double x = number(most);
      if (x != std::floor(x)) {
        detail::refuse({"option ", option, ": ", x, " is not a whole number"});
      }
      return static_cast<int>(x);
    };
    if (option == "--port") {
      options.view.port = static_cast<std::uint16_t>(whole(65535));
    } else if (option == "--address") {
      options.view.address = text();
    } else if (option == "--token") {
      options.view.token = text();
    } else if (option == "--read-only") {
      options.view.operates = false;
    } else if (option == "--view") {
      options.opens_browser = true;
    } else if (option == "--seconds") {
      options.seconds = number(1e6);
    } else if (option == "--priority") {
      options.thread.priority = whole(99);
      options.thread.lock_memory = options.thread.priority > 0;
    } else {
      detail::refuse({"'", option, "' is no option; there are --port, --address, --token, ",
                      "--read-only, --view, --seconds and --priority"});
    }
  }
  return options;
}

/// `show` for a program whose user gives the options on its command line:
///
///     int main(int count, char** words) {
///       articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity> arm;
///       return articula::show_with_arguments(arm, count, words);
///     }
///
/// @return the exit status of the program: that of `show`, or 2 with a line on standard error if an
///         option is wrong
template <class LoopType>
int show_with_arguments(LoopType& loop, int count, const char* const* words,
                        const ShowOptions& options = {},
                        const typename Remote<LoopType>::Options& remote_options = {}) {
  try {
    return show(loop, with_arguments(options, count, words), remote_options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}

}  // namespace articula
