// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

int* allocates() { return new int(1); }

void throws(int value) { throw value; }

void prints() { std::puts("slow"); }
