#include <kedge/io/checks.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/simulation/drive_point.h>
#include <kedge/stress/single_point.h>

namespace kedge
{
  namespace
  {
    const char *const axes = "xyz";

    void
    write_row(const std::uint64_t       step,
              const double              time,
              const SinglePoint::State &state,
              const bool                plastic,
              CsvFile                  &file)
    {
      const auto &tau = state.kirchhoff_stress;
      file << step << time;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          file << state.deformation_gradient[i][j];
      for (const auto &stress : {tau, state.cauchy_stress()})
        for (int s = 0; s < n_symmetric<3>; ++s)
          file << stress[symmetric_row<3>[s]][symmetric_column<3>[s]];
      const auto cauchy = state.cauchy_stress();
      file << -trace(cauchy) / 3. << std::sqrt(1.5) * deviator(cauchy).norm();
      file << state.strain_energy;
      if (plastic)
        file << state.hardening_energy << state.plastic_dissipation
             << state.equivalent_plastic_strain;
      file.end_row();
    }
  } // namespace



  std::vector<std::string>
  path_columns(const MaterialParameters &material)
  {
    std::vector<std::string> names = {"step", "time"};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        names.push_back(std::string("deformation_gradient_") + axes[i] + axes[j]);
    for (const std::string stress : {"kirchhoff_stress_", "cauchy_stress_"})
      for (int s = 0; s < n_symmetric<3>; ++s)
        names.push_back(stress + axes[symmetric_row<3>[s]] + axes[symmetric_column<3>[s]]);
    names.insert(names.end(), {"pressure", "von_mises_stress", "strain_energy"});
    if (has_history(make_material(material)))
      names.insert(names.end(),
                   {"hardening_energy", "plastic_dissipation", "equivalent_plastic_strain"});
    return names;
  }



  ExitCode
  drive_point(const PathScene             &scene,
              const std::filesystem::path &output,
              const bool                   strict,
              const MPI_Comm               communicator)
  {
    const std::vector<std::string> columns = path_columns(scene.material);
    verify_checks<3>(scene.checks, columns, {});
    const StrainPath path(scene.path, scene.constants);
    const Material   material = make_material(scene.material);
    const bool       plastic  = has_history(material);
    const RunFolder  folder(output, RunFolder::Mode::fresh, communicator);
    folder.log() << "kedge: " << (scene.title.empty() ? scene.name : scene.title)
                 << "\n  one material point of '" << scene.material.name << "'" << std::endl;

    double stopped_at = -1.; // the time that could not be reached
    run_on_root(communicator, [&]() {
      replace_file(folder.path("parameters.prm"), scene.parameters);
      CsvFile     file(folder.path("history.csv"), columns);
      SinglePoint point(material);
      write_row(0, 0., point.state(), plastic, file);
      for (unsigned int step = 1; step <= scene.path.n_steps && stopped_at < 0.; ++step)
        {
          const double t = scene.path.end * step / scene.path.n_steps;
          if (point.deform_to(path.deformation_gradient(t)))
            write_row(step, t, point.state(), plastic, file);
          else
            stopped_at = t;
        }
    });
    stopped_at = dealii::Utilities::MPI::broadcast(communicator, stopped_at);
    if (stopped_at >= 0.)
      {
        folder.log() << "kedge: stopped before t = " << stopped_at
                     << " s: det F <= 0 or no finite stress there" << std::endl;
        return ExitCode::numerical_stop;
      }

    const auto results = evaluate_checks<3>(scene.checks, folder, {}, scene.constants);
    print_checks(results, folder.log());
    folder.log() << "kedge: finished after " << scene.path.n_steps << " steps, "
                 << (folder.path("history.csv")).string() << std::endl;
    for (const CheckResult &check : results)
      if (!check.pass && strict)
        return ExitCode::numerical_stop;
    return ExitCode::finished;
  }
} // namespace kedge
