#include <kedge/base/exceptions.h>
#include <kedge/io/checkpoint.h>
#include <kedge/io/checkpoint_format.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace kedge
{
  namespace fs = std::filesystem;

  namespace
  {
    std::string
    state_name(const std::uint64_t number)
    {
      return "state-" + dealii::Utilities::to_string(number, 6);
    }

    std::string
    unfinished_name(const std::uint64_t number)
    {
      return "unfinished-" + dealii::Utilities::to_string(number, 6);
    }

    std::string
    rank_file(const unsigned int rank)
    {
      return "rank-" + dealii::Utilities::to_string(rank, 4) + ".bin";
    }

    /** The number in `state-NNNNNN`; none for other names. */
    std::optional<std::uint64_t>
    number_of(const std::string &name, const std::string &prefix)
    {
      if (name.compare(0, prefix.size(), prefix) != 0)
        return {};
      std::uint64_t number = 0;
      const char   *end    = name.data() + name.size();
      const auto    result = std::from_chars(name.data() + prefix.size(), end, number);
      return result.ptr == end && result.ec == std::errc() ? std::optional(number) : std::nullopt;
    }

    /** Numbers of the states that stand in the folder, newest first. */
    std::vector<std::uint64_t>
    numbers_in(const fs::path &location, const std::string &prefix)
    {
      std::vector<std::uint64_t> numbers;
      std::error_code            none;
      for (const fs::directory_entry &entry : fs::directory_iterator(location, none))
        if (const auto number = number_of(entry.path().filename().string(), prefix))
          numbers.push_back(*number);
      std::sort(numbers.rbegin(), numbers.rend());
      return numbers;
    }

    /** Removes the files of a state and its folder; leaves what is not kedge's. */
    void
    remove_state(const fs::path &state)
    {
      std::error_code       ignored;
      std::vector<fs::path> files = {state / "manifest.txt"};
      for (const fs::directory_entry &entry : fs::directory_iterator(state, ignored))
        {
          const std::string name = entry.path().filename().string();
          if (name.compare(0, 5, "rank-") == 0 && entry.path().extension() == ".bin")
            files.push_back(entry.path());
        }
      for (const fs::path &file : files) // the manifest first: what lacks it is not whole
        fs::remove(file, ignored);
      fs::remove(state, ignored);
    }

    const char *const remedy_afresh = " Start the run afresh without --resume.";

    /** Throws UserError if the checkpoint is one of another run. */
    void
    check_manifest(const CheckpointManifest &manifest,
                   const fs::path           &state,
                   const unsigned int        dim,
                   const unsigned int        n_state_values)
    {
      const std::string begin = "The checkpoint '" + state.string() + "' ";
      if (manifest.dim != dim)
        throw UserError(begin + "is of a run in " + std::to_string(manifest.dim) +
                        "D, the scene is in " + std::to_string(dim) + "D: it belongs to another " +
                        "scene. Name the right output folder, or start afresh without --resume.");
      if (manifest.n_state_values != n_state_values)
        throw UserError(begin + "was written by another version of kedge, whose material points " +
                        "hold other values. Resume with that version, or start afresh without " +
                        "--resume.");
    }

    /** Throws UserError if the scene has changed since. */
    void
    check_settings(const SceneSettings &then, const SceneSettings &now, const fs::path &state)
    {
      const std::string changes = forbidden_changes(then, now);
      if (!changes.empty())
        throw UserError("The checkpoint '" + state.string() + "' belongs to another scene: " +
                        changes + ". Resume with the scene and the settings with which the run " +
                        "began, or start afresh without --resume.");
    }

    /** Why the content is not what the manifest says; empty if it is. */
    std::string
    damage_of(const std::string &content, const CheckpointManifest::File &file)
    {
      if (content.size() != file.n_bytes)
        return "has " + std::to_string(content.size()) + " bytes instead of " +
               std::to_string(file.n_bytes);
      return crc32_of(content) == file.crc ? "" : "has a wrong checksum";
    }

    /** Reads the file of a rank into @p data. Returns the damage; empty if there is none. */
    template <int dim>
    std::string
    read_rank(const fs::path           &state,
              const CheckpointManifest &manifest,
              const unsigned int        of_rank,
              CheckpointData<dim>      &data)
    {
      try
        {
          const std::string content = read_file(state / rank_file(of_rank));
          const std::string damage  = damage_of(content, manifest.files[of_rank]);
          if (!damage.empty())
            return rank_file(of_rank) + ' ' + damage;
          data = unpack_checkpoint<dim>(content);
        }
      catch (const std::runtime_error &error)
        {
          return error.what();
        }
      return "";
    }

    /** The first text of all ranks that is not empty. Collective. */
    std::string
    first_text(const std::string &text, const MPI_Comm communicator)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
      const unsigned int first =
        dealii::Utilities::MPI::min(text.empty() ? n_ranks : rank, communicator);
      return first == n_ranks ? "" : dealii::Utilities::MPI::broadcast(communicator, text, first);
    }

    /**
     * Reads this rank's part into @p data. Of a state that was written by another number
     * of ranks each takes every n-th file's points. Returns the damage, throws UserError for a
     * foreign state.
     */
    template <int dim>
    std::string
    read_state(const fs::path      &state,
               const SceneSettings &settings,
               const MPI_Comm       communicator,
               CheckpointData<dim> &data)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
      CheckpointManifest manifest;
      try
        {
          manifest = CheckpointManifest::parse(read_file(state / "manifest.txt"));
        }
      catch (const std::runtime_error &error)
        {
          return error.what();
        }
      check_manifest(manifest, state, dim, n_state_values<dim>);
      const auto n_files = static_cast<unsigned int>(manifest.files.size());
      if (n_files == 0)
        return "it has no files";
      // what is not of the points is the same in all files, but for positions in tables: rank 0's
      std::string damage = read_rank(state, manifest, n_files == n_ranks ? rank : 0, data);
      if (n_files != n_ranks)
        {
          if (rank > 0)
            data.points.clear();
          for (unsigned int file = rank > 0 ? rank : n_ranks; file < n_files && damage.empty();
               file += n_ranks)
            {
              CheckpointData<dim> more;
              damage = read_rank(state, manifest, file, more);
              data.points.insert(data.points.end(), more.points.begin(), more.points.end());
            }
        }
      if (damage.empty())
        check_settings(data.settings, settings, state);
      data.n_ranks = n_files;
      return damage;
    }
  } // namespace



  template <int dim>
  CheckpointStore<dim>::CheckpointStore(const RunFolder &folder)
    : folder(folder)
    , location(folder.make_subfolder("checkpoint"))
  {
    const std::vector<std::uint64_t> numbers = numbers_in(location, "state-");
    if (!numbers.empty())
      next = numbers.front() + 1;
    next = dealii::Utilities::MPI::max(next, folder.communicator());
  }



  template <int dim>
  void
  CheckpointStore<dim>::write(const CheckpointData<dim> &data)
  {
    const MPI_Comm     communicator = folder.communicator();
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const fs::path     unfinished   = location / unfinished_name(next);

    run_on_root(communicator, [&]() {
      for (const std::uint64_t number : numbers_in(location, "unfinished-"))
        remove_state(location / unfinished_name(number));
      std::error_code error;
      fs::create_directories(unfinished, error);
      if (error)
        throw UserError("Cannot make '" + unfinished.string() + "': " + error.message() + '.');
    });

    CheckpointManifest::File file;
    run_on_all(communicator, [&]() {
      const std::string content = pack_checkpoint(data);
      file                      = {content.size(), crc32_of(content)};
      write_file(unfinished / rank_file(rank), content);
      flush_to_disk(unfinished / rank_file(rank));
    });
    const auto files = dealii::Utilities::MPI::gather(communicator, file);

    run_on_root(communicator, [&]() {
      const CheckpointManifest manifest{dim, n_state_values<dim>, files};
      replace_file(unfinished / "manifest.txt", manifest.text());
      std::error_code error;
      fs::rename(unfinished, location / state_name(next), error);
      if (error)
        throw UserError("Cannot rename '" + unfinished.string() + "': " + error.message() + '.');
      flush_to_disk(location);
      remove_old(next);
    });
    last_good = next++;
  }



  template <int dim>
  void
  CheckpointStore<dim>::remove_old(const std::uint64_t newest) const
  {
    for (const std::uint64_t number : numbers_in(location, "state-"))
      if (number != newest && number != last_good)
        remove_state(location / state_name(number));
  }



  template <int dim>
  CheckpointData<dim>
  CheckpointStore<dim>::read_latest(const SceneSettings &settings)
  {
    const MPI_Comm                   communicator = folder.communicator();
    const std::vector<std::uint64_t> numbers =
      dealii::Utilities::MPI::broadcast(communicator,
                                        folder.is_root() ? numbers_in(location, "state-")
                                                         : std::vector<std::uint64_t>());
    if (numbers.empty())
      throw UserError("There is no checkpoint in '" + location.string() + "' to resume from: " +
                      (numbers_in(location, "cleared-").empty()
                         ? "the run ended before its first one."
                         : "a later run was stopped while it replaced this one.") +
                      remedy_afresh);

    std::string damages;
    for (const std::uint64_t number : numbers)
      {
        const fs::path      state = location / state_name(number);
        CheckpointData<dim> data;
        std::string         damage;
        run_on_all(communicator, [&]() {
          damage = read_state(state, settings, communicator, data);
        });
        damage = first_text(damage, communicator);
        if (damage.empty())
          {
            folder.log() << damages << "Resuming from the checkpoint " << state.string() << '.'
                         << std::endl;
            last_good = number;
            return data;
          }
        damages += "The checkpoint " + state.string() + " is damaged: " + damage + ".\n";
      }
    throw UserError(damages + "No whole checkpoint is left." + remedy_afresh);
  }



  template class CheckpointStore<2>;
  template class CheckpointStore<3>;
} // namespace kedge
