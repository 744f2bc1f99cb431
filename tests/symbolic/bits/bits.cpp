// SPDX-License-Identifier: Apache-2.0
// Prints a digest of the bits of many results, a line for each function. Compiled by different
// compilers for different processors it is to print the same.
#include <articula/dynamics/dynamics.hpp>
#include <articula/robots/panda.hpp>
#include <articula/robots/ur10.hpp>

#include <bit>
#include <cstdint>
#include <cstdio>
#include <span>

using namespace articula;

namespace {

/// Numbers that no function of a library has made.
class Numbers {
 public:
  /// In [-size, size].
  double next(double size) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;  // [Knuth's MMIX]
    return size * (static_cast<double>(state_ >> 12U) / 0x1p51 - 1);
  }
  template <class Vector>
  Vector vector(double size) {
    Vector v;
    for (Eigen::Index i = 0; i < v.size(); ++i) v.data()[i] = next(size);
    return v;
  }

 private:
  std::uint64_t state_ = 1;
};

class Digest {
 public:
  void add(std::span<const double> numbers) {
    for (const double x : numbers) {
      value_ = (value_ ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
      value_ ^= value_ >> 29U;
    }
  }
  template <class Matrix>
  void add_matrix(const Matrix& matrix) {
    add({matrix.data(), static_cast<std::size_t>(matrix.size())});
  }
  void print(const char* robot, const char* name) const {
    std::printf("%s %s %016llx\n", robot, name, static_cast<unsigned long long>(value_));
  }

 private:
  std::uint64_t value_ = 1;
};

template <std::size_t K>
void sines() {
  Numbers numbers;
  Digest digest;
  for (int trial = 0; trial < 1000; ++trial) {
    std::array<double, K> angle, sine, cosine;
    for (double& x : angle) x = numbers.next(trial % 2 == 0 ? 4 : 1e4);
    symbolic::sine_cosine(angle, sine, cosine);
    digest.add(sine);
    digest.add(cosine);
  }
  digest.print(K < 3 ? "few" : "many", "sines");
}

template <class R>
void dynamics(const char* name, const R& robot) {
  constexpr int n = joint_count<R>;
  Numbers numbers;
  Digest inverse, forward, weight, bias, matrix, energy, place, motion, columns;
  for (int trial = 0; trial < 300; ++trial) {
    const auto q = numbers.vector<JointVector<n>>(4), v = numbers.vector<JointVector<n>>(2),
               x = numbers.vector<JointVector<n>>(9);
    inverse.add_matrix(inverse_dynamics(robot, q, v, x));
    forward.add_matrix(forward_dynamics(robot, q, v, x));
    weight.add_matrix(gravity(robot, q));
    bias.add_matrix(nonlinear_effects(robot, q, v));
    matrix.add_matrix(mass_matrix(robot, q));
    const double energies[] = {kinetic_energy(robot, q, v), potential_energy(robot, q)};
    energy.add(energies);
    const LinkIndex last{model_of(robot).links.size() - 1};
    place.add_matrix(forward_kinematics(robot, q, last).matrix());
    motion.add_matrix(jacobian(robot, q, last));
    using Many = JointVectors<n, 5>;
    const auto a = numbers.vector<Many>(4), b = numbers.vector<Many>(2),
               c = numbers.vector<Many>(9);
    columns.add_matrix(forward_dynamics(robot, a, b, c));
  }
  inverse.print(name, "inverse dynamics");
  forward.print(name, "forward dynamics");
  weight.print(name, "gravity");
  bias.print(name, "nonlinear effects");
  matrix.print(name, "mass matrix");
  energy.print(name, "energies");
  place.print(name, "forward kinematics");
  motion.print(name, "Jacobian");
  columns.print(name, "forward dynamics of five");
}

template <Name link, class R>
void named_link(const char* name) {
  Numbers numbers;
  Digest place, motion;
  for (int trial = 0; trial < 300; ++trial) {
    const auto q = numbers.vector<JointVector<joint_count<R>>>(4);
    place.add_matrix(forward_kinematics<link>(R{}, q).matrix());
    motion.add_matrix(jacobian<link>(R{}, q));
  }
  place.print(name, "named link");
  motion.print(name, "Jacobian of a named link");
}

[[gnu::noinline]] void print_all() {
  sines<1>();
  sines<2>();
  sines<3>();
  sines<4>();
  sines<5>();
  sines<7>();
  sines<8>();
  sines<9>();
  sines<17>();
  dynamics("UR10", Ur10{});
  dynamics("Panda", Panda{});
  dynamics("Panda as a model", model_of(Panda{}));
  named_link<"tool0", Ur10>("UR10");
  named_link<"panda_hand_tcp", Panda>("Panda");
}

}  // namespace

int main() {
#if defined(__AVX512F__)
  const bool runs = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#elif defined(__AVX2__)
  const bool runs = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  const bool runs = true;
#endif
  if (runs) print_all();
}
