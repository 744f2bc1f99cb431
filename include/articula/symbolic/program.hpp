// SPDX-License-Identifier: Apache-2.0
/// @file Straight-line programs as values of the compiler.
#pragma once

#include "articula/symbolic/expression.hpp"

#include <cstddef>

namespace articula::symbolic {

/// How many operations a program takes. Changes of sign are not counted.
struct OperationCounts {
  int multiplications = 0;
  int additions = 0;  ///< and subtractions
  int divisions = 0;
  int square_roots = 0;
  int sines = 0;  ///< angles whose sine, cosine or both are taken

  friend constexpr bool operator==(const OperationCounts&, const OperationCounts&) = default;

  /// A rough measure of the time they take, in multiplications.
  [[nodiscard]] constexpr int cost() const noexcept {
    return multiplications + additions + 4 * (divisions + square_roots) + 10 * sines;
  }
};

/// One step of a program. Its result is value number i, where i is its place in the program.
struct Instruction {
  Operation operation;
  std::size_t left;   ///< value of the left operand; for inputs and constants, which one it is
  std::size_t right;  ///< value of the right operand
};

/// A result of a program: a value, perhaps negated.
struct Output {
  std::size_t value;
  bool negative;
};

/// How large a program is.
struct ProgramSize {
  std::size_t instructions = 0;
  std::size_t constants = 0;
  std::size_t outputs = 0;
};

/// A function without branches and loops, as a value that the compiler can hold. Sines and cosines
/// come in pairs, the sine first; those of angles that depend on the inputs by arithmetic alone
/// stand together, so that they can be taken at once. The arrays have room for more than there is,
/// so that a program can be returned by the one function that finds out how long it is. (Plain
/// arrays: compilers read them faster than std::array.)
/// @tparam Room  for how much there is room
template <ProgramSize Room>
struct Program {
  Instruction instructions[Room.instructions];  // NOLINT
  double constants[Room.constants + 1];         // NOLINT: there may be none, but no empty array
  Output outputs[Room.outputs];                 // NOLINT
  ProgramSize size;                             ///< how much there is, or would be
  std::size_t angles_begin;                     ///< where those sines and cosines begin
  std::size_t angles_end;                       ///< and where they end

  /// False if there was not room enough: then the size alone is right.
  [[nodiscard]] constexpr bool is_whole() const noexcept {
    return size.instructions <= Room.instructions && size.constants <= Room.constants &&
           size.outputs <= Room.outputs;
  }

  [[nodiscard]] constexpr OperationCounts operations() const noexcept {
    OperationCounts counts;
    for (std::size_t i = 0; i < size.instructions; ++i) {
      switch (instructions[i].operation) {
        case Operation::input:
        case Operation::constant:
        case Operation::cosine:
          break;
        case Operation::add:
        case Operation::subtract:
          ++counts.additions;
          break;
        case Operation::multiply:
          ++counts.multiplications;
          break;
        case Operation::divide:
          ++counts.divisions;
          break;
        case Operation::square_root:
          ++counts.square_roots;
          break;
        case Operation::sine:  // every sine has its cosine
          ++counts.sines;
          break;
      }
    }
    return counts;
  }
};

}  // namespace articula::symbolic
