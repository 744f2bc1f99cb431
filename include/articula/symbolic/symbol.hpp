// SPDX-License-Identifier: Apache-2.0
/// @file The scalar that writes down what is done with it.
#pragma once

#include "articula/symbolic/graph.hpp"

#include <stdexcept>

namespace articula::symbolic {

namespace detail {

/// No constant expression: compilers name it. Who divides by a constant 0 has made an algorithm
/// that works for no input, such as forward dynamics of a robot one of whose joints feels no
/// inertia.
[[noreturn]] inline void the_divisor_is_always_zero() {
  throw std::domain_error("articula: the divisor is always zero");
}

}  // namespace detail

/// A scalar that stands for an expression. An algorithm that is written for any scalar type and run
/// on symbols leaves its result as expressions in the graph that its inputs came from. Constants
/// need no graph; all other symbols of one calculation must be of the same one, which must outlive
/// them.
class Symbol {
 public:
  /// Operations with zeros and ones vanish.
  static constexpr bool simplifies = true;

  constexpr Symbol() = default;  ///< zero
  constexpr explicit Symbol(double constant) : term_{constant} {}
  constexpr Symbol(Graph& graph, const Term& term) : graph_(&graph), term_(term) {}

  [[nodiscard]] constexpr const Term& term() const noexcept { return term_; }

  // What needs no graph is done here, although the graph would find it as well: compilers take
  // their time for each call.
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
