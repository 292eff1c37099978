#include <kedge/base/exceptions.h>
#include <kedge/base/process.h>
#include <kedge/base/shortened.h>
#include <kedge/base/single_process.h>
#include <kedge/io/versions.h>
#include <kedge/scene/command_line.h>
#include <kedge/scene/print_parameters.h>
#include <kedge/simulation/session.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>

namespace kedge
{
  namespace
  {
    /** Of the processes that mpirun starts only one speaks; known before MPI is. */
    bool
    is_first_process()
    {
      for (const char *name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (const char *rank = std::getenv(name))
          return std::strcmp(rank, "0") == 0;
      return true;
    }

    std::filesystem::path
    output_folder(const CommandLine &command, const std::string &scene_name)
    {
      return command.output.empty() ? std::filesystem::path("output") / scene_name
                                    : std::filesystem::path(command.output);
    }

    /** A word as a shell reads it. */
    std::string
    quoted(const std::string &word)
    {
      const std::string harmless = "_-+./:,@%=";
      const bool        simple   = std::all_of(word.begin(), word.end(), [&](const char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) ||
               harmless.find(letter) != std::string::npos;
      });
      if (simple && !word.empty())
        return word;
      std::string result = "'";
      for (const char letter : word)
        result += letter == '\'' ? "'\\''" : std::string(1, letter);
      return result + "'";
    }

    /** The command line that goes on with a run; the script kedge says how it was called. */
    std::string
    resume_command(const CommandLine &command)
    {
      if (command.scene == "-")
        return "";
      const auto  n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const char *script  = n_ranks == 1 ? std::getenv("KEDGE_COMMAND") : nullptr;
      std::string line =
        n_ranks > 1 ? "mpirun -np " + std::to_string(n_ranks) + " " : std::string();
      for (std::size_t i = 0; i < command.arguments.size(); ++i)
        line += quoted(i == 0 && script != nullptr ? script : command.arguments[i]) + " ";
      return line + (command.resume ? "" : "--resume");
    }

    ExitCode
    run(const CommandLine &command, const ParameterFile &file)
    {
      if (command.validate)
        {
          validate(file, std::cout, MPI_COMM_WORLD);
          return ExitCode::finished;
        }
      RunOptions options;
      options.output         = output_folder(command, file.scene_name());
      options.resume         = command.resume;
      options.strict         = command.strict;
      options.resume_command = resume_command(command);
      return Session::open(file, options, MPI_COMM_WORLD)->run().code;
    }

    void
    print_versions()
    {
      for (const auto &[name, version] : software_versions())
        std::cout << name << " " << version << "\n";
    }

    /** What is asked for is a text: no MPI, which would take a third of a second. */
    ExitCode
    print_text(const CommandLine &command)
    {
      if (command.help)
        std::cout << help_text();
      else if (command.version)
        print_versions();
      else
        print_parameters(std::cout, command.scene);
      return ExitCode::finished;
    }

    ExitCode
    obey(const CommandLine &command)
    {
      set_blas_threads(command.n_threads.value_or(1));
      ParameterFile file = ParameterFile::read(command.scene, MPI_COMM_WORLD);
      for (const std::string &setting : command.settings)
        file.set(setting);
      if (command.drive || is_path(file))
        {
          if (command.resume)
            throw UserError(command.scene + " is a path of a single material point; --resume does "
                                            "not go with it.");
          if (command.validate)
            {
              validate(file, std::cout, MPI_COMM_WORLD);
              return ExitCode::finished;
            }
          return drive(file,
                       output_folder(command, file.scene_name()),
                       command.strict,
                       MPI_COMM_WORLD);
        }
      return run(command, file);
    }

    /** A message of at most some lines of a terminal: values in it may be of any length. */
    void
    report(const std::string &message)
    {
      constexpr std::size_t longest = 8000;
      if (is_first_process())
        std::cerr << "kedge: " << shortened(message, longest) << std::endl;
    }

    /** What could not be printed was lost: a full disk, a pipe that nobody reads. */
    ExitCode
    check_standard_output(const ExitCode code)
    {
      std::cout.flush();
      if (std::cout || code != ExitCode::finished)
        return code;
      report("The standard output could not be written to its end: the disk is full, or nobody "
             "reads it.");
      return ExitCode::user_error;
    }

    ExitCode
    run_with_mpi(const CommandLine &command, int argc, char **argv)
    {
      hasten_single_process_start();
      give_way_while_waiting();
      const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      std::signal(SIGPIPE, SIG_IGN); // a reader of the log that leaves does not end the run
      try
        {
          return obey(command);
        }
      catch (const UserError &error)
        {
          report(error.what()); // the same on all ranks
          return ExitCode::user_error;
        }
      catch (const std::bad_alloc &)
        {
          std::cerr
            << "kedge: there is not enough memory for this scene; --validate estimates what "
               "it needs."
            << std::endl;
          if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
            MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::user_error));
          return ExitCode::user_error;
        }
      catch (const std::exception &error)
        {
          std::cerr << "kedge: internal error: " << error.what() << std::endl;
          if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
            MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
        }
      return ExitCode::internal_error;
    }
  } // namespace
} // namespace kedge



int
main(int argc, char **argv)
{
  using namespace kedge;
  ExitCode code = ExitCode::user_error;
  try
    {
      const CommandLine command = parse_command_line(argc, argv);
      if (command.help || command.version || command.print_parameters)
        code = is_first_process() ? print_text(command) : ExitCode::finished;
      else
        code = run_with_mpi(command, argc, argv);
    }
  catch (const UserError &error)
    {
      report(error.what());
    }
  return static_cast<int>(check_standard_output(code));
}
