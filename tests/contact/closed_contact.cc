// What facets remember of a contact, as a checkpoint keeps it.
#include <kedge/base/exceptions.h>
#include <kedge/contact/closed_contact.h>

#include <gtest/gtest.h>

using namespace kedge;

/** Every value comes back; the numbers are arbitrary. */
TEST(ClosedContact, MemoryIsKeptByCheckpoints)
{
  ContactMemory<2>     memory;
  PartneredContact<2> &one = memory[7];
  one.gap                  = -0.25;
  one.multiplier           = 3.;
  one.slip[1]              = 0.5;
  one.partner              = 11;
  one.normal[0]            = -1.;
  one.lead                 = 0.125;
  memory[9].gap            = -1.;

  const ContactMemory<2> back = restored<2>(saved<2>(memory), ContactLaw(), false);
  ASSERT_EQ(back.size(), 2u);
  const PartneredContact<2> &same = back.at(7);
  EXPECT_EQ(same.gap, one.gap);
  EXPECT_EQ(same.multiplier, one.multiplier);
  EXPECT_EQ(same.slip, one.slip);
  EXPECT_EQ(same.partner, one.partner);
  EXPECT_EQ(same.normal, one.normal);
  EXPECT_EQ(same.lead, one.lead);
  EXPECT_EQ(back.at(9).gap, -1.);
  EXPECT_TRUE(restored<2>(saved<2>({}), ContactLaw(), false).empty());
}

/** Records without a width or of another one, as other versions of kedge have written them. */
TEST(ClosedContact, RecordsOfOtherVersionsAreRefused)
{
  const auto refused = [](const std::vector<double> &of_other_version) {
    try
      {
        restored<2>(of_other_version, ContactLaw(), false);
      }
    catch (const UserError &error)
      {
        return std::string(error.what()).find("written by another version of kedge") !=
               std::string::npos;
      }
    return false;
  };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused(std::vector<double>(8, 1.)));
  EXPECT_TRUE(refused(std::vector<double>(9, 1.)));
  EXPECT_TRUE(refused(std::vector<double>(10, 10.))); // one record's number, but of another width
  EXPECT_FALSE(refused(std::vector<double>(10, 9.)));
}
