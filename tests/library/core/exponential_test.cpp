// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/exponential.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>

namespace flagstone {
namespace {

double relative_error(double x) {
  // In extended precision, to exclude the rounding of std::exp.
  const long double exact = std::exp(static_cast<long double>(x));
  return static_cast<double>(std::abs((static_cast<long double>(exponential(x)) - exact) / exact));
}

TEST(Exponential, IsWithin1e15OfTheStandardLibraryFromMinus700To700) {
  double worst = 0;
  double worst_at = 0;
  for (int i = -700'000; i <= 700'000; ++i) {
    const double x = i * 1e-3;
    if (const double error = relative_error(x); error > worst) {
      worst = error;
      worst_at = x;
    }
  }

  EXPECT_LT(worst, 1e-15) << "at " << worst_at;
}

TEST(Exponential, IsWithin1e15OfTheStandardLibraryWhereTheExponentChanges) {
  // (k + 1/2) ln 2 and its neighbours give the largest argument of the series.
  for (int k = -1009; k <= 1009; ++k) {
    const double middle = (k + 0.5) * 0.6931471805599453;
    for (const double x : {std::nextafter(middle, -1e3), middle, std::nextafter(middle, 1e3)}) {
      ASSERT_LT(relative_error(x), 1e-15) << "at " << x;
    }
  }
}

TEST(Exponential, OfZeroIsOne) {
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
}

TEST(Exponential, OfTinyNumbersIsOneUpToRounding) {
  for (const double x : {1e-300, -1e-300, 1e-17, -1e-17, 4.9e-324}) {
    EXPECT_NEAR(exponential(x), 1.0, 1e-15);
  }
}

TEST(Exponential, IsConstantBeyond700) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {700.001, 1e4, 1e300, infinity}) {
    EXPECT_EQ(exponential(x), exponential(700));
    EXPECT_EQ(exponential(-x), exponential(-700));
  }
  EXPECT_TRUE(std::isnormal(exponential(700)));
  EXPECT_TRUE(std::isnormal(exponential(-700)));
}

TEST(Exponential, IsMonotonic) {
  EXPECT_TRUE(rc::check([] {
    // A step of 1e-9 is about a million times the rounding error.
    const double x = *rc::gen::inRange(-700'000'000, 700'000'000) * 1e-6;
    RC_ASSERT(exponential(x + 1e-9) > exponential(x));
  }));
}

}  // namespace
}  // namespace flagstone
