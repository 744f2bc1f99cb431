// SPDX-License-Identifier: Apache-2.0
/// @file A graph of expressions that is simplified as it grows.
#pragma once

#include "articula/core/constant_math.hpp"
#include "articula/symbolic/expression.hpp"
#include "articula/symbolic/growing_array.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace articula::symbolic {

/// Expressions of real numbers as a graph in which no two nodes compute the same value. Every
/// operation simplifies its result before it adds a node:
///
/// - Constants are folded, as are sums with 0 and products with 0, 1 and -1.
/// - Signs move outwards up to a sum or an output: (-x) y = -(x y), -x - y = -(x + y),
///   sin(-x) = -sin x.
/// - Nested constants are combined: a (b x) = (a b) x, (x + a) + b = x + (a + b).
/// - Like terms are combined: a x + b x = (a + b) x.
/// - Opposite terms cancel: (x + y) + (z - y) = x + z, also if they differ by a constant.
/// - Operands of sums and products are sorted, so that x y and y x are one node.
///
/// The rules are those of real numbers. 0 x is 0 even for an infinite x, and results may differ in
/// rounding from the operations as written.
class Graph {
 public:
  constexpr Graph() {
    for (int& leaf : newest_leaf_) leaf = Term::none;
  }

  [[nodiscard]] constexpr int size() const { return entries_.size(); }
  /// The nodes, each after its operands. They are entries that derive from Node, with a larger
  /// size.
  [[nodiscard]] constexpr const auto* nodes() const { return entries_.data(); }

  /// The function's input number `index`.
  constexpr Term input(int index) { return {0, intern_leaf(Operation::input, index)}; }

  /// Signs stay outside: -a - b is the node a + b as a negative term, a - b and b - a are one node.
  constexpr Term add(Term x, Term y) {
    if (x.is_constant()) std::swap(x, y);
    if (x.is_constant()) return {x.constant + y.constant};
    if (y.is_constant()) return add_constant(x, y.constant);
    if (const auto sum = add_like_terms(x, y)) return *sum;
    if (const auto sum = add_opposite_terms(x, y)) return *sum;
    if (y.node < x.node) std::swap(x, y);
    const bool same_sign = x.negative == y.negative;
    const Operation operation = same_sign ? Operation::add : Operation::subtract;
    return {0, intern(operation, x.node, y.node), x.negative};
  }

  constexpr Term multiply(Term x, Term y) {
    if (y.is_constant()) std::swap(x, y);
    if (y.is_constant()) return {x.constant * y.constant};
    if (x.is_constant()) return multiply_by_constant(x.constant, y);
    if (y.node < x.node) std::swap(x, y);
    return {0, intern(Operation::multiply, x.node, y.node), x.negative != y.negative};
  }

  constexpr Term divide(Term x, Term y) {
    if (x.is_constant() && y.is_constant()) return {x.constant / y.constant};
    if (y.is_constant()) return multiply_by_constant(1 / y.constant, x);
    if (x.is(0)) return x;
    if (x.node == y.node) return {x.negative == y.negative ? 1.0 : -1.0};
    if (x.is_constant() && x.constant < 0) return -divide(-x, y);
    return {0, intern(Operation::divide, node_of(x), y.node), x.negative != y.negative};
  }

  constexpr Term square_root(Term x) {
    if (x.is_constant()) return {constant_math::square_root(x.constant)};
    int radicand = x.node;
    if (x.negative) radicand = intern(Operation::multiply, node_of({-1.0}), x.node);
    return {0, intern(Operation::square_root, radicand)};
  }

  constexpr Term sine(Term x) {
    if (x.is_constant()) return {constant_math::sine_cosine(x.constant).sine};
    return {0, intern(Operation::sine, x.node), x.negative};
  }

  constexpr Term cosine(Term x) {
    if (x.is_constant()) return {constant_math::sine_cosine(x.constant).cosine};
    return {0, intern(Operation::cosine, x.node)};
  }

 private:
  /// A number times a node.
  struct Multiple {
    double factor;
    int node;
  };

  /// A term as a multiple of a node that is not a multiple.
  [[nodiscard]] constexpr Multiple multiple(const Term& x) const {
    const double sign = x.negative ? -1 : 1;
    const Entry* const nodes = entries_.data();
    const Entry& node = nodes[x.node];
    if (node.operation == Operation::multiply &&
        nodes[node.left].operation == Operation::constant) {
      return {sign * nodes[node.left].value, node.right};
    }
    return {sign, x.node};
  }

  /// A node plus a number.
  struct Shifted {
    int node;
    double offset;
  };

  /// A node as another node, which is not a sum with a number, plus a number.
  [[nodiscard]] constexpr Shifted shifted(int index) const {
    const Entry* const nodes = entries_.data();
    const Entry& node = nodes[index];
    if (node.operation == Operation::add && nodes[node.right].operation == Operation::constant) {
      return {node.left, nodes[node.right].value};
    }
    return {index, 0};
  }

  /// Two terms with the term as their sum: the operands of a sum or difference, or itself and 0.
  [[nodiscard]] constexpr std::array<Term, 2> summands(const Term& x) const {
    const Entry* const nodes = entries_.data();
    const Entry& node = nodes[x.node];
    const bool is_difference = node.operation == Operation::subtract;
    if (node.operation != Operation::add && !is_difference) return {x, Term{}};
    const Term left{0, node.left, x.negative}, right{0, node.right, x.negative != is_difference};
    if (nodes[node.right].operation != Operation::constant) return {left, right};
    const double constant = nodes[node.right].value;
    return {left, Term{right.negative ? -constant : constant}};
  }

  /// a x + b x = (a + b) x. Except x + x, which costs the same as 2 x.
  constexpr std::optional<Term> add_like_terms(const Term& x, const Term& y) {
    const Multiple a = multiple(x), b = multiple(y);
    if (a.node != b.node) return {};
    const double factor = a.factor + b.factor;
    const bool is_node_twice = x.node == y.node && x.node == a.node && factor != 0;
    if (is_node_twice) return {};
    return multiply_by_constant(factor, {0, a.node});
  }

  /// (x + u) + (y - w) = (x + y) + c where u - w is the number c.
  constexpr std::optional<Term> add_opposite_terms(const Term& x, const Term& y) {
    const Operation first = entries_[x.node].operation, second = entries_[y.node].operation;
    const bool is_any_sum = first == Operation::add || first == Operation::subtract ||
                            second == Operation::add || second == Operation::subtract;
    if (!is_any_sum) return {};
    const std::array<Term, 2> p = summands(x), q = summands(y);
    for (const std::size_t i : {0U, 1U}) {
      for (const std::size_t j : {0U, 1U}) {
        const Term u = p[i], w = q[j];
        if (u.is_constant() || w.is_constant() || u.negative == w.negative) continue;
        const Shifted a = shifted(u.node), b = shifted(w.node);
        if (a.node != b.node) continue;
        const double rest = u.negative ? b.offset - a.offset : a.offset - b.offset;
        return add(add(p[1 - i], q[1 - j]), {rest});
      }
    }
    return {};
  }

  /// x + c with the sign outside: -x + c = -(x - c).
  constexpr Term add_constant(const Term& x, double c) {
    const Shifted inner = shifted(x.node);
    const double offset = inner.offset + (x.negative ? -c : c);
    if (offset == 0) return {0, inner.node, x.negative};
    return {0, intern(Operation::add, inner.node, node_of({offset})), x.negative};
  }

  /// c x with the sign outside and the constant on the left.
  constexpr Term multiply_by_constant(double c, const Term& x) {
    if (c == 0) return {};
    const Multiple inner = multiple(x);
    const double product = c * inner.factor, factor = product < 0 ? -product : product;
    if (factor == 1) return {0, inner.node, product < 0};
    return {0, intern(Operation::multiply, node_of({factor}), inner.node), product < 0};
  }

  /// The node of a term without its sign.
  constexpr int node_of(const Term& x) {
    return x.is_constant() ? intern_leaf(Operation::constant, x.constant) : x.node;
  }

  /// The node of an operation, a new one if there is none. The search covers the nodes with the
  /// same last operand, which are few.
  constexpr int intern(Operation operation, int left, int right = Node::none) {
    Entry* const nodes = entries_.data();
    int& newest = nodes[right == Node::none ? left : right].newest_user;
    for (int i = newest; i != Node::none; i = nodes[i].next) {
      const Entry& node = nodes[i];
      if (node.left == left && node.right == right && node.operation == operation) return i;
    }
    const int next = newest;
    newest = entries_.size();
    return entries_.append({{operation, left, right, 0}, Node::none, next});
  }

  /// The same for a node without operands. The search covers the nodes with the same hash.
  constexpr int intern_leaf(Operation operation, double value) {
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
    int& newest = newest_leaf_[(bits * golden) >> (64U - leaf_bits)];
    for (int i = newest; i != Node::none; i = entries_[i].next) {
      if (entries_[i].value == value && entries_[i].operation == operation) return i;
    }
    const int next = newest;
    newest = entries_.size();
    return entries_.append({{operation, Node::none, Node::none, value}, Node::none, next});
  }

  static constexpr std::uint64_t golden = 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio
  static constexpr unsigned leaf_bits = 8;

  /// A node and its links in the lists that intern searches.
  struct Entry : Node {
    int newest_user;  // of the nodes that have this one as their last operand
    int next;         // older node in the same list
  };

  GrowingArray<Entry> entries_{2048};
  int newest_leaf_[1U << leaf_bits];
};

}  // namespace articula::symbolic
