// SPDX-License-Identifier: Apache-2.0
/// @file Execution of algorithms on Eigen's vectors, for described robots and for models.
#pragma once

#include "articula/core/joint_vector.hpp"
#include "articula/dynamics/engine/compiled.hpp"
#include "articula/dynamics/engine/configuration.hpp"
#include "articula/model/robot.hpp"
#include "articula/symbolic/pack.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace articula {

/// Joint vectors of several robots of one kind. They are JointVectors with a column for each, or a
/// JointVector over a pack (or over any scalar but double). Together they are computed faster than
/// one by one: registers of the target processor hold several numbers (-march=native).
template <class Q, class R>
concept JointVectorPack = (Q::ColsAtCompileTime >= 2 &&
                           std::same_as<Q, JointVectors<joint_count<R>, Q::ColsAtCompileTime>>) ||
                          (!std::same_as<typename Q::Scalar, double> &&
                           std::same_as<Q, JointVector<joint_count<R>, typename Q::Scalar>>);

namespace detail {

// By folds and not by loops: compilers leave arrays in memory that are filled by loops.

template <int N>
[[nodiscard, gnu::always_inline]] inline JointArray<double, N> to_array(
    const JointVector<N>& vector) noexcept {
  return [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    return JointArray<double, N>{vector.coeff(I)...};
  }(std::make_integer_sequence<int, N>{});
}

template <class S, int N>
[[nodiscard, gnu::always_inline]] inline JointVector<N, S> to_vector(
    const JointArray<S, N>& array) noexcept {
  return for_each_joint<N, S>([&](int j) __attribute__((always_inline)) { return array[j]; });
}

template <int N, class S>
[[nodiscard]] JointRows<S, N> to_rows(const JointMatrix<N, S>& matrix) noexcept {
  JointRows<S, N> rows;
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) rows[i][j] = matrix(i, j);
  }
  return rows;
}

template <class S, int N>
[[nodiscard, gnu::always_inline]] inline JointMatrix<N, S> to_matrix(
    const JointRows<S, N>& rows) noexcept {
  JointMatrix<N, S> matrix;
  // Row by row: clang refuses folds over more than 256 elements.
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    const auto copy_row = [&](int i) __attribute__((always_inline)) {
      ((matrix.coeffRef(i, I) = rows[i][I]), ...);
    };
    (copy_row(I), ...);
  }(std::make_integer_sequence<int, N>{});
  return matrix;
}

/// Whether an algorithm has an `Alternative` that can be faster for models of this size.
template <class Algorithm, int N, int B>
inline constexpr bool has_alternative_for_numbers = [] {
  if constexpr (requires { Algorithm::Alternative::smallest_model; }) {
    return N == B && N >= Algorithm::Alternative::smallest_model;
  } else {
    return false;
  }
}();

/// A robot of the kind of a described one, with other numbers: it runs that robot's programs.
template <class R>
concept HasNumbers = requires(const R& robot) {
  typename R::Nominal;
  robot.numbers().data();
};

/// Runs an algorithm on a robot at positions q. A described robot runs the program which the
/// compiler has made of `Algorithm::evaluate`, a varied robot that with its numbers as inputs. A
/// model runs this function itself, or that of the algorithm's alternative where it is faster. The
/// function then gets the mechanism, the configuration at q and the other inputs as arrays.
/// @param inputs  input[i] is a number, or a pack with the numbers of several robots
template <class Algorithm, Robot R, class Input, class... Inputs>
[[nodiscard, gnu::always_inline]] inline auto evaluate_numbers(const R& robot, const Input& q,
                                                               const Inputs&... inputs) noexcept {
  if constexpr (DescribedRobot<R>) {
    return compiled::run<Algorithm, R>(q, inputs...);
  } else if constexpr (HasNumbers<R> && !compiled::needs_own_frames<Algorithm>) {
    return compiled::run_with<Algorithm, typename R::Nominal>(robot.numbers().data(), q, inputs...);
  } else {
    compiled::check_masses<Algorithm, R>();
    using S = std::remove_cvref_t<decltype(q[0])>;
    constexpr int n = R::joint_count, b = R::body_count;
    const Mechanism<n, b>& mechanism = compiled::mechanism_for<Algorithm>(robot);
    const auto array = [](const Input& numbers) __attribute__((always_inline)) {
      return [&]<std::size_t... I>(std::index_sequence<I...>) __attribute__((always_inline)) {
        return JointArray<S, n>{numbers[I]...};
      }(std::make_index_sequence<std::size_t{n}>{});
    };
    const auto configuration = configuration_of<S, n, b>(mechanism, array(q));
    if constexpr (has_alternative_for_numbers<Algorithm, n, b>) {
      using Other = typename Algorithm::Alternative;
      if (Other::pays_for_numbers(mechanism)) {
        return Other::template evaluate<S, n, b>(mechanism, configuration, array(inputs)...);
      }
    }
    return Algorithm::template evaluate<S, n, b>(mechanism, configuration, array(inputs)...);
  }
}

/// The same for Eigen's vectors.
template <class Algorithm, Robot R, std::same_as<JointVector<joint_count<R>>>... Inputs>
[[nodiscard, gnu::always_inline]] inline auto evaluate(const R& robot,
                                                       const JointVector<joint_count<R>>& q,
                                                       const Inputs&... inputs) noexcept {
  return evaluate_numbers<Algorithm>(robot, q.data(), inputs.data()...);
}

/// A pack for each row of a matrix with K columns, one for each robot.
template <int Lanes, int K>
struct Columns {
  const double* first;

  [[gnu::always_inline]] symbolic::Pack<Lanes> operator[](std::size_t row) const noexcept {
    return symbolic::Pack<Lanes>::load(first + row * K);
  }
};

/// The same for several robots at once. Of the columns of JointVectors it takes as many at a time
/// as fit into a register. If K is no multiple of that, the last group ends at column K and
/// overlaps the one before.
template <class Algorithm, Robot R, JointVectorPack<R> Q, std::same_as<Q>... Inputs>
[[nodiscard]] Q evaluate_pack(const R& robot, const Q& q, const Inputs&... inputs) noexcept {
  constexpr int n = joint_count<R>, K = Q::ColsAtCompileTime;
  if constexpr (K == 1) {
    return to_vector(evaluate_numbers<Algorithm>(robot, q.data(), inputs.data()...));
  } else {
    constexpr int lanes = K < 4   ? 2
                          : K < 8 ? std::min(4, symbolic::lanes_of_a_register)
                                  : symbolic::lanes_of_a_register;
    Q result;
    for (int column = 0; column < K; column += lanes) {
      const int first = std::min(column, K - lanes);
      const auto columns = [&](const Q& vectors) __attribute__((always_inline)) {
        return Columns<lanes, K>{vectors.data() + first};
      };
      const JointArray<symbolic::Pack<lanes>, n> packed =
          evaluate_numbers<Algorithm>(robot, columns(q), columns(inputs)...);
      symbolic::detail::for_each_index<std::size_t{n}>(
          [&](std::size_t i)
              __attribute__((always_inline)) { packed[i].store(result.data() + i * K + first); });
    }
    return result;
  }
}

}  // namespace detail

}  // namespace articula
