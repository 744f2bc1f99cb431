// SPDX-License-Identifier: Apache-2.0
/// @file The scalar that writes down what is done with it.
#pragma once

#include "articula/symbolic/graph.hpp"

namespace articula::symbolic {

/// A scalar that stands for an expression. An algorithm that is written for any scalar type and run
/// on symbols leaves its result as expressions in the graph that its inputs came from. Constants
/// need no graph; all other symbols of one calculation must be of the same one, which must outlive
/// them.
class Symbol {
 public:
  constexpr Symbol() = default;  ///< zero
  constexpr explicit Symbol(double constant) : term_{constant} {}
  constexpr Symbol(Graph& graph, const Term& term) : graph_(&graph), term_(term) {}

  [[nodiscard]] constexpr const Term& term() const noexcept { return term_; }

  friend constexpr Symbol operator-(const Symbol& x) { return {x.graph_, -x.term_}; }
  friend constexpr Symbol operator+(const Symbol& x, const Symbol& y) {
    if (x.term_.is(0)) return y;
    if (y.term_.is(0)) return x;
    if (both_constant(x, y)) return Symbol(x.term_.constant + y.term_.constant);
    return {graph_of(x, y), graph_of(x, y)->add(x.term_, y.term_)};
  }
  friend constexpr Symbol operator-(const Symbol& x, const Symbol& y) { return x + -y; }
  friend constexpr Symbol operator*(const Symbol& x, const Symbol& y) {
    if (x.term_.is(0) || y.term_.is(0)) return Symbol();
    if (both_constant(x, y)) return Symbol(x.term_.constant * y.term_.constant);
    return {graph_of(x, y), graph_of(x, y)->multiply(x.term_, y.term_)};
  }
  friend constexpr Symbol operator/(const Symbol& x, const Symbol& y) {
    if (both_constant(x, y)) return Symbol(x.term_.constant / y.term_.constant);
    return {graph_of(x, y), graph_of(x, y)->divide(x.term_, y.term_)};
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

  static constexpr bool both_constant(const Symbol& x, const Symbol& y) {
    return x.term_.is_constant() && y.term_.is_constant();
  }
  static constexpr Graph* graph_of(const Symbol& x, const Symbol& y) {
    return x.graph_ ? x.graph_ : y.graph_;
  }

  Graph* graph_ = nullptr;
  Term term_;
};

}  // namespace articula::symbolic
