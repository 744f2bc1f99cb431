// SPDX-License-Identifier: Apache-2.0
/// @file A growing array that compilers evaluate fast.
#pragma once

#include <cstddef>

namespace articula::symbolic {

/// An array that grows at its end, for constant evaluation. Compilers spend time on each function
/// call, and std::vector makes half a dozen calls for each element.
/// @tparam T  with a default constructor that initialises nothing
template <class T>
class GrowingArray {
 public:
  constexpr explicit GrowingArray(std::size_t capacity)
      : elements_(new T[capacity]), capacity_(capacity) {}
  constexpr ~GrowingArray() { delete[] elements_; }
  GrowingArray(const GrowingArray&) = delete;
  GrowingArray& operator=(const GrowingArray&) = delete;

  [[nodiscard]] constexpr int size() const { return size_; }
  [[nodiscard]] constexpr T* data() { return elements_; }
  [[nodiscard]] constexpr const T* data() const { return elements_; }
  [[nodiscard]] constexpr T& operator[](int i) { return elements_[i]; }
  [[nodiscard]] constexpr const T& operator[](int i) const { return elements_[i]; }

  /// @return the index of the new element
  constexpr int append(const T& element) {
    if (static_cast<std::size_t>(size_) == capacity_) grow();
    elements_[size_] = element;
    return size_++;
  }

 private:
  constexpr void grow() {
    capacity_ *= 2;
    T* const larger = new T[capacity_];
    for (int i = 0; i < size_; ++i) larger[i] = elements_[i];
    delete[] elements_;
    elements_ = larger;
  }

  T* elements_;
  std::size_t capacity_;
  int size_ = 0;
};

}  // namespace articula::symbolic
