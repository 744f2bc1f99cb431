// SPDX-License-Identifier: Apache-2.0
/// @file The gains of one part of a controller, as programs outside the loop read and change them.
#pragma once

#include "articula/control/laws/valid_gains.hpp"
#include "articula/remote/gains/gain_change.hpp"
#include "articula/remote/gains/gain_fields.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

namespace articula::remote {

/// A new value of one gain.
struct GainValue {
  int joint = 0;
  std::size_t field = 0;  ///< index in gain_fields
  double value = 0;
};

/// The gains of one part of a controller. For the outside.
class GainHolder {
 public:
  virtual ~GainHolder() = default;
  /// The value that the loop has.
  [[nodiscard]] virtual double value(int joint, std::size_t field) const = 0;
  /// The gains with some new values, checked as a whole.
  /// @throws std::invalid_argument naming joint, gain and value
  [[nodiscard]] virtual std::unique_ptr<GainChange> change(
      std::span<const GainValue> values) const = 0;
  /// A change was handed to the loop: further ones build on it.
  virtual void hand_over(GainChange& change) = 0;
  /// The loop has taken a change, or has not.
  virtual void settle(const GainChange& change, bool taken) = 0;
};

/// The gains of a law, or of a controller that has gains of its own.
/// @tparam Law  has gains() and set_gains(ValidGains<G, N>)
/// @tparam G    the gains of one joint
/// @tparam N    number of joints
template <class Law, class G, int N>
class LawGains final : public GainHolder {
 public:
  using Gains = ValidGains<G, N>;

  /// @param law    stays where it is
  /// @param names  of the joints, for messages; valid for as long as this is used
  LawGains(Law& law, const JointNames<N>& names) : law_(law), names_(names), held_(law.gains()) {
    latest_ = held_;
  }

  [[nodiscard]] double value(int joint, std::size_t field) const override {
    return held_[static_cast<std::size_t>(joint)].*gain_fields<G>[field].member;
  }
  [[nodiscard]] std::unique_ptr<GainChange> change(
      std::span<const GainValue> values) const override {
    typename Gains::Values gains = latest_;
    for (const GainValue& v : values) {
      gains[static_cast<std::size_t>(v.joint)].*gain_fields<G>[v.field].member = v.value;
    }
    return std::make_unique<Change>(law_, loops_number_, Gains(gains, names_));
  }
  void hand_over(GainChange& change) override {
    auto& own = static_cast<Change&>(change);
    own.base = latest_number_;
    own.number = latest_number_ = ++last_number_;
    latest_ = own.gains.values();
  }
  void settle(const GainChange& change, bool taken) override {
    const auto& own = static_cast<const Change&>(change);
    if (taken) {
      held_ = own.gains.values();
      held_number_ = own.number;
    } else if (own.number == latest_number_) {
      latest_ = held_;
      latest_number_ = held_number_;
    }
  }

 private:
  struct Change final : GainChange {
    Change(Law& own_law, std::uint64_t& own_loops_number, const Gains& own_gains)
        : law(own_law), loops_number(own_loops_number), gains(own_gains) {}
    [[nodiscard]] bool fits() const noexcept override { return base == loops_number; }
    void apply() noexcept override {
      law.set_gains(gains);
      loops_number = number;
    }
    Law& law;
    std::uint64_t& loops_number;
    Gains gains;
    std::uint64_t base = 0;  ///< number of the change on which it builds; 0: none
    std::uint64_t number = 0;
  };

  Law& law_;
  mutable std::uint64_t loops_number_ = 0;  ///< of the change that the law has; the loop's own
  JointNames<N> names_;
  typename Gains::Values held_;    ///< what the loop has
  typename Gains::Values latest_;  ///< what was handed over last
  std::uint64_t held_number_ = 0;
  std::uint64_t latest_number_ = 0;
  std::uint64_t last_number_ = 0;
};

}  // namespace articula::remote
