#include <kedge/io/checks.h>
#include <kedge/io/collective.h>
#include <kedge/io/command_name.h>
#include <kedge/io/files.h>
#include <kedge/io/summary.h>
#include <kedge/io/versions.h>
#include <kedge/simulation/drive_point.h>
#include <kedge/stress/soil_test.h>

#include <algorithm>
#include <optional>

namespace kedge
{
  namespace
  {
    const char *const axes = "xyz";

    /** The point on its path, whichever kind that is. */
    class Driver
    {
    public:
      explicit Driver(const PathScene &scene)
        : free_point(scene.material, scene.path.initial_pressure)
      {
        if (scene.path.kind == PathParameters::Kind::control)
          test.emplace(scene.path, scene.material, scene.constants);
        else
          path.emplace(scene.path, scene.constants);
        free_point.set_time_step(scene.path.end / scene.path.n_steps);
      }

      bool
      start()
      {
        return !test || test->consolidate();
      }

      bool
      advance_to(const double t)
      {
        return test ? test->advance_to(t) : free_point.deform_to(path->deformation_gradient(t));
      }

      const SinglePoint &
      point() const
      {
        return test ? test->material_point() : free_point;
      }

      const SinglePoint::State &
      state() const
      {
        return point().state();
      }

      double
      pore_pressure() const
      {
        return test ? test->pore_pressure() : 0.;
      }

    private:
      SinglePoint               free_point;
      std::optional<StrainPath> path;
      std::optional<SoilTest>   test;
    };

    /** Columns of the law's history that have no place of their own in the row. */
    std::vector<std::string>
    further_columns(const MaterialParameters &material)
    {
      const std::vector<std::string> known = {"equivalent_plastic_strain",
                                              "plastic_volume_strain",
                                              "volume_strain",
                                              "time_step"};
      std::vector<std::string>       result;
      for (const Column &column : columns_of(make_material(material)))
        if (std::find(known.begin(), known.end(), column.name) == known.end())
          result.push_back(column.name);
      return result;
    }

    /** What an element test adds to the row. */
    void
    write_soil(const Driver &driver, const MaterialParameters &material, CsvFile &file)
    {
      const SinglePoint::State &state  = driver.state();
      const double              J      = determinant(state.deformation_gradient);
      const auto                stress = state.cauchy_stress();
      for (int i = 0; i < 3; ++i)
        file << std::log(state.deformation_gradient[i][i]);
      file << std::log(J);
      for (int i = 0; i < 3; ++i)
        file << stress[i][i] - driver.pore_pressure();
      file << driver.pore_pressure() << 0.5 * (stress[0][0] + stress[1][1]) - stress[2][2]
           << driver.point().column("plastic_volume_strain");
      if (material.initial_porosity > 0.)
        {
          const double n = porosity(material.initial_porosity, J);
          file << n << n / (1. - n);
        }
    }

    /** Writes the row unless a number of it is not finite; then says which. */
    std::string
    write_row(const std::uint64_t step,
              const double        time,
              const Driver       &driver,
              const PathScene    &scene,
              CsvFile            &file)
    {
      const SinglePoint::State &state = driver.state();
      const auto               &tau   = state.kirchhoff_stress;
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
      if (yields(make_material(scene.material)))
        file << state.hardening_energy << state.plastic_dissipation
             << driver.point().column("equivalent_plastic_strain");
      if (scene.path.kind == PathParameters::Kind::control)
        write_soil(driver, scene.material, file);
      for (const std::string &name : further_columns(scene.material))
        file << driver.point().column(name);
      if (!file.not_finite().empty())
        return file.not_finite();
      file.end_row();
      return "";
    }

    /** How far a path came. */
    struct PathEnd
    {
      double        stopped_at = -1.; ///< the time that could not be reached [s]; -1: none
      std::string   why;
      std::uint64_t n_steps = 0; ///< that were taken
    };

    PathEnd
    follow(Driver &driver, const PathScene &scene, CsvFile &file)
    {
      PathEnd     end;
      const char *no_answer = "det F <= 0, or no finite stress there, or none that is prescribed";
      const auto  stop      = [&](const double t, const std::string &why) {
        end.stopped_at = t;
        end.why        = why;
        return end;
      };
      if (!driver.start())
        return stop(0., no_answer);
      if (const std::string bad = write_row(0, 0., driver, scene, file); !bad.empty())
        return stop(0., bad);
      for (unsigned int step = 1; step <= scene.path.n_steps; ++step)
        {
          const double t = scene.path.end * step / scene.path.n_steps;
          if (!driver.advance_to(t))
            return stop(t, no_answer);
          if (const std::string bad = write_row(step, t, driver, scene, file); !bad.empty())
            return stop(t, bad);
          end.n_steps = step;
        }
      return end;
    }

    /** summary.json, with the last row of the table. */
    void
    summarise(const PathScene                &scene,
              const PathEnd                  &end,
              const std::vector<CheckResult> &checks,
              const RunFolder                &folder,
              const double                    wall_start)
    {
      RunSummary summary;
      summary.versions          = software_versions();
      summary.scene             = scene.name;
      summary.title             = scene.title;
      summary.status            = end.stopped_at < 0. ? "finished" : "numerical_stop";
      summary.reason            = end.why;
      summary.dim               = 3;
      summary.n_ranks           = dealii::Utilities::MPI::n_mpi_processes(folder.communicator());
      summary.counts            = {{"material_points", 1}};
      summary.n_steps           = end.n_steps;
      summary.checks            = checks;
      summary.wall_seconds      = MPI_Wtime() - wall_start;
      summary.cpu_seconds       = cpu_seconds(folder.communicator());
      summary.peak_memory_bytes = peak_memory(folder.communicator());
      summary.point_updates_per_second =
        static_cast<double>(end.n_steps) / std::max(summary.wall_seconds, 1e-9);
      if (folder.is_root())
        {
          const CsvTable table = read_csv(folder.path("history.csv"));
          for (std::size_t k = 2; k < table.columns.size(); ++k) // after step and time
            if (!table.values[k].empty())
              {
                summary.columns.push_back({table.columns[k], "", Ledger::Section::state, false});
                summary.final_row.books.push_back(table.values[k].back());
              }
          summary.final_row.step = end.n_steps;
          summary.final_row.time = table.values[1].empty() ? 0. : table.values[1].back();
        }
      write_summary(folder, summary);
    }
  } // namespace



  std::vector<std::string>
  path_columns(const PathScene &scene)
  {
    std::vector<std::string> names = {"step", "time"};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        names.push_back(std::string("deformation_gradient_") + axes[i] + axes[j]);
    for (const std::string stress : {"kirchhoff_stress_", "cauchy_stress_"})
      for (int s = 0; s < n_symmetric<3>; ++s)
        names.push_back(stress + axes[symmetric_row<3>[s]] + axes[symmetric_column<3>[s]]);
    names.insert(names.end(), {"pressure", "von_mises_stress", "strain_energy"});
    if (yields(make_material(scene.material)))
      names.insert(names.end(),
                   {"hardening_energy", "plastic_dissipation", "equivalent_plastic_strain"});
    if (scene.path.kind == PathParameters::Kind::control)
      {
        names.insert(names.end(),
                     {"strain_x",
                      "strain_y",
                      "strain_z",
                      "volume_strain",
                      "total_stress_xx",
                      "total_stress_yy",
                      "total_stress_zz",
                      "pore_pressure",
                      "deviator_stress",
                      "plastic_volume_strain"});
        if (scene.material.initial_porosity > 0.)
          names.insert(names.end(), {"porosity", "void_ratio"});
      }
    for (const std::string &name : further_columns(scene.material))
      names.push_back(name);
    return names;
  }



  ExitCode
  drive_point(const PathScene             &scene,
              const std::filesystem::path &output,
              const bool                   strict,
              const MPI_Comm               communicator)
  {
    const double                   wall_start = MPI_Wtime();
    const std::vector<std::string> columns    = path_columns(scene);
    verify_checks<3>(scene.checks, columns, {});
    Driver          driver(scene);
    const RunFolder folder(output, RunFolder::Mode::fresh, communicator);
    folder.log() << "kedge: " << (scene.title.empty() ? scene.name : scene.title)
                 << "\n  one material point of '" << scene.material.name << "'" << std::endl;

    PathEnd end;
    run_on_root(communicator, [&]() {
      replace_file(folder.path("parameters.prm"), scene.parameters);
      CsvFile file(folder.path("history.csv"), columns);
      end = follow(driver, scene, file);
    });
    end.stopped_at = dealii::Utilities::MPI::broadcast(communicator, end.stopped_at);
    if (end.stopped_at >= 0.)
      {
        summarise(scene, end, {}, folder, wall_start);
        folder.log() << "kedge: stopped before t = " << end.stopped_at << " s: " << end.why
                     << std::endl;
        return ExitCode::numerical_stop;
      }

    const auto results = evaluate_checks<3>(scene.checks, folder, {}, scene.constants);
    print_checks(results, folder.log());
    summarise(scene, end, results, folder, wall_start);
    folder.log() << "kedge: finished after " << scene.path.n_steps << " steps\n"
                 << "kedge: results in " << folder.path().string()
                 << "; to draw them: " << command_name() << " plot " << folder.path().string()
                 << std::endl;
    folder.check_log();
    for (const CheckResult &check : results)
      if (!check.pass && strict)
        return ExitCode::numerical_stop;
    return ExitCode::finished;
  }
} // namespace kedge
