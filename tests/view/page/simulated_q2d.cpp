// SPDX-License-Identifier: Apache-2.0
// The simulated Q2D under two controllers with the view on any free port, for the tests of the page.
// It prints the address and runs until SIGTERM. SIGUSR1 breaks the sensors until SIGUSR2 mends them.
//
//   simulated_q2d [port [folder]]   a folder has robot.urdf, which looks in package q2d for its meshes
#include <articula/articula.hpp>
#include <articula/loop/realtime/monotonic_clock.hpp>
#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/remote/remote.hpp>
#include <articula/robots/q2d.hpp>
#include <articula/view/view.hpp>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

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

}  // namespace

int main(int count, char** arguments) {
  std::signal(SIGUSR1, [](int) { broken = 1; });
  std::signal(SIGUSR2, [](int) { broken = 0; });
  SupervisedLoop<FragileQ2d, Controllers> arm(SupervisionOptions{.overruns = 1000000});
  // A browser that draws without a graphics processor may be silent for a while.
  const std::string folder = count > 2 ? arguments[2] : "";
  std::ifstream urdf(folder + "/robot.urdf");
  const std::string text{std::istreambuf_iterator<char>(urdf), {}};
  Remote remote(arm, {.operator_lifetime = 20, .urdf = text});
  const auto port = static_cast<std::uint16_t>(count > 1 ? std::atoi(arguments[1]) : 0);
  ViewOptions options{.port = port, .operates = true};
  if (!folder.empty()) options.mesh_folders = {{"q2d", folder}};
  View view(remote, options);
  std::printf("%s\n", view.url().c_str());
  std::fflush(stdout);
  StopFlag stop;
  const StopOnSignal ctrl_c(stop);
  MonotonicClock clock;
  arm.request_activation();
  (void)remote.run(clock, {.stop = &stop});
}
