// SPDX-License-Identifier: Apache-2.0
/// @file From an expression graph to a straight-line program.
#pragma once

#include "articula/symbolic/graph.hpp"
#include "articula/symbolic/growing_array.hpp"
#include "articula/symbolic/program.hpp"

#include <cstddef>

namespace articula::symbolic {

/// Writes the part of a graph that its outputs need as a program, in three stages: what can be
/// computed before any sine or cosine, the sines and cosines of that, and the rest.
/// @tparam Room  for how long a program
template <ProgramSize Room>
class Assembler {
 public:
  /// @param graph    the expressions
  /// @param outputs  the results that are wanted
  [[nodiscard]] static constexpr Program<Room> assemble(const Graph& graph,
                                                        const GrowingArray<Term>& outputs) {
    Assembler assembler(graph);
    for (int i = 0; i < outputs.size(); ++i) assembler.mark(outputs[i]);
    assembler.mark_operands();
    assembler.append_stages();
    for (int i = 0; i < outputs.size(); ++i) assembler.append_output(outputs[i]);
    return assembler.program_;
  }

 private:
  enum Stage : unsigned char { unused, before_angles, angles, after_angles };

  /// What becomes of a node.
  struct Step {
    Stage stage;
    std::size_t value;  // that it computes
    std::size_t sine;   // the value of its sine, if it is an angle; 0 if it has none yet
  };

  constexpr explicit Assembler(const Graph& graph)
      : graph_(graph), steps_(static_cast<std::size_t>(graph.size())) {
    for (int i = 0; i < graph.size(); ++i) steps_.append({unused, 0, 0});
  }

  constexpr void mark(const Term& output) {
    if (!output.is_constant()) steps_[output.node].stage = before_angles;
  }

  /// Marks all nodes that marked ones need.
  constexpr void mark_operands() {
    for (int i = graph_.size(); i-- > 0;) {
      if (steps_[i].stage == unused) continue;
      const Node& node = graph_[i];
      if (!has_left(node.operation)) continue;
      steps_[node.left].stage = before_angles;
      if (has_right(node.operation)) steps_[node.right].stage = before_angles;
    }
  }

  constexpr void append_stages() {
    const auto nodes = static_cast<std::size_t>(graph_.size());
    GrowingArray<int> of_angles(nodes), afterwards(nodes);
    for (int i = 0; i < graph_.size(); ++i) {
      if (steps_[i].stage == unused) continue;
      const Stage stage = stage_of(graph_[i]);
      steps_[i].stage = stage;
      if (stage == before_angles) append(i);
      if (stage == angles) of_angles.append(i);
      if (stage == after_angles) afterwards.append(i);
    }
    program_.angles_begin = program_.size.instructions;
    for (int i = 0; i < of_angles.size(); ++i) append(of_angles[i]);
    program_.angles_end = program_.size.instructions;
    for (int i = 0; i < afterwards.size(); ++i) append(afterwards[i]);
  }

  /// The stage in which a node can be computed.
  [[nodiscard]] constexpr Stage stage_of(const Node& node) const {
    if (!has_left(node.operation)) return before_angles;
    if (steps_[node.left].stage != before_angles) return after_angles;
    if (is_angle_function(node.operation)) return angles;
    if (!has_right(node.operation)) return before_angles;
    return steps_[node.right].stage == before_angles ? before_angles : after_angles;
  }

  constexpr void append(int index) {
    const Node& node = graph_[index];
    std::size_t& value = steps_[index].value;
    switch (node.operation) {
      case Operation::input:
        value = append(node.operation, static_cast<std::size_t>(node.left));
        break;
      case Operation::constant:
        value = append_constant(node.value);
        break;
      case Operation::sine:
        value = append_angle(steps_[node.left]);
        break;
      case Operation::cosine:
        value = append_angle(steps_[node.left]) + 1;
        break;
      default:
        value = append(node.operation, steps_[node.left].value, steps_[node.right].value);
    }
  }

  /// The sine and cosine of an angle go side by side, even if only one of them is needed.
  /// @return the number of the sine, which is never 0: its angle comes before it
  constexpr std::size_t append_angle(Step& angle) {
    if (angle.sine == 0) {
      angle.sine = append(Operation::sine, angle.value);
      append(Operation::cosine, angle.value);
    }
    return angle.sine;
  }

  /// @return the number of the value that the instruction computes
  constexpr std::size_t append(Operation operation, std::size_t left, std::size_t right = 0) {
    const std::size_t number = program_.size.instructions++;
    if (number < Room.instructions) program_.instructions[number] = {operation, left, right};
    return number;
  }

  constexpr std::size_t append_constant(double constant) {
    const std::size_t number = program_.size.constants++;
    if (number < Room.constants) program_.constants[number] = constant;
    return append(Operation::constant, number);
  }

  constexpr void append_output(const Term& term) {
    const std::size_t value =
        term.is_constant() ? append_constant(term.constant) : steps_[term.node].value;
    const std::size_t number = program_.size.outputs++;
    if (number < Room.outputs) program_.outputs[number] = {value, term.negative};
  }

  const Graph& graph_;
  GrowingArray<Step> steps_;  // one for each node
  Program<Room> program_{};
};

}  // namespace articula::symbolic
