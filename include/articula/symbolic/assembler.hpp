// SPDX-License-Identifier: Apache-2.0
/// @file From an expression graph to a straight-line program.
#pragma once

#include "articula/symbolic/graph.hpp"
#include "articula/symbolic/growing_array.hpp"
#include "articula/symbolic/program.hpp"

#include <cstddef>

namespace articula::symbolic {

/// Writes the part of a graph that its outputs need as a program, in three stages: what the angles
/// need, their sines and cosines, and the rest. What the angles do not need comes after them even
/// if it could be computed before: there is no register in which it could wait while sines are
/// taken.
/// @tparam Room  for how long a program
template <ProgramSize Room>
class Assembler {
 public:
  /// @param graph    the expressions
  /// @param outputs  the results that are wanted
  [[nodiscard]] static constexpr Program<Room> assemble(const Graph& graph,
                                                        const GrowingArray<Term>& outputs) {
    Assembler assembler(graph);
    assembler.find_stages(outputs);
    assembler.append_nodes();
    for (int i = 0; i < outputs.size(); ++i) assembler.append_output(outputs[i]);
    assembler.program_.size.instructions = assembler.next_[after_angles];
    return assembler.program_;
  }

 private:
  /// When a node is computed, in the order of urgency: of two stages that need it the greater one
  /// says when.
  enum Stage : unsigned char { unused, after_angles, before_angles, angles };
  static constexpr std::size_t stages = 4;

  /// What becomes of a node.
  struct Step {
    bool of_sines;  // is a sine or cosine, or computed from some
    Stage stage;
    bool is_angle;             // its sine or cosine is taken
    std::size_t sine_number;   // of the instruction that does so; 0 before there is one
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

  /// Finds out when each node is computed, and how many instructions each stage has. It goes from
  /// the outputs to the inputs: what a node needs is needed when the node is, or sooner. Sines of
  /// what depends on no other sine are the angles' stage, what they need comes before it. What
  /// comes before the angles depends on no sine, so it asks for none of the angles' stage.
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

  /// The sine and cosine of an angle go side by side, even if only one of them is needed.
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
    if (number < Room.constants) program_.constants[number] = constant;
    return append(stage, Operation::constant, number);
  }

  /// @return the number of the value that the instruction computes
  constexpr std::size_t append(Stage stage, Operation operation, std::size_t left,
                               std::size_t right = 0) {
    const std::size_t number = next_[stage]++;
    if (number < Room.instructions) program_.instructions[number] = {operation, left, right};
    return number;
  }

  constexpr void append_output(const Term& term) {
    const std::size_t value = term.is_constant() ? append_constant(after_angles, term.constant)
                                                 : steps_[term.node].value_number;
    const std::size_t number = program_.size.outputs++;
    if (number < Room.outputs) program_.outputs[number] = {value, term.negative};
  }

  const Graph& graph_;
  GrowingArray<Step> steps_;       // one for each node
  std::size_t next_[stages] = {};  // the number of the next instruction
  Program<Room> program_{};
};

}  // namespace articula::symbolic
