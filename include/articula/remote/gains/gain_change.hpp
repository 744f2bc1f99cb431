// SPDX-License-Identifier: Apache-2.0
/// @file Gains on their way to a part of a controller.
#pragma once

namespace articula::remote {

/// New gains for one part of a controller, checked.
class GainChange {
 public:
  virtual ~GainChange() = default;
  /// Whether the loop has the gains on which these build. In the loop's thread. Real-time: yes.
  [[nodiscard]] virtual bool fits() const noexcept = 0;
  /// Hands the gains over. In the loop's thread, between two cycles. Real-time: yes.
  virtual void apply() noexcept = 0;
};

}  // namespace articula::remote
