#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/run_folder.h>

#include <boost/iostreams/stream.hpp>
#include <boost/iostreams/tee.hpp>

#include <deal.II/base/mpi.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <regex>
#include <vector>

namespace kedge
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const mark = ".kedge";

    /** The files of a run, below its folder; what kedge may replace and remove. */
    bool
    is_output_of_kedge(const std::string &name)
    {
      static const std::regex names(
        "(history|probes|newton|transfer_audit)\\.csv|(points|grid)\\.pvd|points\\.xdmf|summary\\.json|"
        "parameters\\.prm|log\\.txt|"
        "(points/points|grid/grid)-[0-9]+(\\.[0-9]+)?\\.(vtu|pvtu|h5)|"
        "checkpoint/(state|unfinished)-[0-9]+/(manifest\\.txt|rank-[0-9]+\\.bin)");
      const bool temporary = fs::path(name).extension() == ".new";
      return std::regex_match(temporary ? name.substr(0, name.size() - 4) : name, names);
    }

    bool
    is_folder_of_kedge(const std::string &name)
    {
      static const std::regex names("points|grid|checkpoint|checkpoint/(state|unfinished)-[0-9]+");
      return std::regex_match(name, names);
    }

    /** Looks only into the folders that a run makes; links are not followed. */
    void
    find_output(const fs::path        &folder,
                const std::string     &below,
                std::vector<fs::path> &files,
                std::vector<fs::path> &folders)
    {
      for (const fs::directory_entry &entry : fs::directory_iterator(folder / below))
        {
          const std::string name = below.empty() ? entry.path().filename().string()
                                                 : below + "/" + entry.path().filename().string();
          if (fs::is_directory(entry.symlink_status()))
            {
              if (is_folder_of_kedge(name))
                {
                  find_output(folder, name, files, folders);
                  folders.push_back(entry.path());
                }
            }
          else if (is_output_of_kedge(name))
            files.push_back(entry.path());
        }
    }

    void
    make_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error || !fs::is_directory(folder))
        throw UserError("Cannot make the output folder '" + folder.string() +
                        "': " + (error ? error.message() : "a file of that name exists") +
                        ". Choose another one with --output.");
    }

    void
    begin_fresh_run(const fs::path &folder)
    {
      std::vector<fs::path> files, folders;
      find_output(folder, "", files, folders);
      if (!files.empty() && !fs::exists(folder / mark))
        throw UserError("The output folder '" + folder.string() + "' holds the file '" +
                        files.front().lexically_relative(folder).string() +
                        "', which no run of kedge has written and which this run would replace. "
                        "Move it away or choose another folder with --output.");

      write_file(folder / mark, "The output of a run of kedge; the next run may replace it.\n");
      for (const fs::path &file : files)
        fs::remove(file);
      std::error_code not_empty;
      for (const fs::path &subfolder : folders)
        fs::remove(subfolder, not_empty);
    }

    void
    open_folder(const fs::path &folder, const RunFolder::Mode mode)
    {
      if (mode == RunFolder::Mode::resume && !fs::exists(folder / mark))
        throw UserError("There is no run to resume in '" + folder.string() +
                        "'. Name its folder with --output or start afresh without --resume.");
      make_folder(folder);
      try
        {
          if (mode == RunFolder::Mode::fresh)
            begin_fresh_run(folder);
          else
            write_file(folder / mark, read_file(folder / mark));
        }
      catch (const fs::filesystem_error &error)
        {
          throw UserError("Cannot replace the earlier run in '" + folder.string() +
                          "': " + error.code().message() + ". Choose another one with --output.");
        }
    }
  } // namespace



  struct RunFolder::Log
  {
    using Tee = boost::iostreams::tee_device<std::ostream, std::ofstream>;

    Log(const fs::path &path, const bool append)
      : file(path, append ? std::ios::app : std::ios::trunc)
    {
      if (!file)
        throw UserError("Cannot write '" + path.string() + "': " + std::strerror(errno) + ".");
      stream.open(Tee(std::cout, file));
    }

    std::ofstream                 file;
    boost::iostreams::stream<Tee> stream;
  };



  RunFolder::RunFolder(const fs::path &folder_name, const Mode mode, const MPI_Comm communicator)
    : folder(folder_name.lexically_normal())
    , run_mode(mode)
    , mpi_communicator(communicator)
    , root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , silence(nullptr)
  {
    run_on_root(communicator, [&]() {
      open_folder(folder, mode);
      tee = std::make_unique<Log>(path("log.txt"), mode == Mode::resume);
    });
  }



  RunFolder::~RunFolder() = default;



  fs::path
  RunFolder::path(const std::string &name) const
  {
    return folder / name;
  }



  const fs::path &
  RunFolder::path() const
  {
    return folder;
  }



  RunFolder::Mode
  RunFolder::mode() const
  {
    return run_mode;
  }



  MPI_Comm
  RunFolder::communicator() const
  {
    return mpi_communicator;
  }



  bool
  RunFolder::is_root() const
  {
    return root;
  }



  std::ostream &
  RunFolder::log() const
  {
    return root ? static_cast<std::ostream &>(tee->stream) : silence;
  }



  fs::path
  RunFolder::make_subfolder(const std::string &name) const
  {
    run_on_root(mpi_communicator, [&]() {
      make_folder(path(name));
    });
    return path(name);
  }
} // namespace kedge
