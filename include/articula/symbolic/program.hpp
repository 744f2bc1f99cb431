// SPDX-License-Identifier: Apache-2.0
/// @file Straight-line programs as compile-time values.
#pragma once

#include "articula/symbolic/expression.hpp"

#include <cstddef>

namespace articula::symbolic {

/// The number of operations of a program. Changes of sign are not counted.
struct OperationCounts {
  int multiplications = 0;
  int additions = 0;  ///< and subtractions
  int divisions = 0;
  int square_roots = 0;
  int sines = 0;  ///< angles with a sine, a cosine or both

  friend constexpr bool operator==(const OperationCounts&, const OperationCounts&) = default;

  /// A rough measure of their time, in multiplications.
  [[nodiscard]] constexpr int cost() const noexcept {
    return multiplications + additions + 4 * (divisions + square_roots) + 10 * sines;
  }
};

/// One step of a program. The result of step i is value number i.
struct Instruction {
  Operation operation;
  std::size_t left;   ///< number of the left operand's value, of the input or of the constant
  std::size_t right;  ///< number of the right operand's value
};

/// A result of a program: a value, perhaps negated.
struct Output {
  std::size_t value;
  bool negative;
};

/// The size of a program.
struct ProgramSize {
  std::size_t instructions = 0;
  std::size_t constants = 0;
  std::size_t outputs = 0;
};

/// A function without branches and loops, as a compile-time value. Sines and cosines come in pairs,
/// the sine first. Pairs of angles that depend on the inputs by arithmetic alone are adjacent, so
/// that they can be computed at once. The arrays may be larger than the program, because the
/// function that returns it is the one that determines its size. (Plain arrays: compilers read them
/// faster than std::array.)
/// @tparam Capacity  the size of the arrays
template <ProgramSize Capacity>
struct Program {
  Instruction instructions[Capacity.instructions];  // NOLINT
  double constants[Capacity.constants + 1];  // NOLINT: one more, because no array may be empty
  Output outputs[Capacity.outputs];          // NOLINT
  ProgramSize size;                          ///< of the program, even if it exceeds the capacity
  std::size_t angles_begin;                  ///< first of the adjacent sines and cosines
  std::size_t angles_end;                    ///< end of the adjacent sines and cosines

  /// False if the program exceeds the capacity: then only the size is valid.
  [[nodiscard]] constexpr bool is_complete() const noexcept {
    return size.instructions <= Capacity.instructions && size.constants <= Capacity.constants &&
           size.outputs <= Capacity.outputs;
  }

  [[nodiscard]] constexpr OperationCounts operations() const noexcept {
    int counts[static_cast<std::size_t>(Operation::cosine) + 1] = {};  // NOLINT: plain, as above
    const auto count = [&counts](Operation operation) -> int& {
      return counts[static_cast<std::size_t>(operation)];
    };
    for (std::size_t i = 0; i < size.instructions; ++i) ++count(instructions[i].operation);
    return {.multiplications = count(Operation::multiply),
            .additions = count(Operation::add) + count(Operation::subtract),
            .divisions = count(Operation::divide),
            .square_roots = count(Operation::square_root),
            .sines = count(Operation::sine)};  // every sine has its cosine
  }
};

}  // namespace articula::symbolic
