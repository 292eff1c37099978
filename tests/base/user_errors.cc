#include <kedge/base/nearest_name.h>
#include <kedge/base/shortened.h>
#include <kedge/base/user_errors.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  std::string
  message_of(const UserErrors &errors)
  {
    try
      {
        errors.throw_if_any();
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "no error";
  }

  void
  fail(const std::string &text)
  {
    throw UserError(text);
  }
} // namespace

TEST(BaseUserErrors, OneStandsAlone)
{
  UserErrors errors;
  EXPECT_TRUE(errors.attempt([]() {}));
  EXPECT_EQ(message_of(errors), "no error");
  EXPECT_FALSE(errors.attempt([]() {
    fail("a is wrong");
  }));
  EXPECT_FALSE(errors.empty());
  EXPECT_EQ(message_of(errors), "a is wrong");
}

TEST(BaseUserErrors, SeveralStandInLinesTheFirstTenOfThem)
{
  UserErrors inner, outer;
  for (int i = 0; i < 7; ++i)
    inner.attempt([&]() {
      fail("e" + std::to_string(i));
    });
  for (int i = 0; i < 2; ++i) // those of an inner collection count one by one
    outer.attempt([&]() {
      inner.throw_if_any();
    });
  EXPECT_EQ(message_of(outer),
            "There are 14 errors.\ne0\ne1\ne2\ne3\ne4\ne5\ne6\ne0\ne1\ne2\n.. and 4 more.");
  EXPECT_ANY_THROW(outer.attempt([]() {
    throw std::runtime_error("not the user's");
  }));
}

TEST(BaseShortened, KeepsWholeCharacters)
{
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc .. (4 characters)");
  EXPECT_EQ(shortened("ab\xc3\xa4", 3), "ab .. (4 characters)"); // a letter of two bytes
}

TEST(BaseDidYouMean, OnlyNamesThatAreAlike)
{
  const std::vector<std::string> models = {"hencky", "von_mises", "mohr_coulomb"};
  EXPECT_EQ(did_you_mean("mohr_coulomn", models), " Did you mean 'mohr_coulomb'?");
  EXPECT_EQ(did_you_mean("Mohr-Coulomb", models), " Did you mean 'mohr_coulomb'?");
  EXPECT_EQ(did_you_mean("mises", models), " Did you mean 'von_mises'?"); // one of its words
  EXPECT_EQ(did_you_mean("neo_hooke", models), "");
  EXPECT_EQ(did_you_mean("mohr_coulomb", {"hencky"}), "");
  EXPECT_EQ(did_you_mean("up", {"left", "top"}), " Did you mean 'top'?");
  EXPECT_EQ(did_you_mean("a", {}), "");
  EXPECT_EQ(did_you_mean(std::string(100000, 'a'), models), "");
}
