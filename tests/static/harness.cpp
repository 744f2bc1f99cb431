// SPDX-License-Identifier: Apache-2.0
// The mistake lies in the body of a template: the check must reach it.
template <int N>
int joints() {
  static_assert(N > 0, "the number of joints is positive");
  return N;
}

int main() {
#ifdef WITH_MISTAKE
  return joints<0>();
#else
  return joints<2>() - 2;
#endif
}
