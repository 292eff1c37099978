#include <kedge/base/exceptions.h>
#include <kedge/base/expression.h>
#include <kedge/base/nearest_name.h>

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

using namespace kedge;

namespace
{
  std::string
  message_of(const std::string &text)
  {
    try
      {
        Expression(text, {"t"}, {{"L", 2.}});
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(BaseExpression, KnowsVariablesConstantsAndPi)
{
  const Expression f("L*cos(pi*x) + y*z", {"x", "y", "z"}, {{"L", 2.}});
  // 2 cos(pi) + 3*4 = 10; one rounding per operation
  EXPECT_NEAR(f({1., 3., 4.}), 10., 1e-14);
  const double values[] = {0., 1., 1.};
  EXPECT_NEAR(f(values), 3., 1e-15);
  EXPECT_FALSE(f.is_constant());
  EXPECT_EQ(f.text(), "L*cos(pi*x) + y*z");
}

TEST(BaseExpression, PlainNumbersAndFormulasOfConstantsAreConstant)
{
  // decimal texts read exactly as the compiler reads them
  EXPECT_TRUE(Expression("-1.5e3", {"t"}, {}).is_constant());
  EXPECT_EQ(Expression("-1.5e3", {"t"}, {}).value(), -1.5e3);
  EXPECT_EQ(Expression(" .25 ", {"t"}, {}).value(), .25);
  EXPECT_EQ(Expression("+3", {"t"}, {}).value(), 3.);
  const Expression f("3*L^2", {"t"}, {{"L", 2.}});
  EXPECT_TRUE(f.is_constant());
  EXPECT_EQ(f.value(), 12.); // small whole numbers are exact
  EXPECT_EQ(f({7.}), 12.);
  EXPECT_EQ(Expression(4.5).value(), 4.5);
  EXPECT_EQ(Expression().value(), 0.);
}

TEST(BaseExpression, OffersDealiisFunctionsAndLogic)
{
  const auto value = [](const std::string &text) {
    return evaluate_constant(text, {});
  };
  // values by hand; the functions are those of the C library
  EXPECT_EQ(value("if(1 > 2, 3, 4)"), 4.);
  EXPECT_EQ(value("2 > 1 ? 3 : 4"), 3.);
  EXPECT_EQ(value("floor(-1.5) + ceil(1.2)"), 0.);
  EXPECT_EQ(value("pow(2, 10)"), 1024.);
  EXPECT_EQ(value("mod(7, 4)"), 3.);
  EXPECT_EQ(value("log(1) + erf(0)"), 0.);
  EXPECT_EQ(value("1 == 1 && 2 >= 2 && 1 != 2 && 1 <= 2"), 1.);
}

TEST(BaseExpression, ErrorsNameExpressionAndCause)
{
  EXPECT_NE(message_of("2*q").find("'2*q'"), std::string::npos);
  EXPECT_NE(message_of("2*q").find("\"q\""), std::string::npos);
  EXPECT_NE(message_of("2*q").find("t, L, pi"), std::string::npos);
  EXPECT_NE(message_of("(1 + t"), "");
  EXPECT_NE(message_of("1, t").find("more than one value"), std::string::npos);
  EXPECT_NE(message_of("t = 1").find("=="), std::string::npos);
  EXPECT_NE(message_of("  ").find("empty"), std::string::npos);
  EXPECT_NE(message_of("1/0").find("finite"), std::string::npos);
  EXPECT_NE(message_of("inf"), "");
  EXPECT_EQ(message_of("t <= 1 && t != L"), "");
}

TEST(BaseExpression, CopiesShareNothingThatOneThreadCouldSpoil)
{
  const Expression      f("sin(t)*t", {"t"}, {});
  const Expression      copy = f;
  std::array<double, 4> sums = {};
  constexpr int         n    = 20000;

  std::vector<std::thread> threads;
  for (unsigned int i = 0; i < sums.size(); ++i)
    threads.emplace_back([&, i]() {
      const Expression &mine = i % 2 == 0 ? f : copy;
      for (int k = 0; k < n; ++k)
        sums[i] += mine({i + 1e-3 * k});
    });
  for (std::thread &thread : threads)
    thread.join();
  for (unsigned int i = 0; i < sums.size(); ++i)
    {
      double expected = 0;
      for (int k = 0; k < n; ++k)
        expected += std::sin(i + 1e-3 * k) * (i + 1e-3 * k);
      // same operations in the same order; only the compiler may fuse some
      EXPECT_NEAR(sums[i], expected, 1e-9 * n);
    }
}

TEST(BaseExpression, ListsAreSplitOutsideParenthesesOnly)
{
  EXPECT_EQ(split_list("max(1, 2), 3; f(4; 5)"),
            (std::vector<std::string>{"max(1, 2)", "3", "f(4; 5)"}));
  EXPECT_EQ(split_list("1,,2"), (std::vector<std::string>{"1", "", "2"}));
  EXPECT_TRUE(split_list("  ").empty());
}

TEST(BaseNearestName, FindsTheSmallestEditDistance)
{
  // distances by hand: swap 1, case 0, missing letter 1
  EXPECT_EQ(nearest_name("Densiyt", {"Dense", "Density", "Model"}), "Density");
  EXPECT_EQ(nearest_name("cells", {"Origin", "Cells"}), "Cells");
  EXPECT_EQ(nearest_name("gmp", {"linear", "gimp"}), "gimp");
  EXPECT_EQ(nearest_name("any", {}), "");
}
