// SPDX-License-Identifier: Apache-2.0
/// @file A loop with a Remote that a test drives cycle by cycle, and a session that waits for
/// answers.
#pragma once

#include <articula/articula.hpp>
#include <articula/loop/supervision/supervised_loop.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace support {

using articula::remote::Answer;
using articula::remote::Request;
using articula::remote::Verdict;

/// A loop and its Remote in one thread. Nobody is lost here by silence, since no time passes.
template <class LoopType>
class RemoteArm {
 public:
  template <class... Arguments>
  explicit RemoteArm(articula::remote::RemoteOptions<LoopType::joint_count> options,
                     Arguments&&... loop_arguments)
      : loop(std::forward<Arguments>(loop_arguments)...),
        remote(loop, (options.operator_lifetime = 1e9, options)),
        session(remote.connect("test", true)) {}
  RemoteArm() : RemoteArm(articula::remote::RemoteOptions<LoopType::joint_count>{}) {}

  void cycles(int count) {
    for (int k = 0; k < count; ++k) static_cast<void>(remote.update());
  }

  /// The answer to a request, if it is there. Answers to other requests are kept.
  std::optional<Answer> answer_to(std::uint64_t number) {
    while (const auto answer = session->answer()) answers.push_back(*answer);
    for (const Answer& answer : answers) {
      if (answer.request == number) return answer;
    }
    return std::nullopt;
  }
  /// Asks and makes cycles until the answer is there.
  Answer ask(const Request& request, int most_cycles = 100) {
    const auto number = session->ask(request);
    for (int k = 0; k <= most_cycles; ++k) {
      if (const auto answer = answer_to(number)) return *answer;
      cycles(1);
    }
    return {number, Verdict::timed_out, "the test has waited long enough"};
  }

  LoopType loop;
  articula::remote::Remote<LoopType> remote;
  std::unique_ptr<articula::remote::Session> session;
  std::vector<Answer> answers{};
};

using SupervisedArm =
    RemoteArm<articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity>>;
using PlainArm = RemoteArm<articula::Loop<articula::Q2dSim, articula::PidPlusGravity>>;

// tests/remote/remote_arms.cpp has them compiled once for all tests.
extern template class RemoteArm<
    articula::SupervisedLoop<articula::Q2dSim, articula::PidPlusGravity>>;
extern template class RemoteArm<articula::Loop<articula::Q2dSim, articula::PidPlusGravity>>;

inline const std::string shoulder = "shoulder_active_joint", elbow = "elbow_active_joint";

}  // namespace support

namespace articula::remote {
extern template class Remote<SupervisedLoop<Q2dSim, PidPlusGravity>>;
extern template class Remote<Loop<Q2dSim, PidPlusGravity>>;
}  // namespace articula::remote
