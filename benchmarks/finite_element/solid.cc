#include "solid.h"

#include <kedge/solid/point_update.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/numerics/matrix_tools.h>

namespace finite_element
{
  using namespace dealii;

  namespace
  {
    /** The history of a law out of the columns of a point's memory. */
    template <class Law>
    kedge::HistoryOf<Law>
    history_of(const std::vector<unsigned int> &columns, const kedge::PointState<dim> &state)
    {
      double values[kedge::most_law_columns] = {};
      for (unsigned int c = 0; c < columns.size(); ++c)
        values[c] = state.memory[columns[c]];
      return kedge::read_history<Law>(values);
    }
  } // namespace

  Solid::Solid(const Parameters &parameters)
    : parameters(parameters)
    , material(kedge::make_material(parameters.material))
    , columns(kedge::memory_indices(material))
    , scheme(parameters.time)
    , element(FE_Q<dim>(parameters.degree), dim)
    , dofs(triangulation)
  {
    make_mesh();
    set_up_points();
    assemble_mass();
    set_loads();
  }



  void
  Solid::make_mesh()
  {
    GridGenerator::subdivided_hyper_rectangle(triangulation,
                                              parameters.cells,
                                              parameters.origin,
                                              parameters.origin + parameters.extent,
                                              /*colorize=*/true);
    dofs.distribute_dofs(element);

    std::map<types::global_dof_index, Point<dim>> places;
    DoFTools::map_dofs_to_support_points(StaticMappingQ1<dim>::mapping, dofs, places);
    for (int d = 0; d < dim; ++d)
      {
        const IndexSet component =
          DoFTools::extract_dofs(dofs, element.component_mask(FEValuesExtractors::Scalar(d)));
        for (const auto dof : component)
          if (parameters.fixed[d]({places[dof][0], places[dof][1]}) != 0.)
            constraints.add_line(dof);
      }
    constraints.close();

    DynamicSparsityPattern dynamic_pattern(dofs.n_dofs());
    DoFTools::make_sparsity_pattern(dofs, dynamic_pattern, constraints);
    pattern.copy_from(dynamic_pattern);
    mass.reinit(pattern);
    tangent.reinit(pattern);
    for (Vector<double> *vector : {&displacement_n,
                                   &velocity_n,
                                   &acceleration_n,
                                   &increment,
                                   &correction,
                                   &internal,
                                   &inertia,
                                   &external,
                                   &residual})
      vector->reinit(dofs.n_dofs());
    for (int d = 0; d < dim; ++d)
      for (const auto dof :
           DoFTools::extract_dofs(dofs, element.component_mask(FEValuesExtractors::Scalar(d))))
        if (!constraints.is_constrained(dof))
          velocity_n[dof] = parameters.initial_velocity[d]({places[dof][0], places[dof][1]});
  }



  void
  Solid::set_up_points()
  {
    const QGauss<dim>  quadrature(parameters.degree + 1);
    FEValues<dim>      values(element,
                         quadrature,
                         update_gradients | update_JxW_values | update_quadrature_points);
    const unsigned int n = element.n_dofs_per_cell() / dim;
    for (const auto &cell : dofs.active_cell_iterators())
      {
        values.reinit(cell);
        // functions of one scalar component first, then the next
        std::vector<types::global_dof_index> unsorted(element.n_dofs_per_cell());
        std::vector<types::global_dof_index> sorted(element.n_dofs_per_cell());
        cell->get_dof_indices(unsorted);
        for (unsigned int i = 0; i < unsorted.size(); ++i)
          {
            const auto [component, function] = element.system_to_component_index(i);
            sorted[component * n + function] = unsorted[i];
          }
        dofs_of_cell.push_back(sorted);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            QuadraturePoint point{};
            point.state.mass                         = parameters.material.density * values.JxW(q);
            point.state.reference_volume             = values.JxW(q);
            point.state.reference_position           = values.quadrature_point(q);
            point.state.deformation_gradient         = unit_symmetric_tensor<dim>();
            point.state.elastic_frame                = unit_symmetric_tensor<dim>();
            point.state.out_of_plane_elastic_stretch = 1.;
            const auto start = kedge::start_history(material, parameters.material);
            for (unsigned int c = 0; c < columns.size(); ++c)
              point.state.memory[columns[c]] = start[c];
            for (unsigned int A = 0; A < n; ++A)
              point.gradient.push_back(
                values.shape_grad(element.component_to_system_index(0, A), q));
            point.gradient_n = point.gradient;
            points.push_back(point);
          }
      }
  }



  void
  Solid::assemble_mass()
  {
    const Functions::ConstantFunction<dim> density(parameters.material.density, dim);
    MatrixCreator::create_mass_matrix(dofs,
                                      QGauss<dim>(parameters.degree + 1),
                                      mass,
                                      &density,
                                      constraints);
  }



  void
  Solid::set_loads()
  {
    const QGauss<dim>     quadrature(parameters.degree + 1);
    const QGauss<dim - 1> face_quadrature(parameters.degree + 1);
    FEValues<dim>         values(element, quadrature, update_values | update_JxW_values);
    FEFaceValues<dim>     face_values(element, face_quadrature, update_values | update_JxW_values);
    for (int d = 0; d < dim; ++d)
      {
        gravity_load[d].reinit(dofs.n_dofs());
        end_load[d].reinit(dofs.n_dofs());
      }
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    const auto add = [&](const FEValuesBase<dim> &fe, const double factor, Vector<double> *load) {
      for (unsigned int q = 0; q < fe.n_quadrature_points; ++q)
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            const unsigned int d = element.system_to_component_index(i).first;
            load[d][indices[i]] += factor * fe.shape_value(i, q) * fe.JxW(q);
          }
    };
    for (const auto &cell : dofs.active_cell_iterators())
      {
        cell->get_dof_indices(indices);
        values.reinit(cell);
        add(values, parameters.material.density, gravity_load);
        if (cell->face(1)->at_boundary())
          {
            face_values.reinit(cell, 1);
            add(face_values, 1. / parameters.extent[1], end_load);
          }
      }
  }



  void
  Solid::start(const double t_n, const double dt)
  {
    this->t_n           = t_n;
    this->dt            = dt;
    const double t_load = scheme.load_time(t_n, dt);
    increment           = 0.;
    external            = 0.;
    for (int d = 0; d < dim; ++d)
      {
        external.add(parameters.acceleration[d]({t_load}), gravity_load[d]);
        external.add(parameters.end_load[d]({t_load}), end_load[d]);
      }
    for (QuadraturePoint &point : points)
      {
        const Tensor<2, dim> to_present = transpose(invert(point.state.deformation_gradient));
        for (std::size_t A = 0; A < point.gradient.size(); ++A)
          point.gradient_n[A] = to_present * point.gradient[A];
        point.stress_state = kedge::make_stress_state<dim>(point.state.elastic_frame,
                                                           point.state.out_of_plane_elastic_stretch,
                                                           point.state.kirchhoff_stress);
      }
  }



  /** Calls run(dofs of the cell, its displacements over the step, its first point, its last + 1).
   */
  template <class Run>
  void
  Solid::for_each_cell(const Run &run) const
  {
    const std::size_t   per_cell = points.size() / dofs_of_cell.size();
    std::vector<double> u(element.n_dofs_per_cell());
    for (std::size_t c = 0; c < dofs_of_cell.size(); ++c)
      {
        for (std::size_t i = 0; i < u.size(); ++i)
          u[i] = increment[dofs_of_cell[c][i]];
        if (!run(dofs_of_cell[c], u, c * per_cell, (c + 1) * per_cell))
          return;
      }
  }



  void
  Solid::relative_gradient(const QuadraturePoint     &point,
                           const std::vector<double> &u,
                           double (&gradient)[dim][dim]) const
  {
    const std::size_t n = point.gradient_n.size();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        {
          gradient[i][j] = 0.;
          for (std::size_t A = 0; A < n; ++A)
            gradient[i][j] += u[i * n + A] * point.gradient_n[A][j];
        }
  }



  template <bool with_tangent, class Law>
  kedge::ForceStress<dim>
  Solid::force_stress(const Law             &law,
                      const QuadraturePoint &point,
                      const double (&gradient)[dim][dim]) const
  {
    const auto history = history_of<Law>(columns, point.state);
    if (scheme.conserving_stress)
      return kedge::evaluate_force_stress<dim, with_tangent, kedge::StressRule::conserving>(
        law,
        point.stress_state,
        gradient,
        scheme.alpha_f,
        history);
    return kedge::evaluate_force_stress<dim, with_tangent, kedge::StressRule::at_configuration>(
      law,
      point.stress_state,
      gradient,
      scheme.alpha_f,
      history);
  }



  bool
  Solid::add_internal_force()
  {
    bool ok = true;
    std::visit(
      [&](const auto &law) {
        for_each_cell([&](const auto &indices, const auto &u, const auto begin, const auto end) {
          for (std::size_t q = begin; q < end; ++q)
            {
              const QuadraturePoint &point = points[q];
              double                 gradient[dim][dim];
              relative_gradient(point, u, gradient);
              const auto stress = force_stress<false>(law, point, gradient);
              ok                = stress.valid;
              if (!ok)
                return false;
              const std::size_t n = point.gradient_n.size();
              for (int p = 0; p < dim; ++p)
                for (std::size_t A = 0; A < n; ++A)
                  for (int R = 0; R < dim; ++R)
                    internal[indices[p * n + A]] +=
                      point.state.reference_volume * stress.stress[p][R] * point.gradient_n[A][R];
            }
          return true;
        });
      },
      material);
    return ok;
  }



  Solid::Evaluation
  Solid::evaluate()
  {
    const kedge::Stopwatch stopwatch(phases.residual);
    internal = 0.;
    inertia  = 0.;
    Evaluation result;
    result.ok = add_internal_force();
    if (!result.ok)
      result.cause = "a quadrature point cannot follow";
    if (scheme.dynamic)
      {
        Vector<double> acceleration(increment.size());
        for (std::size_t i = 0; i < acceleration.size(); ++i)
          acceleration[i] =
            scheme.equilibrium_acceleration(increment[i], velocity_n[i], acceleration_n[i], dt);
        mass.vmult(inertia, acceleration);
      }
    residual = internal;
    residual += inertia;
    residual -= external;
    constraints.set_zero(residual);
    result.residual_norm = residual.l2_norm();
    result.scale         = internal.l2_norm() + inertia.l2_norm() + external.l2_norm();
    double square        = 0.;
    for (std::size_t i = 0; i < increment.size(); ++i)
      square += std::pow(tangent.diag_element(i) * increment[i], 2);
    result.scale += std::sqrt(square);
    return result;
  }



  void
  Solid::assemble_tangent()
  {
    const kedge::Stopwatch stopwatch(phases.tangent);
    tangent = 0.;
    if (scheme.dynamic)
      tangent.add(scheme.inertia_coefficient(dt), mass);
    FullMatrix<double> cell_matrix(element.n_dofs_per_cell());
    std::visit(
      [&](const auto &law) {
        for_each_cell([&](const auto &indices, const auto &u, const auto begin, const auto end) {
          cell_matrix = 0.;
          for (std::size_t q = begin; q < end; ++q)
            {
              const QuadraturePoint &point = points[q];
              double                 gradient[dim][dim];
              relative_gradient(point, u, gradient);
              const auto        stress = force_stress<true>(law, point, gradient);
              const std::size_t n      = point.gradient_n.size();
              for (std::size_t A = 0; A < n; ++A)
                for (int p = 0; p < dim; ++p)
                  for (int m = 0; m < dim; ++m)
                    for (int S = 0; S < dim; ++S)
                      {
                        double factor = 0.;
                        for (int R = 0; R < dim; ++R)
                          factor += point.gradient_n[A][R] * stress.tangent[p][R][m][S];
                        factor *= point.state.reference_volume;
                        for (std::size_t B = 0; B < n; ++B)
                          cell_matrix(p * n + A, m * n + B) += factor * point.gradient_n[B][S];
                      }
            }
          constraints.distribute_local_to_global(cell_matrix, indices, tangent);
          return true;
        });
      },
      material);
  }



  kedge::LinearStatus
  Solid::solve_correction(double &norm, const bool keep_tangent)
  {
    kedge::LinearStatus status;
    if (!keep_tangent)
      assemble_tangent();
    const kedge::Stopwatch stopwatch(phases.linear_solve);
    try
      {
        if (!keep_tangent)
          solver.initialize(tangent);
        solver.vmult(correction, residual);
      }
    catch (const ExceptionBase &)
      {
        return kedge::LinearStatus::failure("UMFPACK failed");
      }
    correction *= -1.;
    constraints.set_zero(correction);
    norm = correction.l2_norm();
    base = increment;
    return status;
  }



  void
  Solid::retract(const double factor)
  {
    increment = base;
    increment.add(factor, correction);
  }



  bool
  Solid::accept()
  {
    const kedge::Stopwatch               stopwatch(phases.history_update);
    std::vector<kedge::PointUpdate<dim>> updates(points.size());
    bool                                 ok = true;
    std::visit(
      [&](const auto &law) {
        for_each_cell([&](const auto &, const auto &u, const auto begin, const auto end) {
          for (std::size_t q = begin; q < end && ok; ++q)
            {
              double gradient[dim][dim];
              relative_gradient(points[q], u, gradient);
              const auto history =
                history_of<std::decay_t<decltype(law)>>(columns, points[q].state);
              ok = kedge::update_point<dim>(law,
                                            points[q].stress_state,
                                            history,
                                            gradient,
                                            updates[q]);
            }
          return ok;
        });
      },
      material);
    if (!ok)
      return false;
    for (std::size_t q = 0; q < points.size(); ++q)
      kedge::apply_point_update<dim>(updates[q], columns, points[q].state);
    external_work += external * increment;
    displacement_n += increment;
    if (scheme.dynamic)
      for (std::size_t i = 0; i < increment.size(); ++i)
        {
          const double u = increment[i], v = velocity_n[i], a = acceleration_n[i];
          velocity_n[i] = scheme.end_velocity(u, v, a, dt);
          if (scheme.carries_acceleration)
            acceleration_n[i] = scheme.end_acceleration(u, v, a, dt);
        }
    return true;
  }



  Energies
  Solid::energies() const
  {
    Energies sum;
    for (const QuadraturePoint &point : points)
      {
        sum.strain += point.state.reference_volume * point.state.strain_energy;
        sum.hardening += point.state.reference_volume * point.state.hardening_energy;
        sum.dissipation += point.state.reference_volume * point.state.plastic_dissipation;
      }
    if (scheme.dynamic)
      sum.kinetic = 0.5 * mass.matrix_norm_square(velocity_n);
    sum.external_work = external_work;
    return sum;
  }



  double
  Solid::stress_error() const
  {
    double error = 0., volume = 0.;
    for (const QuadraturePoint &point : points)
      {
        const double stress =
          point.state.kirchhoff_stress[1][1] / determinant(point.state.deformation_gradient);
        const auto &X = point.state.reference_position;
        error +=
          point.state.reference_volume * std::abs(stress - parameters.exact_stress({X[0], X[1]}));
        volume += point.state.reference_volume;
      }
    return error / volume / parameters.stress_scale;
  }
} // namespace finite_element
