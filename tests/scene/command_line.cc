#include <kedge/base/exceptions.h>
#include <kedge/scene/command_line.h>

#include <gtest/gtest.h>

using namespace kedge;

namespace
{
  CommandLine
  parse(const std::vector<std::string> &arguments)
  {
    std::vector<const char *> argv = {"kedge"};
    for (const std::string &argument : arguments)
      argv.push_back(argument.c_str());
    return parse_command_line(static_cast<int>(argv.size()), argv.data());
  }

  std::string
  message_of(const std::vector<std::string> &arguments)
  {
    try
      {
        parse(arguments);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace

TEST(SceneCommandLine, ReadsAllOptionsInAnyOrder)
{
  const CommandLine command = parse({"-o",
                                     "out",
                                     "--set",
                                     "Time/End = 2",
                                     "beam.prm",
                                     "-s",
                                     "Bodies/beam/Basis = linear",
                                     "--resume",
                                     "--validate",
                                     "--strict",
                                     "--threads=3"});
  EXPECT_EQ(command.scene, "beam.prm");
  EXPECT_EQ(command.output, "out");
  EXPECT_EQ(command.settings,
            (std::vector<std::string>{"Time/End = 2", "Bodies/beam/Basis = linear"}));
  EXPECT_TRUE(command.resume && command.validate && command.strict);
  EXPECT_EQ(command.n_threads, 3u);
  EXPECT_FALSE(command.help || command.version || command.print_parameters);
}

TEST(SceneCommandLine, DefaultsAreOff)
{
  const CommandLine command = parse({"-"});
  EXPECT_EQ(command.scene, "-");
  EXPECT_EQ(command.output, "");
  EXPECT_FALSE(command.n_threads.has_value());
  EXPECT_FALSE(command.resume || command.validate || command.strict);
}

TEST(SceneCommandLine, ValuesMayHoldEqualsSignsAndBeginWithADash)
{
  EXPECT_EQ(parse({"a.prm", "--set=Time/End = 2"}).settings[0], "Time/End = 2");
  EXPECT_EQ(parse({"a.prm", "-s", "-odd = 1"}).settings[0], "-odd = 1");
}

TEST(SceneCommandLine, SomeOptionsNeedNoScene)
{
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_TRUE(parse({"--version"}).version);
  EXPECT_TRUE(parse({"--print-parameters"}).print_parameters);
  EXPECT_EQ(parse({"--print-parameters", "Time"}).scene, "Time");
  EXPECT_NE(message_of({}).find("kedge SCENE.prm"), std::string::npos);
  EXPECT_NE(message_of({"--strict"}).find("kedge SCENE.prm"), std::string::npos);
}

TEST(SceneCommandLine, ErrorsNameTheNearestOption)
{
  EXPECT_NE(message_of({"a.prm", "--outptu", "x"}).find("Did you mean '--output'?"),
            std::string::npos);
  EXPECT_NE(message_of({"a.prm", "--valdate"}).find("'--validate'?"), std::string::npos);
  EXPECT_NE(message_of({"a.prm", "-o"}).find("-o DIR"), std::string::npos);
  EXPECT_NE(message_of({"a.prm", "--output="}).find("empty"), std::string::npos);
  EXPECT_NE(message_of({"a.prm", "--strict=1"}).find("no value"), std::string::npos);
  for (const char *wrong : {"0", "-1", "two", "2.5", "3x"})
    EXPECT_NE(message_of({"a.prm", "--threads", wrong}).find(wrong), std::string::npos);
  EXPECT_NE(message_of({"a.prm", "b.prm"}).find("'a.prm' and 'b.prm'"), std::string::npos);
}

TEST(SceneCommandLine, HelpNamesEveryPromisedOption)
{
  for (const char *option : {"-o, --output",
                             "-s, --set",
                             "--resume",
                             "--validate",
                             "--strict",
                             "--threads",
                             "--print-parameters",
                             "--version",
                             "--help"})
    EXPECT_NE(help_text().find(option), std::string::npos) << option;
}
