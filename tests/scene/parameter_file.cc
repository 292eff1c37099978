#include <kedge/base/exceptions.h>
#include <kedge/scene/parameter_file.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace kedge;

namespace
{
  ParameterFile
  read(const std::string &text)
  {
    std::istringstream input(text);
    return ParameterFile::read(input, "folder/beam.prm");
  }

  std::string
  message_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }

  std::string
  message_of(const std::string &text)
  {
    return message_of([&]() {
      read(text);
    });
  }

  /** A folder of all ranks that goes when the test ends. */
  class Folder
  {
  public:
    Folder()
      : path(std::filesystem::temp_directory_path() /
             ("kedge_parameter_file_" +
              std::to_string(dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, ::getpid()))))
    {
      if (is_first)
        std::filesystem::create_directories(path / "parts");
    }

    ~Folder()
    {
      if (is_first)
        std::filesystem::remove_all(path);
    }

    std::string
    write(const std::string &name, const std::string &text) const
    {
      if (is_first)
        std::ofstream(path / name) << text;
      return (path / name).string();
    }

  private:
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  public:
    const std::filesystem::path path;
  };
} // namespace

TEST(SceneParameterFile, KeepsSectionValueAndLineOfEachEntry)
{
  const ParameterFile file = read("# a comment\n"
                                  "set  Title =  A  beam # and more\n"
                                  "subsection Bodies\n"
                                  "  subsection  the   beam\n"
                                  "    set Geometry = box(0, 0; \\\n"
                                  "                       1, 1)\n"
                                  "    set Empty =\n"
                                  "  end\n"
                                  "end\n"
                                  "SET Last = a = b");
  ASSERT_EQ(file.entries.size(), 4u);
  EXPECT_EQ(file.entries[0].name, "Title");
  EXPECT_EQ(file.entries[0].value, "A  beam");
  EXPECT_EQ(file.entries[1].section, (std::vector<std::string>{"Bodies", "the beam"}));
  EXPECT_EQ(file.entries[1].value, "box(0, 0; 1, 1)");
  EXPECT_EQ(file.entries[1].origin.describe(), "folder/beam.prm:5");
  EXPECT_EQ(file.entries[2].value, "");
  EXPECT_EQ(file.entries[2].origin.line, 7u);
  EXPECT_EQ(file.entries[3].value, "a = b");
  ASSERT_EQ(file.sections.size(), 2u);
  EXPECT_EQ(file.sections[1].origin.line, 4u);
  EXPECT_EQ(file.scene_name(), "beam");
}

TEST(SceneParameterFile, ErrorsNameFileAndLine)
{
  EXPECT_NE(message_of("set A = 1\nfoo\n").find("folder/beam.prm:2: 'foo'"), std::string::npos);
  EXPECT_NE(message_of("set A\n").find(":1: 'set A'"), std::string::npos);
  EXPECT_NE(message_of("set = 1\n").find(":1: 'set = 1'"), std::string::npos);
  EXPECT_NE(message_of("end\n").find(":1: 'end'"), std::string::npos);
  EXPECT_NE(message_of("subsection\n").find(":1:"), std::string::npos);
  EXPECT_NE(message_of("\nsubsection A\nset B = 1").find(":2: subsection A is not closed"),
            std::string::npos);
}

TEST(SceneParameterFile, TheSameEntryTwiceInAFileIsAnError)
{
  const std::string message = message_of("subsection S\nset A = 1\nend\n"
                                         "subsection S\nset A = 1\nend\n");
  EXPECT_NE(message.find("folder/beam.prm:5: S/A is set a second time; line 2"), std::string::npos)
    << message;
  EXPECT_EQ(message_of("subsection S\nset A = 1\nend\nset A = 1\n"), "");
}

TEST(SceneParameterFile, IncludesAreSearchedBesideTheFileAndOverridden)
{
  const Folder folder;
  folder.write("parts/inner.prm", "set A = inner\nset B = inner\n");
  folder.write("parts/outer.prm", "include inner.prm\nset C = outer\n");
  const std::string name = folder.write("main.prm",
                                        "subsection S\n"
                                        "  include parts/outer.prm\n"
                                        "  set B = main\n"
                                        "end\n");

  const ParameterFile file = ParameterFile::read(name, MPI_COMM_WORLD);
  ASSERT_EQ(file.entries.size(), 3u);
  EXPECT_EQ(file.entries[0].value, "inner");
  EXPECT_EQ(file.entries[0].section, (std::vector<std::string>{"S"}));
  EXPECT_EQ(file.entries[0].origin.describe(), (folder.path / "parts/inner.prm:1").string());
  EXPECT_EQ(file.entries[1].value, "main");
  EXPECT_EQ(file.entries[2].value, "outer");
  EXPECT_EQ(file.scene_name(), "main");
}

TEST(SceneParameterFile, BadFilesAreNamed)
{
  const Folder      folder;
  const std::string circle  = folder.write("circle.prm", "include parts/../circle.prm\n");
  const std::string missing = folder.write("missing.prm", "\ninclude none.prm\n");
  const auto        message = [](const std::string &name) {
    return message_of([&]() {
      ParameterFile::read(name, MPI_COMM_WORLD);
    });
  };
  EXPECT_NE(message(circle).find("circle.prm:1: the file 'parts/../circle.prm' includes itself"),
            std::string::npos);
  EXPECT_NE(message(missing).find("missing.prm:2: the included file"), std::string::npos);
  EXPECT_NE(message((folder.path / "none.prm").string()).find("No such file"), std::string::npos);
  EXPECT_NE(message(folder.path.string()).find("is a folder"), std::string::npos);
}

TEST(SceneParameterFile, OptionsWinOverTheFileAndAddToIt)
{
  ParameterFile file = read("subsection Bodies\nsubsection beam\nset Basis = gimp\nend\nend\n");
  file.set("Bodies/beam/Basis=linear");
  file.set("Bodies / beam / Points per cell = 2, 3");
  file.set("Title = two = 2");
  ASSERT_EQ(file.entries.size(), 3u);
  EXPECT_EQ(file.entries[0].value, "linear");
  EXPECT_EQ(file.entries[0].origin.describe(), "option --set");
  EXPECT_EQ(file.entries[1].section, (std::vector<std::string>{"Bodies", "beam"}));
  EXPECT_EQ(file.entries[1].name, "Points per cell");
  EXPECT_EQ(file.entries[2].value, "two = 2");
  EXPECT_TRUE(file.entries[2].section.empty());
  EXPECT_NE(message_of([&]() {
              file.set("Title");
            }).find("'Title'"),
            std::string::npos);
  EXPECT_NE(message_of([&]() {
              file.set("= 3");
            }),
            "");
}

TEST(SceneParameterFile, PrintsWhatItReads)
{
  ParameterFile file = read("set Title = a\nsubsection Bodies\nsubsection beam\nset Basis = gimp\n"
                            "end\nend\nsubsection Output\nend\n");
  file.set({"Bodies", "ball"}, " Points  per cell", "2 ", {"made by hand", 0});
  file.set({"Bodies", "beam"}, "Basis", "linear", {"made by hand", 0});
  file.set({}, "Dimension", "2", {"made by hand", 0});
  EXPECT_EQ(file.entries[1].origin.describe(), "made by hand");
  std::ostringstream out;
  file.print(out);
  EXPECT_EQ(out.str(),
            "set Title = a\nset Dimension = 2\nsubsection Bodies\n  subsection beam\n"
            "    set Basis = linear\n  end\n  subsection ball\n    set Points per cell = 2\n"
            "  end\nend\nsubsection Output\nend\n");
  std::ostringstream again;
  read(out.str()).print(again);
  EXPECT_EQ(again.str(), out.str());
}
