#include "output.h"

#include <kedge/io/json.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>

#include <sys/resource.h>

#include <filesystem>

namespace finite_element
{
  using namespace dealii;

  namespace
  {
    const std::vector<std::string> history_columns = {"step",
                                                      "time",
                                                      "time_step",
                                                      "newton_iterations",
                                                      "kinetic_energy",
                                                      "strain_energy",
                                                      "hardening_energy",
                                                      "plastic_dissipation",
                                                      "external_work",
                                                      "total_energy",
                                                      "energy_error"};

    std::vector<std::string>
    probe_columns(const Parameters &parameters)
    {
      std::vector<std::string> columns = {"time"};
      for (const ProbeParameters &probe : parameters.probes)
        for (const char *quantity : {"position", "displacement", "velocity"})
          for (const char *component : {"_x", "_y"})
            columns.push_back(probe.name + "." + quantity + component);
      return columns;
    }

    std::string
    made(const std::string &folder)
    {
      std::error_code error;
      std::filesystem::create_directories(folder, error);
      return folder;
    }

    double
    total(const Energies &energies)
    {
      return energies.kinetic + energies.strain + energies.hardening;
    }
  } // namespace



  Output::Output(const Parameters &parameters, const Solid &solid, const std::string &folder)
    : folder(made(folder))
    , history(folder + "/history.csv", history_columns)
    , probe_table(folder + "/probes.csv", probe_columns(parameters))
    , initial_energy(total(solid.energies()))
  {
    for (const ProbeParameters &probe : parameters.probes)
      probes.push_back(probe.side >= 0 ? face_probe(solid, probe.side)
                                       : point_probe(solid, probe.place));
    write_step(solid, 0, 0., 0., 0);
    n_steps = 0;
  }



  Output::Probe
  Output::face_probe(const Solid &solid, const int side)
  {
    const auto                          &fe = solid.dof_handler().get_fe();
    const QGauss<1>                      quadrature(fe.degree + 1);
    FEFaceValues<dim>                    values(fe,
                             quadrature,
                             update_values | update_JxW_values | update_quadrature_points);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    Probe                                probe;
    double                               area = 0.;
    for (const auto &cell : solid.dof_handler().active_cell_iterators())
      if (cell->face(side)->at_boundary())
        {
          values.reinit(cell, side);
          cell->get_dof_indices(indices);
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              area += values.JxW(q);
              probe.place += values.JxW(q) * values.quadrature_point(q);
              for (unsigned int i = 0; i < indices.size(); ++i)
                probe.weights[fe.system_to_component_index(i).first]
                  .emplace_back(indices[i], values.shape_value(i, q) * values.JxW(q));
            }
        }
    probe.place /= area;
    for (auto &component : probe.weights)
      for (auto &[dof, weight] : component)
        weight /= area;
    return probe;
  }



  Output::Probe
  Output::point_probe(const Solid &solid, const Point<dim> &place)
  {
    const auto &fe = solid.dof_handler().get_fe();
    const auto [cell, unit] =
      GridTools::find_active_cell_around_point(StaticMappingQ1<dim>::mapping,
                                               solid.dof_handler(),
                                               place);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    cell->get_dof_indices(indices);
    Probe probe;
    probe.place = place;
    for (unsigned int i = 0; i < indices.size(); ++i)
      probe.weights[fe.system_to_component_index(i).first].emplace_back(indices[i],
                                                                        fe.shape_value(i, unit));
    return probe;
  }



  void
  Output::write_step(const Solid        &solid,
                     const std::uint64_t step,
                     const double        time,
                     const double        dt,
                     const unsigned int  iterations)
  {
    const Energies e = solid.energies();
    history << step << time << dt << std::uint64_t(iterations) << e.kinetic << e.strain
            << e.hardening << e.dissipation << e.external_work << total(e)
            << total(e) + e.dissipation - initial_energy - e.external_work;
    history.end_row();
    n_steps = step;
    n_iterations += iterations;

    probe_table << time;
    for (const Probe &probe : probes)
      {
        Tensor<1, dim> displacement, velocity;
        for (int d = 0; d < dim; ++d)
          for (const auto &[dof, weight] : probe.weights[d])
            {
              displacement[d] += weight * solid.displacement()[dof];
              velocity[d] += weight * solid.velocity()[dof];
            }
        for (const Tensor<1, dim> &value :
             {Tensor<1, dim>(probe.place + displacement), displacement, velocity})
          for (int d = 0; d < dim; ++d)
            probe_table << value[d];
      }
    probe_table.end_row();
  }



  void
  Output::write_summary(const Parameters &parameters, const Solid &solid, const std::string &reason)
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    kedge::JsonWriter json;
    json.open("", '{');
    json.add("status", reason.empty() ? "finished" : "stopped");
    json.add("reason", reason);
    json.add("dimension", std::uint64_t(dim));
    json.open("counts", '{');
    json.add("active_cells", std::uint64_t(solid.mesh().n_active_cells()));
    json.add("dofs", std::uint64_t(solid.dof_handler().n_dofs()));
    json.add("material_points", std::uint64_t(solid.n_quadrature_points()));
    json.close();
    json.add("steps", n_steps);
    json.add("newton_iterations", n_iterations);
    json.add("rejected_attempts", n_rejected);
    json.add("cpu_seconds", double(usage.ru_utime.tv_sec) + 1e-6 * double(usage.ru_utime.tv_usec));
    json.open("phase_cpu_seconds", '{');
    json.add("history update", solid.phases.history_update.cpu);
    json.add("linear solve", solid.phases.linear_solve.cpu);
    json.add("residual", solid.phases.residual.cpu);
    json.add("tangent", solid.phases.tangent.cpu);
    json.close();
    json.open("checks", '[');
    if (parameters.has_exact_stress)
      {
        json.open("", '{');
        json.add("name", "stress error");
        json.add("value", solid.stress_error());
        json.close();
      }
    json.close();
    json.close();
    std::ofstream(folder + "/summary.json") << json.text() << "\n";
  }
} // namespace finite_element
