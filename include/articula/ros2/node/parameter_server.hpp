// SPDX-License-Identifier: Apache-2.0
/// @file The services by which the parameters of a node are listed, read and set.
#pragma once

#include "articula/ros2/messages/rcl_interfaces.hpp"
#include "articula/ros2/node/parameter_store.hpp"
#include "articula/ros2/node/periodic.hpp"
#include "articula/ros2/node/publisher.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace articula::ros2 {

/// The value of a parameter. Real-time: no (allocates); likewise the other ones.
[[nodiscard]] rcl_interfaces::msg::ParameterValue<Jazzy> to_value(bool value);
[[nodiscard]] rcl_interfaces::msg::ParameterValue<Jazzy> to_value(std::int64_t value);
[[nodiscard]] rcl_interfaces::msg::ParameterValue<Jazzy> to_value(double value);
[[nodiscard]] rcl_interfaces::msg::ParameterValue<Jazzy> to_value(std::string value);
[[nodiscard]] rcl_interfaces::msg::ParameterValue<Jazzy> to_value(std::vector<std::string> values);

/// A parameter that nobody can change.
[[nodiscard]] NodeParameter read_only(std::string name,
                                      rcl_interfaces::msg::ParameterValue<Jazzy> value,
                                      std::string description);

/// Serves the parameters of a node as `ros2 param` and rqt_reconfigure expect it: six services,
/// get_type_description, and changes on /parameter_events. Integers are taken for numbers. A
/// read-only parameter may be set to the value that it has, so a dumped file loads again. A request
/// of more than `most_names` is refused: its reply could take any memory. In the thread that polls
/// the transport. Real-time: no (allocates).
class ParameterServer {
 public:
  static constexpr std::size_t most_names = 1000;

  /// @param node   outlives this
  /// @param store  likewise
  ParameterServer(const Node& node, ParameterStore& store);
  ParameterServer(const ParameterServer&) = delete;
  ParameterServer& operator=(const ParameterServer&) = delete;

  /// Publishes what has changed, whoever did it.
  void update();

 private:
  using Value = rcl_interfaces::msg::ParameterValue<Jazzy>;
  using Results = std::vector<rcl_interfaces::msg::SetParametersResult<Jazzy>>;

  void serve_reading();
  void serve_setting();
  /// Whether a request is too large. It is counted then.
  [[nodiscard]] bool too_many(const auto& names);
  [[nodiscard]] std::vector<NodeParameter> named(const std::vector<std::string>& names);
  /// Whether a parameter has a value already, and no other that is on its way.
  [[nodiscard]] bool unchanged(const NodeParameter& present, const Value& wanted) const;
  /// Hands values to the store.
  void set(const NamedValues& values, const ParameterStore::OnSet& on_set);
  /// The reason why a value cannot be set, or empty. Integers become numbers.
  [[nodiscard]] std::string check(const std::vector<NodeParameter>& all,
                                  rcl_interfaces::msg::Parameter<Jazzy>& wanted) const;
  /// A request to set parameters, of which each one has a result.
  struct OpenSetting {
    Results results{};
    std::function<void(const Results&)> answer{};
    NamedValues wanted{};               ///< what is to change
    std::vector<std::size_t> places{};  ///< of it in the results
    std::size_t next = 0;
  };
  /// Sets what is left, one after the other.
  void set_next(const std::shared_ptr<OpenSetting>& open);
  void publish_changes();

  const Node& node_;
  ParameterStore& store_;
  Publisher<rcl_interfaces::msg::ParameterEvent<Jazzy>> events_;
  std::map<std::string, Value> known_{};
  std::size_t on_their_way_ = 0;  ///< changes that the store has not answered
  Periodic look_due_{4};
};

}  // namespace articula::ros2
