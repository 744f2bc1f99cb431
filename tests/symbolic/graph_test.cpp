// SPDX-License-Identifier: Apache-2.0
#include "articula/symbolic/graph.hpp"

#include "catch.hpp"

using namespace articula::symbolic;  // NOLINT

namespace {

/// A graph with three inputs, and what is asked of it.
struct Calculation {
  Graph graph{};
  Term x = graph.input(0), y = graph.input(1), z = graph.input(2);

  static Term number(double value) { return {.constant = value}; }
  Term sum(Term a, Term b) { return graph.add(a, b); }
  Term difference(Term a, Term b) { return graph.add(a, -b); }
  Term product(Term a, Term b) { return graph.multiply(a, b); }
};

bool same(const Term& a, const Term& b) {
  return a.node == b.node && a.negative == b.negative && a.constant == b.constant;
}

}  // namespace

TEST_CASE("Constants are computed at once") {
  Calculation c;
  CHECK(c.sum(c.number(2), c.number(3)).is(5));
  CHECK(c.product(c.number(2), c.number(3)).is(6));
  CHECK(c.graph.divide(c.number(3), c.number(2)).is(1.5));
  CHECK(c.graph.square_root(c.number(9)).is(3));
  CHECK(c.graph.size() == 3);  // the inputs alone
}

TEST_CASE("Nothing is added, and nothing multiplied by 0, 1 and -1") {
  Calculation c;
  CHECK(same(c.sum(c.x, c.number(0)), c.x));
  CHECK(same(c.sum(c.number(0), c.x), c.x));
  CHECK(c.product(c.x, c.number(0)).is(0));
  CHECK(same(c.product(c.number(1), c.x), c.x));
  CHECK(same(c.product(c.x, c.number(-1)), -c.x));
  CHECK(c.graph.divide(c.number(0), c.x).is(0));
  CHECK(same(c.graph.divide(c.x, c.number(1)), c.x));
  CHECK(c.graph.size() == 3);
}

TEST_CASE("What is equal is one node") {
  Calculation c;
  CHECK(same(c.sum(c.x, c.y), c.sum(c.y, c.x)));
  CHECK(same(c.product(c.x, c.y), c.product(c.y, c.x)));
  CHECK(same(c.product(c.sum(c.x, c.y), c.z), c.product(c.z, c.sum(c.y, c.x))));
  CHECK(same(c.graph.sine(c.x), c.graph.sine(c.x)));
  CHECK_FALSE(same(c.graph.sine(c.x), c.graph.cosine(c.x)));
  CHECK_FALSE(same(c.graph.divide(c.x, c.y), c.graph.divide(c.y, c.x)));
}

TEST_CASE("Signs move outwards") {
  Calculation c;
  CHECK(same(c.product(-c.x, c.y), -c.product(c.x, c.y)));
  CHECK(same(c.product(-c.x, -c.y), c.product(c.x, c.y)));
  CHECK(same(c.product(c.number(-2), c.x), -c.product(c.number(2), c.x)));
  CHECK(same(c.difference(c.x, c.y), -c.difference(c.y, c.x)));
  CHECK(same(c.difference(-c.x, c.y), -c.sum(c.x, c.y)));
  CHECK(same(c.sum(-c.x, c.number(2)), -c.sum(c.x, c.number(-2))));
  CHECK(same(c.graph.divide(-c.x, c.y), -c.graph.divide(c.x, c.y)));
  CHECK(same(c.graph.divide(c.number(-2), c.y), -c.graph.divide(c.number(2), c.y)));
  CHECK(same(c.graph.sine(-c.x), -c.graph.sine(c.x)));
  CHECK(same(c.graph.cosine(-c.x), c.graph.cosine(c.x)));
}

TEST_CASE("Nested constants meet") {
  Calculation c;
  CHECK(same(c.product(c.number(2), c.product(c.number(3), c.x)), c.product(c.number(6), c.x)));
  CHECK(same(c.product(c.number(2), c.product(c.number(0.5), c.x)), c.x));
  CHECK(same(c.sum(c.number(2), c.sum(c.number(3), c.x)), c.sum(c.number(5), c.x)));
  CHECK(same(c.sum(c.number(2), c.sum(c.number(-2), c.x)), c.x));
  CHECK(same(c.graph.divide(c.x, c.number(4)), c.product(c.number(0.25), c.x)));
}

TEST_CASE("Like terms meet") {
  Calculation c;
  const Term twice = c.product(c.number(2), c.x), thrice = c.product(c.number(3), c.x);
  CHECK(same(c.sum(twice, thrice), c.product(c.number(5), c.x)));
  CHECK(same(c.difference(thrice, twice), c.x));
  CHECK(same(c.sum(twice, c.x), thrice));
  CHECK(c.difference(c.x, c.x).is(0));
  CHECK(c.graph.divide(c.x, c.x).is(1));
  CHECK(c.graph.divide(c.x, -c.x).is(-1));
}

TEST_CASE("Opposite terms cancel") {
  Calculation c;
  CHECK(same(c.difference(c.sum(c.x, c.y), c.y), c.x));
  CHECK(same(c.sum(c.y, c.difference(c.x, c.y)), c.x));
  CHECK(same(c.sum(c.sum(c.x, c.y), c.difference(c.z, c.y)), c.sum(c.x, c.z)));
  CHECK(same(c.sum(c.sum(c.y, c.number(2)), c.difference(c.number(3), c.y)), c.number(5)));
  CHECK(same(c.sum(c.sum(c.x, c.sum(c.y, c.number(2))), c.difference(c.number(3), c.y)),
             c.sum(c.x, c.number(5))));
}

TEST_CASE("A graph finds its nodes however many they are") {
  Graph graph;
  const Term x = graph.input(0);
  const auto build = [&] {
    Term sum = x;
    for (int i = 1; i < 5000; ++i) sum = graph.multiply(graph.add(sum, {.constant = 1.0 / i}), x);
    return sum;
  };
  const Term first = build();
  const int size = graph.size();
  CHECK(same(build(), first));
  CHECK(graph.size() == size);
}
