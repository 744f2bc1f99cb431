// SPDX-License-Identifier: Apache-2.0
/// @file Vectors and matrices in space over any scalar, usable at compile time (Eigen 3.4 is not).
#pragma once

#include <array>

namespace articula {

namespace detail {

[[nodiscard]] constexpr double magnitude(double x) noexcept { return x < 0 ? -x : x; }

}  // namespace detail

/// A vector in space. Its users state unit and frame.
/// @tparam S  any type with +, - and *, made from a double
template <class S>
struct Vector3 {
  S x = S(0.0);
  S y = S(0.0);
  S z = S(0.0);

  friend bool operator==(const Vector3&, const Vector3&) = default;

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a) noexcept { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vector3 operator*(const S& s, const Vector3& a) noexcept {
    return {s * a.x, s * a.y, s * a.z};
  }
};

/// The inner product a . b.
template <class S>
[[nodiscard]] constexpr S dot(const Vector3<S>& a, const Vector3<S>& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The vector product a x b.
template <class S>
[[nodiscard]] constexpr Vector3<S> cross(const Vector3<S>& a, const Vector3<S>& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The same vector over another scalar.
template <class S>
[[nodiscard]] constexpr Vector3<S> constant(const Vector3<double>& a) noexcept {
  return {S(a.x), S(a.y), S(a.z)};
}

/// A 3 x 3 matrix, by rows.
template <class S>
struct Matrix3 {
  std::array<Vector3<S>, 3> rows;

  [[nodiscard]] static constexpr Matrix3 identity() noexcept {
    return {{{{S(1.0), S(0.0), S(0.0)}, {S(0.0), S(1.0), S(0.0)}, {S(0.0), S(0.0), S(1.0)}}}};
  }

  [[nodiscard]] constexpr Vector3<S> column(int k) const noexcept {
    const auto& [a, b, c] = rows;
    if (k == 0) return {a.x, b.x, c.x};
    if (k == 1) return {a.y, b.y, c.y};
    return {a.z, b.z, c.z};
  }
  [[nodiscard]] constexpr Matrix3 transposed() const noexcept {
    return {{{column(0), column(1), column(2)}}};
  }

  friend bool operator==(const Matrix3&, const Matrix3&) = default;

  friend constexpr Vector3<S> operator*(const Matrix3& m, const Vector3<S>& a) noexcept {
    return {dot(m.rows[0], a), dot(m.rows[1], a), dot(m.rows[2], a)};
  }
  friend constexpr Matrix3 operator*(const Matrix3& a, const Matrix3& b) noexcept {
    const Matrix3 columns = b.transposed();
    return {{{columns * a.rows[0], columns * a.rows[1], columns * a.rows[2]}}};
  }
};

/// The product of the transposed matrix and a vector: for a rotation, the inverse rotation.
template <class S>
[[nodiscard]] constexpr Vector3<S> transposed_times(const Matrix3<S>& m,
                                                    const Vector3<S>& a) noexcept {
  const auto& [x, y, z] = m.rows;
  return {x.x * a.x + y.x * a.y + z.x * a.z, x.y * a.x + y.y * a.y + z.y * a.z,
          x.z * a.x + y.z * a.y + z.z * a.z};
}

/// The same matrix over another scalar.
template <class S>
[[nodiscard]] constexpr Matrix3<S> constant(const Matrix3<double>& m) noexcept {
  return {{{constant<S>(m.rows[0]), constant<S>(m.rows[1]), constant<S>(m.rows[2])}}};
}

/// A symmetric 3 x 3 matrix by its upper triangle, as URDF defines an inertia.
template <class S>
struct Symmetric3 {
  S xx = S(0.0);
  S xy = S(0.0);
  S xz = S(0.0);
  S yy = S(0.0);
  S yz = S(0.0);
  S zz = S(0.0);

  friend bool operator==(const Symmetric3&, const Symmetric3&) = default;

  friend constexpr Symmetric3 operator+(const Symmetric3& a, const Symmetric3& b) noexcept {
    return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
  }
  friend constexpr Vector3<S> operator*(const Symmetric3& m, const Vector3<S>& a) noexcept {
    return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
            m.xz * a.x + m.yz * a.y + m.zz * a.z};
  }
};

}  // namespace articula
