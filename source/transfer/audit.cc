#include <kedge/transfer/audit.h>
#include <kedge/transfer/node_sums.h>

namespace kedge
{
  namespace
  {
    /** a x b; in 2D the z component alone. */
    template <int dim>
    dealii::Tensor<1, 3>
    cross(const dealii::Tensor<1, dim> &a, const dealii::Tensor<1, dim> &b)
    {
      dealii::Tensor<1, 3> product;
      product[2] = a[0] * b[1] - a[1] * b[0];
      if constexpr (dim == 3)
        {
          product[0] = a[1] * b[2] - a[2] * b[1];
          product[1] = a[2] * b[0] - a[0] * b[2];
        }
      return product;
    }

    template <int dim>
    dealii::Tensor<1, dim>
    at_node(const std::vector<double> &nodal, const unsigned int node)
    {
      dealii::Tensor<1, dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = nodal[std::size_t(node) * dim + d];
      return value;
    }

    /** Adds what a momentum at x with velocity v contributes. */
    template <int dim>
    void
    add(MotionTotals<dim>            &totals,
        const dealii::Tensor<1, dim> &x,
        const dealii::Tensor<1, dim> &momentum,
        const dealii::Tensor<1, dim> &v)
    {
      totals.linear_momentum += momentum;
      totals.angular_momentum += cross<dim>(x, momentum);
      totals.kinetic_energy += 0.5 * (momentum * v);
    }

    /** Adds up the shares of all ranks. */
    template <int dim>
    void
    sum_up(const MPI_Comm communicator, const std::vector<MotionTotals<dim> *> &all)
    {
      std::vector<double> values;
      for (const auto *totals : all)
        {
          for (int d = 0; d < dim; ++d)
            values.push_back(totals->linear_momentum[d]);
          for (int d = 0; d < 3; ++d)
            values.push_back(totals->angular_momentum[d]);
          values.push_back(totals->kinetic_energy);
        }
      dealii::Utilities::MPI::sum(values, communicator, values);
      auto value = values.begin();
      for (auto *totals : all)
        {
          for (int d = 0; d < dim; ++d)
            totals->linear_momentum[d] = *value++;
          for (int d = 0; d < 3; ++d)
            totals->angular_momentum[d] = *value++;
          totals->kinetic_energy = *value++;
        }
    }

    /** Positions of the local nodes, moved by @p u. */
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    positions(const Patch<dim> &patch, const std::vector<double> &u)
    {
      std::vector<dealii::Tensor<1, dim>> x(patch.nodes.n_local());
      for (unsigned int i = 0; i < x.size(); ++i)
        x[i] = patch.node_position(i) + at_node<dim>(u, i);
      return x;
    }

    /** This rank's share of the grid's totals: its M~ v is a partial sum, the rest is whole. */
    template <int dim>
    MotionTotals<dim>
    grid_totals(const Patch<dim>                          &patch,
                const NodeMatrix<dim>                     &mass,
                const std::vector<dealii::Tensor<1, dim>> &x,
                const std::vector<double>                 &v)
    {
      std::vector<double> momentum(v.size());
      multiply(mass, patch, dim, v, momentum);
      MotionTotals<dim> totals;
      for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
        add<dim>(totals, x[i], at_node<dim>(momentum, i), at_node<dim>(v, i));
      return totals;
    }

    template <int dim>
    MotionTotals<dim>
    point_totals(const std::vector<double>                 &mass,
                 const std::vector<dealii::Tensor<1, dim>> &x,
                 const std::vector<dealii::Tensor<1, dim>> &v)
    {
      MotionTotals<dim> totals;
      for (unsigned int p = 0; p < mass.size(); ++p)
        add<dim>(totals, x[p], mass[p] * v[p], v[p]);
      return totals;
    }

    /**
     * This rank's share of x x (D v) and 1/2 v D v, D = lumped - consistent
     * mass, formed from its points: (lumped v)_A = sum_p m N_A v_A and
     * (consistent v)_A = sum_p m N_A v_p.
     */
    template <int dim>
    MotionTotals<dim>
    lumping_totals(const Patch<dim>                          &patch,
                   const std::vector<double>                 &lumped_mass,
                   const std::vector<dealii::Tensor<1, dim>> &x,
                   const std::vector<double>                 &v)
    {
      std::vector<dealii::Tensor<1, dim>> v_at_points;
      interpolate_to_points(patch, v, v_at_points);
      std::vector<double> momentum(v.size(), 0.);
      add_to_nodes(patch, patch.points.mass, v_at_points, momentum);
      MotionTotals<dim> totals;
      for (unsigned int i = 0; i < patch.nodes.n_local(); ++i)
        {
          const auto v_i = at_node<dim>(v, i);
          add<dim>(totals, x[i], lumped_mass[i] * v_i - at_node<dim>(momentum, i), v_i);
        }
      return totals;
    }
  } // namespace



  template <int dim>
  double
  filtered_energy(const Patch<dim> &patch, const std::vector<double> &v_n)
  {
    std::vector<dealii::Tensor<1, dim>> v_at_points;
    interpolate_to_points(patch, v_n, v_at_points);
    double energy = 0.;
    for (unsigned int p = 0; p < patch.points.size(); ++p)
      energy +=
        0.5 * patch.points.mass[p] * (patch.points.velocity[p] - v_at_points[p]).norm_square();
    return energy;
  }



  template <int dim>
  double
  lumping_energy(const Patch<dim> &patch, const std::vector<double> &v)
  {
    std::vector<double> lumped_mass(patch.nodes.n_local(), 0.);
    add_scalars_to_nodes(patch, patch.points.mass, 1, lumped_mass);
    const std::vector<dealii::Tensor<1, dim>> anywhere(patch.nodes.n_local());
    return lumping_totals(patch, lumped_mass, anywhere, v).kinetic_energy;
  }



  template <int dim>
  MotionTotals<dim>
  operator-(const MotionTotals<dim> &a, const MotionTotals<dim> &b)
  {
    return {a.linear_momentum - b.linear_momentum,
            a.angular_momentum - b.angular_momentum,
            a.kinetic_energy - b.kinetic_energy};
  }



  template <int dim>
  TransferAudit<dim> &
  TransferAudit<dim>::operator+=(const TransferAudit &other)
  {
    const auto add = [](MotionTotals<dim> &sum, const MotionTotals<dim> &term) {
      sum.linear_momentum += term.linear_momentum;
      sum.angular_momentum += term.angular_momentum;
      sum.kinetic_energy += term.kinetic_energy;
    };
    add(points_n, other.points_n);
    add(grid_n, other.grid_n);
    add(points_np1, other.points_np1);
    add(grid_np1, other.grid_np1);
    add(expected_p2g, other.expected_p2g);
    add(expected_step, other.expected_step);
    return *this;
  }



  template <int dim>
  TransferAudit<dim>
  audit_transfer(const Patch<dim>                          &patch,
                 const std::vector<dealii::Tensor<1, dim>> &new_velocities,
                 const NodeMatrix<dim>                     &mass,
                 const double                               lumping,
                 const double                               kept,
                 const std::vector<double>                 &v_n,
                 const std::vector<double>                 &v_np1,
                 const std::vector<double>                 &u)
  {
    const auto x_n   = positions(patch, std::vector<double>(u.size(), 0.));
    const auto x_np1 = positions(patch, u);

    std::vector<dealii::Tensor<1, dim>> points_x_n(patch.points.size()), points_x_np1;
    interpolate_to_points(patch, u, points_x_np1);
    for (unsigned int p = 0; p < patch.points.size(); ++p)
      {
        points_x_n[p] = patch.points.location[p];
        points_x_np1[p] += points_x_n[p];
      }

    TransferAudit<dim> audit;
    audit.points_n   = point_totals<dim>(patch.points.mass, points_x_n, patch.points.velocity);
    audit.grid_n     = grid_totals(patch, mass, x_n, v_n);
    audit.points_np1 = point_totals<dim>(patch.points.mass, points_x_np1, new_velocities);
    audit.grid_np1   = grid_totals(patch, mass, x_np1, v_np1);

    std::vector<double> lumped_mass(patch.nodes.n_local(), 0.);
    add_scalars_to_nodes(patch, patch.points.mass, 1, lumped_mass);
    std::vector<double> change = v_np1;
    for (std::size_t i = 0; i < change.size(); ++i)
      change[i] -= kept * v_n[i];
    MotionTotals<dim> at_n            = lumping_totals(patch, lumped_mass, x_n, v_n);
    MotionTotals<dim> at_np1          = lumping_totals(patch, lumped_mass, x_np1, change);
    audit.expected_p2g.kinetic_energy = filtered_energy(patch, v_n);

    sum_up<dim>(patch.nodes.communicator(),
                {&audit.points_n,
                 &audit.grid_n,
                 &audit.points_np1,
                 &audit.grid_np1,
                 &audit.expected_p2g,
                 &at_n,
                 &at_np1});

    audit.expected_p2g.kinetic_energy += lumping * at_n.kinetic_energy;
    audit.expected_step.angular_momentum = -lumping * at_np1.angular_momentum;
    audit.expected_step.kinetic_energy =
      -lumping * at_np1.kinetic_energy - (1. - kept * kept) * audit.expected_p2g.kinetic_energy;
    return audit;
  }

#define KEDGE_INSTANTIATE(dim)                                                                  \
  template TransferAudit<dim> &TransferAudit<dim>::operator+=(const TransferAudit<dim> &);      \
  template MotionTotals<dim>  operator-(const MotionTotals<dim> &, const MotionTotals<dim> &);  \
  template TransferAudit<dim> audit_transfer(const Patch<dim> &,                                \
                                             const std::vector<dealii::Tensor<1, dim>> &,       \
                                             const NodeMatrix<dim> &,                           \
                                             const double,                                      \
                                             const double,                                      \
                                             const std::vector<double> &,                       \
                                             const std::vector<double> &,                       \
                                             const std::vector<double> &);                      \
  template double             filtered_energy(const Patch<dim> &, const std::vector<double> &); \
  template double             lumping_energy(const Patch<dim> &, const std::vector<double> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
