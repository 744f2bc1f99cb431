// SPDX-License-Identifier: Apache-2.0
/// @file The recording of one run, as comma-separated values.
#pragma once

#include "articula/core/joint_command.hpp"
#include "articula/core/joint_reference.hpp"
#include "articula/core/joint_state.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace articula::examples {

/// Writes one line per cycle; the header names every column with its unit. The effort applied is
/// what the drives report: the command of the cycle before.
/// @tparam N  number of joints
template <int N>
class CsvFile {
 public:
  /// @throws std::runtime_error if the file cannot be written
  CsvFile(const std::filesystem::path& path,
          const std::array<std::string_view, std::size_t{N}>& joints)
      : path_(path.string()), file_(path) {
    file_.precision(9);
    file_ << "time [s]";
    for (const std::string_view joint : joints) {
      for (const std::string_view column :
           {"position reference [rad]", "position [rad]", "velocity [rad/s]",
            "effort reference [N m]", "effort command [N m]", "effort applied [N m]"}) {
        file_ << ',' << joint << ' ' << column;
      }
    }
    file_ << '\n';
    check();
  }

  /// One cycle at `time` [s].
  void add(double time, const JointReference<N>& reference, const JointState<N>& state,
           const EffortCommand<N>& command) {
    file_ << time;
    for (int j = 0; j < N; ++j) {
      file_ << ',' << reference.position[j] << ',' << state.position[j] << ',' << state.velocity[j]
            << ',' << reference.effort[j] << ',' << command.effort[j] << ',' << state.effort[j];
    }
    file_ << '\n';
  }

  /// Completes the file.
  /// @throws std::runtime_error if not all could be written
  void close() {
    file_.close();
    check();
  }

 private:
  void check() const {
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }

  std::string path_;
  std::ofstream file_;
};

}  // namespace articula::examples
