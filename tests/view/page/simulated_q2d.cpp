// SPDX-License-Identifier: Apache-2.0
// The simulated Q2D under two controllers with the view on any free port, for the tests of the
// page. It prints the address and runs until SIGTERM. SIGUSR1 breaks the sensors until SIGUSR2
// mends them.
//
//   simulated_q2d [port [folder]]   a folder has robot.urdf, which looks in package q2d for its
//   meshes;
//                                   the view has a token then
//   simulated_q2d --replay <file>   computes the commands of an MCAP file once more and compares
//   them
#include <articula/articula.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/recording/mcap_record_reader.hpp>
#include <articula/remote/remote.hpp>
#include <articula/replay/replay.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/view.hpp>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

using namespace articula;

namespace {

volatile std::sig_atomic_t broken = 0;

/// The simulator, and a way to fail.
class FragileQ2d : public Q2dSim {
 public:
  using Q2dSim::Q2dSim;
  [[nodiscard]] Status read(JointState<2>& state) noexcept {
    const Status status = Q2dSim::read(state);
    return broken != 0 ? Status::hardware_fault : status;
  }
};

template <class R>
using Controllers = Switch<R, PidPlusGravity<R>, ComputedTorque<R>>;
using ArmLoop = SupervisedLoop<FragileQ2d, Controllers>;

// A browser that draws without a graphics processor may make the loop late.
constexpr SupervisionOptions supervision{.overruns = 1000000};

/// Whether the program commands the same as in a file, to the last bit.
int replay(const char* file) try {
  const auto recording = read_mcap_recording<ArmLoop::Command>(Q2d(), file);
  Replay<ArmLoop> replay(recording, {.supervision = supervision});
  const auto difference = replay.run();
  std::printf("%zu cycles, %zu changes: %s\n", recording.cycles.size(), recording.changes.size(),
              difference ? to_string(*difference).c_str() : "the same bits");
  return difference ? 1 : 0;
} catch (const std::exception& error) {
  std::printf("%s\n", error.what());
  return 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count > 2 && std::string_view(arguments[1]) == "--replay") return replay(arguments[2]);
  std::signal(SIGUSR1, [](int) { broken = 1; });
  std::signal(SIGUSR2, [](int) { broken = 0; });
  ArmLoop arm(supervision);
  // A browser that draws without a graphics processor may be silent for a while.
  const std::string folder = count > 2 ? arguments[2] : "";
  std::ifstream urdf(folder + "/robot.urdf");
  const std::string text{std::istreambuf_iterator<char>(urdf), {}};
  Remote remote(arm, {.operator_lifetime = 20, .urdf = text});
  const auto port = static_cast<std::uint16_t>(count > 1 ? std::atoi(arguments[1]) : 0);
  ViewOptions options{.port = port, .operates = true};
  if (!folder.empty()) {
    options.mesh_folders = {{"q2d", folder}};
    options.token = "3b1c4f9a5e6d7788";
  }
  View view(remote, options);
  std::printf("%s\n", view.url().c_str());
  std::fflush(stdout);
  StopFlag stop;
  const StopOnSignal ctrl_c(stop);
  MonotonicClock clock;
  arm.request_activation();
  (void)remote.run(clock, {.stop = &stop});
}
