#include "scratch_folder.h"

#include <kedge/io/files.h>
#include <kedge/io/json.h>
#include <kedge/io/summary.h>
#include <kedge/io/versions.h>

#include <boost/property_tree/json_parser.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

using namespace kedge;

TEST(IoJson, TextIsValidAndExact)
{
  JsonWriter json;
  json.open("", '{');
  json.add("text", "a \"quoted\" \\ line\nend\t.");
  json.add("number", 1. / 3.);
  json.add("count", std::uint64_t(18446744073709551615u));
  json.add("missing", std::numeric_limits<double>::quiet_NaN());
  json.add("yes", true);
  json.open("empty", '[');
  json.close();
  json.open("list", '[');
  json.add("", 1.);
  json.add("", -1e-300);
  json.close();
  json.close();
  // Written out by hand from the JSON grammar (RFC 8259).
  EXPECT_EQ(json.text(),
            "{\n"
            "  \"text\": \"a \\\"quoted\\\" \\\\ line\\nend\\u0009.\",\n"
            "  \"number\": 0.3333333333333333,\n"
            "  \"count\": 18446744073709551615,\n"
            "  \"missing\": null,\n"
            "  \"yes\": true,\n"
            "  \"empty\": [],\n"
            "  \"list\": [\n"
            "    1,\n"
            "    -1e-300\n"
            "  ]\n"
            "}");
}

TEST(IoSummaryMpi, AParserReadsItBack)
{
  RunSummary summary;
  summary.versions                       = software_versions();
  summary.scene                          = "column";
  summary.title                          = "a \"title\"";
  summary.status                         = "finished";
  summary.dim                            = 3;
  summary.n_steps                        = 12;
  summary.bodies                         = {"upper layer", "lower layer"};
  summary.counts["n_points"]             = 400;
  summary.phase_wall_seconds["transfer"] = 0.25;
  summary.peak_memory_bytes              = peak_memory(MPI_COMM_WORLD);
  summary.cpu_seconds                    = cpu_seconds(MPI_COMM_WORLD);
  summary.columns                        = {{"total_energy", "J", Ledger::Section::work, false},
                                            {"angular_momentum_x", "kg m^2/s", Ledger::Section::momentum, false},
                                            {"angular_momentum_y", "kg m^2/s", Ledger::Section::momentum, false},
                                            {"angular_momentum_z", "kg m^2/s", Ledger::Section::momentum, false}};
  summary.final_row.books                = {3., 0., 5., 0.};
  summary.checks                         = {{"tip", 1.5, 1.4, 0.1, true, true, "book", ""},
                                            {"gone", std::nan(""), 1, 0, true, false, "", "no rows"}};

  const test::ScratchFolder scratch;
  const RunFolder           run(scratch.path(), RunFolder::Mode::fresh, MPI_COMM_WORLD);
  write_summary(run, summary);
  MPI_Barrier(MPI_COMM_WORLD);

  boost::property_tree::ptree tree;
  boost::property_tree::read_json((scratch / "summary.json").string(), tree);
  EXPECT_EQ(tree.get<std::string>("title"), "a \"title\"");
  EXPECT_EQ(tree.get<int>("steps"), 12);
  EXPECT_EQ(tree.get_child("bodies").size(), 2u);
  EXPECT_EQ(tree.get_child("bodies").front().second.data(), "upper layer"); // number 0
  EXPECT_EQ(tree.get<int>("counts.n_points"), 400);
  EXPECT_EQ(tree.get<double>("phase_wall_seconds.transfer"), 0.25);
  EXPECT_EQ(tree.get<double>("final.total_energy"), 3);
  EXPECT_EQ(tree.get_child("final.angular_momentum").size(), 3u);
  EXPECT_EQ(tree.get<std::string>("point_updates_per_second"), "null"); // never set
  const auto &checks = tree.get_child("checks");
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks.front().second.get<double>("value"), 1.5);
  EXPECT_TRUE(checks.front().second.get<bool>("pass"));
  EXPECT_EQ(checks.back().second.get<std::string>("value"), "null");
  EXPECT_EQ(checks.back().second.get<std::string>("remark"), "no rows");
  // deal.II 9.4 is what CMake demands; a process uses some megabytes and some time.
  EXPECT_EQ(tree.get_child("versions").size(), 6u);
  EXPECT_GT(tree.get<double>("peak_memory_bytes"), 1e6);
  EXPECT_GT(tree.get<double>("cpu_seconds"), 0.);
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(IoVersions, AllAreKnown)
{
  for (const auto &[name, version] : software_versions())
    {
      EXPECT_FALSE(version.empty()) << name;
      EXPECT_NE(version, "unknown") << name;
    }
}
