// SPDX-License-Identifier: Apache-2.0
#include "articula/symbolic/symbol.hpp"

#include "catch.hpp"

#include <cmath>
#include <limits>

using articula::symbolic::Graph;
using articula::symbolic::Symbol;

TEST_CASE("Symbols without a graph calculate") {
  constexpr Symbol two(2.0), three(3.0);
  STATIC_REQUIRE((two + three).term().is(5));
  STATIC_REQUIRE((two - three).term().is(-1));
  STATIC_REQUIRE((two * three).term().is(6));
  STATIC_REQUIRE((three / two).term().is(1.5));
  STATIC_REQUIRE((-two).term().is(-2));
  STATIC_REQUIRE(sqrt(Symbol(9.0)).term().is(3));
  STATIC_REQUIRE(sin(Symbol(0.0)).term().is(0));
  STATIC_REQUIRE(cos(Symbol()).term().is(1));
}

TEST_CASE("Functions of constants agree with the standard library") {
  constexpr double ulp = std::numeric_limits<double>::epsilon();  // of numbers from 1 to 2
  for (double x = -20; x <= 20; x += 0.037) {
    CHECK(std::abs(sin(Symbol(x)).term().constant - std::sin(x)) <= ulp / 2);
    CHECK(std::abs(cos(Symbol(x)).term().constant - std::cos(x)) <= ulp / 2);
    if (x < 0) continue;
    CHECK(std::abs(sqrt(Symbol(x)).term().constant - std::sqrt(x)) <= ulp * std::sqrt(x));
  }
}

TEST_CASE("Symbols of a graph record what is done with them") {
  Graph graph;
  const Symbol x(graph, graph.input(0));
  CHECK((x * Symbol(0.0)).term().is(0));
  CHECK((x - x).term().is(0));
  CHECK((x + Symbol(0.0)).term().node == x.term().node);
  CHECK(graph.size() == 1);

  const Symbol length = sqrt(sin(x) * sin(x) + cos(x) * cos(x));
  CHECK(graph.size() == 7);  // x, sine, its square, cosine, its square, sum, root
  CHECK(length.term().node == 6);
}

TEST_CASE("An expression can be recorded by the compiler") {
  constexpr int nodes = [] {
    Graph graph;
    const Symbol x(graph, graph.input(0)), y(graph, graph.input(1));
    const Symbol difference_of_squares = (x + y) * (x - y);
    return difference_of_squares.term().node;
  }();
  STATIC_REQUIRE(nodes == 4);
}
