// SPDX-License-Identifier: Apache-2.0
/// @file
/// Catch2, whichever of its versions 2 and 3 is installed. `Approx` is a global name with both.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
