// SPDX-License-Identifier: Apache-2.0
/// @file Operations, nodes and terms: the elements of an expression graph.
#pragma once

namespace articula::symbolic {

/// The operation of a node on its operands.
enum class Operation : unsigned char {
  input,        ///< one of the function's inputs
  constant,     ///< a number
  add,          ///< left + right
  subtract,     ///< left - right
  multiply,     ///< left * right
  divide,       ///< left / right
  square_root,  ///< of left
  sine,         ///< of left [rad]
  cosine,       ///< of left [rad]
};

[[nodiscard]] constexpr bool is_angle_function(Operation operation) noexcept {
  return operation == Operation::sine || operation == Operation::cosine;
}

/// A node of the graph: an operation on nodes before it.
struct Node {
  static constexpr int none = -1;

  Operation operation;
  int left;      ///< node of the left operand, or none
  int right;     ///< node of the right operand, or none
  double value;  ///< of a constant; the number of an input
};

/// A value during the construction of an expression: a number or the value of a node, perhaps
/// negated. Signs belong to terms and not to nodes. A sum of two terms is a node for their sum or
/// difference. A remaining sign moves to the next operation.
struct Term {
  static constexpr int none = Node::none;

  double constant = 0;    ///< the value, if there is no node
  int node = none;        ///< index in the graph
  bool negative = false;  ///< the value is minus that of the node

  [[nodiscard]] constexpr bool is_constant() const noexcept { return node == none; }
  [[nodiscard]] constexpr bool is(double number) const noexcept {
    return node == none && constant == number;
  }

  friend constexpr Term operator-(const Term& x) noexcept {
    return x.is_constant() ? Term{.constant = 0 - x.constant}  // not -0
                           : Term{0, x.node, !x.negative};
  }
};

}  // namespace articula::symbolic
