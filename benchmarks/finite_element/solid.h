#ifndef kedge_finite_element_solid_h
#define kedge_finite_element_solid_h

#include "parameters.h"

#include <kedge/base/stopwatch.h>
#include <kedge/materials/material.h>
#include <kedge/points/point_state.h>
#include <kedge/solvers/newton.h>
#include <kedge/stress/force_stress.h>
#include <kedge/stress/point_update.h>
#include <kedge/time_integration/scheme.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

namespace finite_element
{
  /** Sums over the body, per metre of thickness. */
  struct Energies
  {
    double kinetic = 0., strain = 0., hardening = 0., dissipation = 0., external_work = 0.;
  };

  /** CPU seconds by phase, named as in kedge's summary. */
  struct Phases
  {
    kedge::PhaseTime residual, tangent, linear_solve, history_update, output;
  };

  /**
   * The same balance of momentum as kedge's on a mesh that is fixed to the
   * body: quadrature points in place of material points, shape functions of the
   * undeformed element in place of those of the grid. With the gradients at
   * the start of the step, dN/dx_n = F_n^{-T} dN/dX, the stress routines are
   * kedge's as they stand:
   *   f_A = sum_q V0_q P_q dN_A/dx_n,  P = evaluate_force_stress(A, history),
   * A = d(Delta u)/dx_n, so that F_n^{-T} and V0 make it the total Lagrangian
   * form with the first Piola-Kirchhoff stress P F_n^{-T}.
   */
  class Solid : public kedge::NewtonProblem
  {
  public:
    explicit Solid(const Parameters &parameters);

    /** Prepares an attempt at the step from @p t_n to t_n + @p dt. */
    void
    start(const double t_n, const double dt);

    Evaluation
    evaluate() override;

    kedge::LinearStatus
    solve_correction(double &norm, const bool keep_tangent) override;

    void
    retract(const double factor) override;

    /** Commits the step that has converged. @return false if a point cannot follow. */
    bool
    accept();

    Energies
    energies() const;

    /** Mean of |Cauchy yy - exact| over the undeformed volume, over the scale. */
    double
    stress_error() const;

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dofs;
    }

    const dealii::Triangulation<dim> &
    mesh() const
    {
      return triangulation;
    }

    const dealii::Vector<double> &
    displacement() const
    {
      return displacement_n;
    }

    const dealii::Vector<double> &
    velocity() const
    {
      return velocity_n;
    }

    std::size_t
    n_quadrature_points() const
    {
      return points.size();
    }

    Phases phases;

  private:
    /** A quadrature point, with the gradients of its element's functions. */
    struct QuadraturePoint
    {
      kedge::PointState<dim>              state;
      kedge::StressState<dim>             stress_state; ///< of the present step
      std::vector<dealii::Tensor<1, dim>> gradient;     ///< dN/dX by scalar function
      std::vector<dealii::Tensor<1, dim>> gradient_n;   ///< dN/dx_n
    };

    void
    make_mesh();
    void
    set_up_points();
    void
    assemble_mass();
    void
    set_loads();
    void
    assemble_tangent();
    void
    relative_gradient(const QuadraturePoint     &point,
                      const std::vector<double> &u,
                      double (&gradient)[dim][dim]) const;
    template <class Run>
    void
    for_each_cell(const Run &run) const;
    template <bool with_tangent, class Law>
    kedge::ForceStress<dim>
    force_stress(const Law             &law,
                 const QuadraturePoint &point,
                 const double (&gradient)[dim][dim]) const;
    bool
    add_internal_force();

    const Parameters                  parameters;
    const kedge::Material             material;
    const std::vector<unsigned int>   columns; ///< of its history in a point's memory
    const kedge::Scheme               scheme;
    dealii::Triangulation<dim>        triangulation;
    dealii::FESystem<dim>             element;
    dealii::DoFHandler<dim>           dofs;
    dealii::AffineConstraints<double> constraints;
    dealii::SparsityPattern           pattern;
    dealii::SparseMatrix<double>      mass, tangent;
    dealii::SparseDirectUMFPACK       solver;

    std::vector<QuadraturePoint>                              points; ///< element by element
    std::vector<std::vector<dealii::types::global_dof_index>> dofs_of_cell;

    dealii::Vector<double> displacement_n, velocity_n, acceleration_n;
    dealii::Vector<double> increment, correction;
    dealii::Vector<double> base; ///< increment at the last correction
    dealii::Vector<double> internal, inertia, external, residual;
    dealii::Vector<double> gravity_load[dim], end_load[dim]; ///< of unit acceleration, of unit load
    double                 t_n = 0., dt = 0., external_work = 0.;
  };
} // namespace finite_element

#endif
