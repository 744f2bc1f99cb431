// SPDX-License-Identifier: Apache-2.0
/// @file The scalar that records operations as an expression.
#pragma once

#include "articula/symbolic/graph.hpp"

#include <stdexcept>

namespace articula::symbolic {

namespace detail {

/// Not a constant expression, so that compilers name it in their message. A constant divisor 0
/// occurs in an algorithm that has no result for any input. An example is forward dynamics of a
/// robot with a joint without inertia.
[[noreturn]] inline void the_divisor_is_always_zero() {
  throw std::domain_error("articula: the divisor is always zero");
}

}  // namespace detail

/// A scalar that represents an expression. The results of an algorithm over any scalar, run on
/// symbols, are expressions in the graph of its inputs. Constants need no graph. All other symbols
/// of one calculation must belong to the same graph, which must outlive them.
class Symbol {
 public:
  /// Operations with zeros and ones are removed.
  static constexpr bool simplifies = true;

  constexpr Symbol() = default;  ///< zero
  constexpr explicit Symbol(double constant) : term_{constant} {}
  constexpr Symbol(Graph& graph, const Term& term) : graph_(&graph), term_(term) {}

  [[nodiscard]] constexpr const Term& term() const noexcept { return term_; }

  // Constants are folded here although the graph would fold them, too: compilers spend time on each
  // call.
  friend constexpr Symbol operator-(const Symbol& x) { return {x.graph_, -x.term_}; }
  friend constexpr Symbol operator+(const Symbol& x, const Symbol& y) {
    const bool x_constant = x.term_.node == Term::none, y_constant = y.term_.node == Term::none;
    if (x_constant && x.term_.constant == 0) return y;
    if (y_constant && y.term_.constant == 0) return x;
    if (x_constant && y_constant) return Symbol(x.term_.constant + y.term_.constant);
    Graph* const graph = x.graph_ ? x.graph_ : y.graph_;
    return {graph, graph->add(x.term_, y.term_)};
  }
  friend constexpr Symbol operator-(const Symbol& x, const Symbol& y) { return x + -y; }
  friend constexpr Symbol operator*(const Symbol& x, const Symbol& y) {
    const bool x_constant = x.term_.node == Term::none, y_constant = y.term_.node == Term::none;
    if (x_constant && x.term_.constant == 0) return Symbol();
    if (y_constant && y.term_.constant == 0) return Symbol();
    if (x_constant && y_constant) return Symbol(x.term_.constant * y.term_.constant);
    Graph* const graph = x.graph_ ? x.graph_ : y.graph_;
    return {graph, graph->multiply(x.term_, y.term_)};
  }
  friend constexpr Symbol operator/(const Symbol& x, const Symbol& y) {
    const bool x_constant = x.term_.node == Term::none, y_constant = y.term_.node == Term::none;
    if (y_constant && y.term_.constant == 0) detail::the_divisor_is_always_zero();
    if (x_constant && y_constant) return Symbol(x.term_.constant / y.term_.constant);
    Graph* const graph = x.graph_ ? x.graph_ : y.graph_;
    return {graph, graph->divide(x.term_, y.term_)};
  }
  friend constexpr Symbol sqrt(const Symbol& x) {
    if (!x.graph_) return Symbol(constant_math::square_root(x.term_.constant));
    return {x.graph_, x.graph_->square_root(x.term_)};
  }
  friend constexpr Symbol sin(const Symbol& x) {
    if (!x.graph_) return Symbol(constant_math::sine_cosine(x.term_.constant).sine);
    return {x.graph_, x.graph_->sine(x.term_)};
  }
  friend constexpr Symbol cos(const Symbol& x) {
    if (!x.graph_) return Symbol(constant_math::sine_cosine(x.term_.constant).cosine);
    return {x.graph_, x.graph_->cosine(x.term_)};
  }

 private:
  constexpr Symbol(Graph* graph, const Term& term) : graph_(graph), term_(term) {}

  Graph* graph_ = nullptr;
  Term term_;
};

}  // namespace articula::symbolic
