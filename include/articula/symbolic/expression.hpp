// SPDX-License-Identifier: Apache-2.0
/// @file What an expression graph is made of.
#pragma once

namespace articula::symbolic {

/// What a node of the graph does with its operands.
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

/// True for the operations that compute a sine or a cosine.
[[nodiscard]] constexpr bool is_angle_function(Operation operation) noexcept {
  return operation == Operation::sine || operation == Operation::cosine;
}

/// A node of the graph: an operation on nodes that stand before it.
struct Node {
  static constexpr int none = -1;

  Operation operation;
  int left;      ///< node of the left operand, or none
  int right;     ///< node of the right operand, or none
  double value;  ///< of a constant; of an input, which one it is
};

/// A value while an expression is built: a number, or what a node computes, perhaps negated. Signs
/// live here and not in nodes: a sum of two terms is a node for their sum or difference, and the
/// sign that is left over is passed on to whatever uses it next.
struct Term {
  static constexpr int none = Node::none;

  double constant = 0;    ///< the value, if there is no node
  int node = none;        ///< index in the graph
  bool negative = false;  ///< stands for minus the node's value

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
