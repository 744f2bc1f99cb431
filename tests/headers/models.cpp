// SPDX-License-Identifier: Apache-2.0
// The dynamics of models of several sizes and shapes, compiled with optimisation: only then do
// compilers warn of what may be read before it is set.
#include <articula/articula.hpp>

namespace articula {

// NOLINTBEGIN(bugprone-macro-parentheses)
#define ARTICULA_MODEL(N, Bodies)                                                        \
  template JointVector<N> inverse_dynamics<Model<N, Bodies>>(                            \
      const Model<N, Bodies>&, const JointVector<N>&, const JointVector<N>&,             \
      const JointVector<N>&) noexcept;                                                   \
  template JointVector<N> forward_dynamics<Model<N, Bodies>>(                            \
      const Model<N, Bodies>&, const JointVector<N>&, const JointVector<N>&,             \
      const JointVector<N>&) noexcept;                                                   \
  template JointVector<N> nonlinear_effects<Model<N, Bodies>>(                           \
      const Model<N, Bodies>&, const JointVector<N>&, const JointVector<N>&) noexcept;   \
  template JointVector<N> gravity<Model<N, Bodies>>(const Model<N, Bodies>&,             \
                                                    const JointVector<N>&) noexcept;     \
  template JointMatrix<N> mass_matrix<Model<N, Bodies>>(const Model<N, Bodies>&,         \
                                                        const JointVector<N>&) noexcept; \
  template JointVectors<N, 4> gravity<Model<N, Bodies>, JointVectors<N, 4>>(             \
      const Model<N, Bodies>&, const JointVectors<N, 4>&) noexcept
// NOLINTEND(bugprone-macro-parentheses)

ARTICULA_MODEL(1, 1);
ARTICULA_MODEL(2, 2);
ARTICULA_MODEL(3, 3);
ARTICULA_MODEL(7, 7);
ARTICULA_MODEL(1, 2);
ARTICULA_MODEL(5, 6);

}  // namespace articula
