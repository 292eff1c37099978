#include <kedge/base/exceptions.h>
#include <kedge/base/single_process.h>
#include <kedge/io/versions.h>
#include <kedge/scene/command_line.h>
#include <kedge/scene/read_scene.h>
#include <kedge/simulation/drive_point.h>
#include <kedge/simulation/run.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <iostream>

extern "C"
{
  /** Of OpenBLAS; absent from other libraries. */
  void
  openblas_set_num_threads(int) __attribute__((weak));
}

namespace kedge
{
  namespace
  {
    std::filesystem::path
    output_folder(const CommandLine &command, const std::string &scene_name)
    {
      return command.output.empty() ? std::filesystem::path("output") / scene_name
                                    : std::filesystem::path(command.output);
    }

    template <int dim>
    ExitCode
    run(const CommandLine &command, const ParameterFile &file)
    {
      const Scene<dim> scene = read_scene<dim>(file);
      if (command.validate)
        {
          validate_scene(scene, std::cout, MPI_COMM_WORLD);
          return ExitCode::finished;
        }
      RunOptions options;
      options.output = output_folder(command, scene.name);
      options.resume = command.resume;
      options.strict = command.strict;
      return Run<dim>(scene, options, MPI_COMM_WORLD).run();
    }

    void
    print_versions()
    {
      for (const auto &[name, version] : software_versions())
        std::cout << name << " " << version << "\n";
    }

    ExitCode
    obey(const CommandLine &command)
    {
      const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      if (command.help || command.version || command.print_parameters)
        {
          if (root && command.help)
            std::cout << help_text();
          else if (root && command.version)
            print_versions();
          else if (root)
            print_parameters(std::cout);
          return ExitCode::finished;
        }
      if (openblas_set_num_threads != nullptr)
        openblas_set_num_threads(static_cast<int>(command.n_threads.value_or(1)));
      ParameterFile file = ParameterFile::read(command.scene, MPI_COMM_WORLD);
      for (const std::string &setting : command.settings)
        file.set(setting);
      if (command.drive || is_path_file(file))
        {
          if (command.resume || command.validate)
            throw UserError(command.scene + " is a path of a single material point; neither "
                                            "--resume nor --validate goes with it.");
          const PathScene scene = read_path_scene(file);
          return drive_point(scene,
                             output_folder(command, scene.name),
                             command.strict,
                             MPI_COMM_WORLD);
        }
      return scene_dimension(file) == 2 ? run<2>(command, file) : run<3>(command, file);
    }

    /**
     * Ranks that wait give way to others: without it two ranks that share their
     * cores with other programs take ten times as long. Of Open MPI; mpirun sets
     * it to 0 for as many ranks as cores, however busy these are.
     */
    void
    give_way_while_waiting()
    {
      setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
    }

    ExitCode
    report(const std::string &kind, const char *what, const ExitCode code)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cerr << kind << what << std::endl;
      return code;
    }
  } // namespace
} // namespace kedge



int
main(int argc, char **argv)
{
  using namespace kedge;
  hasten_single_process_start();
  give_way_while_waiting();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  ExitCode                                       code = ExitCode::internal_error;
  try
    {
      code = obey(parse_command_line(argc, argv));
    }
  catch (const UserError &error)
    {
      // the same on all ranks
      code = report("kedge: ", error.what(), ExitCode::user_error);
    }
  catch (const std::exception &error)
    {
      std::cerr << "kedge: internal error: " << error.what() << std::endl;
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::internal_error));
    }
  return static_cast<int>(code);
}
