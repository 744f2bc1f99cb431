// SPDX-License-Identifier: Apache-2.0
/// @file Assembly of an expression graph into a straight-line program.
#pragma once

#include "articula/symbolic/graph.hpp"
#include "articula/symbolic/growing_array.hpp"
#include "articula/symbolic/program.hpp"

#include <cstddef>

namespace articula::symbolic {

/// Writes the nodes on which the outputs of a graph depend as a program. It has three stages: the
/// operands of the angles, the sines and cosines, and the rest. A node that no angle needs comes in
/// the last stage: no register is free to hold its value while sines are computed.
/// @tparam Capacity  the largest program
template <ProgramSize Capacity>
class Assembler {
 public:
  /// @param graph    the expressions
  /// @param outputs  the results
  [[nodiscard]] static constexpr Program<Capacity> assemble(const Graph& graph,
                                                            const GrowingArray<Term>& outputs) {
    Assembler assembler(graph);
    assembler.find_stages(outputs);
    assembler.append_nodes();
    for (int i = 0; i < outputs.size(); ++i) assembler.append_output(outputs[i]);
    assembler.program_.size.instructions = assembler.next_[after_angles];
    return assembler.program_;
  }

 private:
  /// The stage in which a node is computed, the earlier the greater. A node that two stages need
  /// belongs to the greater one.
  enum Stage : unsigned char { unused, after_angles, before_angles, angles };
  static constexpr std::size_t stages = 4;

  /// The properties of a node in the program.
  struct Step {
    bool of_sines;  // is a sine or cosine, or computed from some
    Stage stage;
    bool is_angle;             // the program has its sine and cosine
    std::size_t sine_number;   // of the instruction of its sine; 0 before there is one
    std::size_t value_number;  // of the instruction that computes the node
  };

  constexpr explicit Assembler(const Graph& graph)
      : graph_(graph), steps_(static_cast<std::size_t>(graph.size())) {
    const auto* const nodes = graph.nodes();
    const Step* const steps = steps_.data();
    for (int i = 0; i < graph.size(); ++i) {
      const Node& node = nodes[i];
      const bool of_sines = is_angle_function(node.operation) ||
                            (node.left != Node::none && steps[node.left].of_sines) ||
                            (node.right != Node::none && steps[node.right].of_sines);
      steps_.append({of_sines, unused, false, 0, 0});
    }
  }

  /// Determines the stage of each node and the number of instructions of each stage, from the
  /// outputs to the inputs. An operand's stage is that of the node or an earlier one. Sines of
  /// angles that depend on no other sine belong to the stage of the angles, and their operands to
  /// the stage before. Nodes of that stage depend on no sine.
  constexpr void find_stages(const GrowingArray<Term>& outputs) {
    const auto* const nodes = graph_.nodes();
    Step* const steps = steps_.data();
    for (int i = 0; i < outputs.size(); ++i) {
      if (!outputs[i].is_constant()) steps[outputs[i].node].stage = after_angles;
    }
    std::size_t length[stages] = {};
    for (int i = graph_.size(); i-- > 0;) {
      const Node& node = nodes[i];
      Step& step = steps[i];
      if (step.stage == unused) continue;
      Stage operands = step.stage;
      if (is_angle_function(node.operation)) {
        Step& angle = steps[node.left];
        if (!angle.of_sines) {
          step.stage = angles;
          operands = before_angles;
        }
        if (!angle.is_angle) length[step.stage] += 2;  // a pair, once for each angle
        angle.is_angle = true;
      } else {
        ++length[step.stage];
      }
      if (node.left != Node::none && steps[node.left].stage < operands) {
        steps[node.left].stage = operands;
      }
      if (node.right != Node::none && steps[node.right].stage < operands) {
        steps[node.right].stage = operands;
      }
    }
    next_[angles] = program_.angles_begin = length[before_angles];
    next_[after_angles] = program_.angles_end = program_.angles_begin + length[angles];
  }

  constexpr void append_nodes() {
    const auto* const nodes = graph_.nodes();
    Step* const steps = steps_.data();
    for (int i = 0; i < graph_.size(); ++i) {
      const Node& node = nodes[i];
      Step& step = steps[i];
      if (step.stage == unused) continue;
      switch (node.operation) {
        case Operation::input:
          step.value_number =
              append(step.stage, node.operation, static_cast<std::size_t>(node.value));
          break;
        case Operation::constant:
          step.value_number = append_constant(step.stage, node.value);
          break;
        case Operation::sine:
        case Operation::cosine:
          step.value_number = append_angle(step.stage, steps[node.left]);
          if (node.operation == Operation::cosine) ++step.value_number;
          break;
        case Operation::square_root:
          step.value_number = append(step.stage, node.operation, steps[node.left].value_number);
          break;
        default:
          step.value_number = append(step.stage, node.operation, steps[node.left].value_number,
                                     steps[node.right].value_number);
      }
    }
  }

  /// Appends the sine and cosine of an angle side by side, even if only one of them is needed.
  /// @return the number of the sine, which is never 0: its angle comes before it
  constexpr std::size_t append_angle(Stage stage, Step& angle) {
    if (angle.sine_number == 0) {
      angle.sine_number = append(stage, Operation::sine, angle.value_number);
      append(stage, Operation::cosine, angle.value_number);
    }
    return angle.sine_number;
  }

  constexpr std::size_t append_constant(Stage stage, double constant) {
    const std::size_t number = program_.size.constants++;
    if (number < Capacity.constants) program_.constants[number] = constant;
    return append(stage, Operation::constant, number);
  }

  /// @return the number of the value that the instruction computes
  constexpr std::size_t append(Stage stage, Operation operation, std::size_t left,
                               std::size_t right = 0) {
    const std::size_t number = next_[stage]++;
    if (number < Capacity.instructions) program_.instructions[number] = {operation, left, right};
    return number;
  }

  constexpr void append_output(const Term& term) {
    const std::size_t value = term.is_constant() ? append_constant(after_angles, term.constant)
                                                 : steps_[term.node].value_number;
    const std::size_t number = program_.size.outputs++;
    if (number < Capacity.outputs) program_.outputs[number] = {value, term.negative};
  }

  const Graph& graph_;
  GrowingArray<Step> steps_;       // one for each node
  std::size_t next_[stages] = {};  // the number of the next instruction
  Program<Capacity> program_{};
};

}  // namespace articula::symbolic
