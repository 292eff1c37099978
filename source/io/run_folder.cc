#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/run_folder.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
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
        "(history|probes|newton|transfer_audit)\\.csv|(points|grid|surfaces)\\.pvd|points\\.xdmf|summary\\.json|"
        "parameters\\.prm|log\\.txt|"
        "(points/points|grid/grid|surfaces/surfaces)-[0-9]+(\\.[0-9]+)?\\.(vtu|pvtu|h5)|"
        "checkpoint/(state|unfinished|cleared)-[0-9]+/(manifest\\.txt|rank-[0-9]+\\.bin)");
      const bool temporary = fs::path(name).extension() == ".new";
      return std::regex_match(temporary ? name.substr(0, name.size() - 4) : name, names);
    }

    bool
    is_folder_of_kedge(const std::string &name)
    {
      static const std::regex names(
        "points|grid|surfaces|checkpoint|checkpoint/(state|unfinished|cleared)-[0-9]+");
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

    /** Throws UserError if the folder holds files that look like a run's and are not. */
    void
    refuse_foreign_files(const fs::path &folder)
    {
      std::vector<fs::path> files, folders;
      find_output(folder, "", files, folders);
      if (!files.empty() && !fs::exists(folder / mark))
        throw UserError("The output folder '" + folder.string() + "' holds the file '" +
                        files.front().lexically_relative(folder).string() +
                        "', which no run of kedge has written and which this run would replace. "
                        "Move it away or choose another folder with --output.");
    }

    /** Folders of states whose names begin with @p prefix, newest first. */
    std::vector<fs::path>
    states_in(const fs::path &checkpoints, const std::string &prefix)
    {
      std::vector<fs::path> states;
      for (const fs::directory_entry &entry : fs::directory_iterator(checkpoints))
        if (entry.path().filename().string().rfind(prefix, 0) == 0 &&
            fs::is_directory(entry.symlink_status()))
          states.push_back(entry.path());
      std::sort(states.rbegin(), states.rend());
      return states;
    }

    /**
     * Makes the states of the earlier run, newest first, such that nobody resumes from
     * them: each by one renaming, so that a kill at any moment leaves a run that can be
     * resumed as a whole, or none.
     */
    void
    retire_states(const fs::path &checkpoints)
    {
      for (const fs::path &state : states_in(checkpoints, "state-"))
        {
          const fs::path retired = checkpoints / ("cleared-" + state.filename().string().substr(6));
          std::error_code error;
          fs::remove(retired, error); // one that is empty but for foreign files stays, and is said
          fs::rename(state, retired);
        }
    }

    /** Removes a run's files from a folder, and the folders that are then empty. */
    void
    remove_output(const fs::path &folder, const std::string &below)
    {
      if (!fs::is_directory(fs::symlink_status(folder / below)))
        return;
      std::vector<fs::path> files, folders;
      find_output(folder, below, files, folders);
      for (const fs::path &file : files)
        fs::remove(file);
      std::error_code not_empty;
      for (const fs::path &subfolder : folders)
        fs::remove(subfolder, not_empty);
    }

    /** Removes what an earlier run has left. */
    void
    clear(const fs::path &folder)
    {
      const fs::path checkpoints = folder / "checkpoint";
      if (fs::is_directory(fs::symlink_status(checkpoints)))
        {
          for (const fs::path &old : states_in(checkpoints, "cleared-"))
            remove_output(folder, "checkpoint/" + old.filename().string());
          retire_states(checkpoints);
        }
      remove_output(folder, "");
    }

    std::unique_ptr<FolderLock>
    open_folder(const fs::path &folder, const RunFolder::Mode mode)
    {
      std::error_code error;
      if (mode == RunFolder::Mode::resume && !fs::exists(folder / mark, error))
        throw UserError("There is no run to resume in '" + folder.string() +
                        "'. Name its folder with --output or start afresh without --resume.");
      make_folder(folder);
      try
        {
          if (mode == RunFolder::Mode::fresh)
            refuse_foreign_files(folder);
          auto lock = std::make_unique<FolderLock>(folder / mark);
          if (mode == RunFolder::Mode::fresh)
            clear(folder);
          return lock;
        }
      catch (const fs::filesystem_error &failure)
        {
          throw UserError("Cannot replace the earlier run in '" + folder.string() +
                          "': " + failure.code().message() + ". Choose another one with --output.");
        }
    }
  } // namespace



  RunFolder::RunFolder(const fs::path &folder_name, const Mode mode, const MPI_Comm communicator)
    : folder(folder_name.lexically_normal())
    , run_mode(mode)
    , mpi_communicator(communicator)
    , root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , silence(nullptr)
  {
    run_on_root(communicator, [&]() {
      lock   = open_folder(folder, mode);
      stream = std::make_unique<LogStream>(path("log.txt"), mode == Mode::resume);
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
    return root ? static_cast<std::ostream &>(*stream) : silence;
  }



  void
  RunFolder::check_log() const
  {
    run_on_root(mpi_communicator, [&]() {
      stream->check();
    });
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
