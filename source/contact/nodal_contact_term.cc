#include <kedge/contact/nodal_contact_term.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  bool
  is_free(const ContactFields<dim>          &fields,
          const std::array<unsigned int, 2> &node,
          const unsigned int                 component)
  {
    bool result = false;
    for (unsigned int k = 0; k < 2; ++k)
      fields.patch[k]->constraints.for_free(node[k],
                                            component,
                                            [&](const unsigned int, const double) {
                                              result = true;
                                            });
    return result;
  }



  namespace
  {
    /** Sums of gradients that cancel but for this part have no direction; nor has a shorter n. */
    constexpr double no_direction = 1e-8;

    /** Of a normal, the part across what holds both bodies that is enough. */
    constexpr double barely_free = 1e-6;

    /** Adds m grad N_A of a batch's points, and behind it m |grad N_A|, dim + 1 values per node. */
    template <int dim>
    struct AddGradients
    {
      const Patch<dim>                      &patch;
      const typename StepPoints<dim>::Batch &batch;
      std::vector<double>                   &sums;

      template <unsigned int pattern>
      void
      run() const
      {
        const auto offsets = node_offsets<dim, pattern>(patch.window().node_strides());
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            const Stencil<dim> &stencil = patch.points.stencil[slot];
            const auto          basis   = expand<dim, pattern>(stencil);
            for (std::size_t A = 0; A < offsets.size(); ++A)
              {
                const int local  = patch.nodes.local(stencil.first_node + offsets[A]);
                double   *sum    = &sums[std::size_t(local) * (dim + 1)];
                double    square = 0.;
                for (int d = 0; d < dim; ++d)
                  {
                    sum[d] += patch.points.mass[slot] * basis.gradient[d][A];
                    square += basis.gradient[d][A] * basis.gradient[d][A];
                  }
                sum[dim] += patch.points.mass[slot] * std::sqrt(square);
              }
          }
      }
    };

    /** Unit vector of a field's sum of gradients at a node; 0 if they cancel. */
    template <int dim>
    dealii::Tensor<1, dim>
    outward(const std::vector<double> &gradients, const unsigned int node)
    {
      const double          *sum = &gradients[std::size_t(node) * (dim + 1)];
      dealii::Tensor<1, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = sum[d];
      const double size = result.norm();
      return size > no_direction * sum[dim] ? result / size : dealii::Tensor<1, dim>();
    }

    /** Sets the directions from a vector along the normal; false if there is none. */
    template <int dim>
    bool
    set_directions(const ContactFields<dim> &fields,
                   dealii::Tensor<1, dim>    normal,
                   const bool                along_surface,
                   ContactNode<dim>         &node)
    {
      const double size = normal.norm();
      if (size < no_direction)
        return false;
      std::array<bool, dim> free;
      for (int d = 0; d < dim; ++d)
        {
          free[d] = is_free(fields, node.node, d);
          normal[d] *= free[d] ? 1. / size : 0.;
        }
      if (normal.norm() < barely_free)
        return false;
      node.direction[0] = normal / normal.norm();
      node.n_directions = 1;
      if (!along_surface)
        return true;
      // unit vectors, those most across the normal first, less their parts along what is there
      std::array<int, dim> order;
      for (int d = 0; d < dim; ++d)
        order[d] = d;
      std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) {
        return std::abs(node.direction[0][a]) < std::abs(node.direction[0][b]);
      });
      const int n_free = static_cast<int>(std::count(free.begin(), free.end(), true));
      for (const int d : order)
        {
          if (!free[d] || static_cast<int>(node.n_directions) == n_free)
            continue;
          dealii::Tensor<1, dim> t;
          t[d] = 1.;
          for (unsigned int i = 0; i < node.n_directions; ++i)
            t -= (t * node.direction[i]) * node.direction[i];
          node.direction[node.n_directions++] = t / t.norm();
        }
      return true;
    }
  } // namespace



  template <int dim>
  std::vector<ContactNode<dim>>
  find_contact_nodes(const ContactFields<dim> &fields, const bool along_surface)
  {
    std::array<std::vector<double>, 2> gradients;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const Patch<dim> &patch = *fields.patch[k];
        gradients[k].assign(std::size_t(patch.nodes.n_local()) * (dim + 1), 0.);
        for (const auto &batch : patch.points.batches)
          if (fields.takes_part[k][batch.body])
            dispatch_pattern<dim>(batch.pattern, AddGradients<dim>{patch, batch, gradients[k]});
      }
    const auto has_points = [&](const unsigned int k, const unsigned int node) {
      return gradients[k][std::size_t(node) * (dim + 1) + dim] > 0.;
    };
    std::vector<ContactNode<dim>> result;
    for (unsigned int i = 0; i < fields.patch[0]->nodes.n_local(); ++i)
      {
        const int j = fields.patch[1]->nodes.local(fields.patch[0]->nodes.window_node(i));
        if (j < 0 || !has_points(0, i) || !has_points(1, j))
          continue;
        ContactNode<dim> node;
        node.node = {{i, static_cast<unsigned int>(j)}};
        if (set_directions(fields,
                           outward<dim>(gradients[0], i) - outward<dim>(gradients[1], j),
                           along_surface,
                           node))
          result.push_back(node);
      }
    return result;
  }



  template <int dim>
  void
  NodalContactTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    columns.lost  = ledger.declare(
      {"contact_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    columns.friction = ledger.declare(
      {"friction_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    resultant.declare(ledger, pair);
    columns.n_nodes  = ledger.declare(contact_column("nodes", "", Kind::of_step, pair));
    columns.duration = ledger.declare(contact_column("duration", "s", Kind::total, pair));
  }



  template <int dim>
  void
  NodalContactTerm<dim>::activate(const MaterialPoints<dim> &)
  {
    nodes_ = find_contact_nodes(fields, has_friction);
  }



  template <int dim>
  dealii::Tensor<1, dim>
  NodalContactTerm<dim>::relative_displacement(const ContactNode<dim> &node,
                                               const Trial<dim>       &trial) const
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = trial.displacement(fields.number[0])[std::size_t(node.node[0]) * dim + d] -
                  trial.displacement(fields.number[1])[std::size_t(node.node[1]) * dim + d];
    return result;
  }



  template <int dim>
  Answer
  NodalContactTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    const std::vector<dealii::Tensor<1, dim>> on_first = forces(trial);
    for (unsigned int k = 0; k < 2 && !nodes_.empty(); ++k)
      {
        std::vector<double> &sums = residual.partial(fields.number[k]);
        for (std::size_t n = 0; n < nodes_.size(); ++n)
          for (int d = 0; d < dim; ++d)
            sums[std::size_t(nodes_[n].node[k]) * dim + d] +=
              k == 0 ? -on_first[n][d] : on_first[n][d];
      }
    return {};
  }



  template <int dim>
  void
  NodalContactTerm<dim>::add_slope(const ContactNode<dim>       &at,
                                   const ContactNode<dim>       &from,
                                   const dealii::Tensor<2, dim> &slope,
                                   Tangent<dim>                 &tangent) const
  {
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int l = 0; l < 2; ++l)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            tangent.add({fields.number[k], at.node[k], i},
                        {fields.number[l], from.node[l], j},
                        k == l ? -slope[i][j] : slope[i][j]);
  }



  template <int dim>
  void
  NodalContactTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    const std::vector<dealii::Tensor<1, dim>> on_first = forces(trial);
    double                                    lost = 0., friction = 0., n_closed = 0.;
    typename ResultantBooks<dim>::Sum         sum;
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      {
        const ContactNode<dim> &node = nodes_[n];
        if (on_first[n] == dealii::Tensor<1, dim>())
          continue;
        const auto   D    = relative_displacement(node, trial);
        const double work = on_first[n] * D;
        const double along_surface =
          has_friction ? work - (node.direction[0] * on_first[n]) * (node.direction[0] * D) : 0.;
        lost -= work - along_surface;
        friction -= along_surface;
        n_closed += 1.;
        dealii::Point<dim> x = fields.patch[0]->node_position(node.node[0]);
        for (int d = 0; d < dim; ++d)
          x[d] += alpha * trial.displacement(fields.number[0])[std::size_t(node.node[0]) * dim + d];
        sum.add(x, on_first[n]);
      }
    ledger.book(columns.lost, lost);
    ledger.book(columns.friction, friction);
    ledger.book(columns.n_nodes, n_closed);
    ledger.book(columns.duration, n_closed > 0. ? trial.times.dt : 0.);
    resultant.book(ledger, sum);
  }

  template class NodalContactTerm<2>;
  template class NodalContactTerm<3>;
  template bool
  is_free(const ContactFields<2> &, const std::array<unsigned int, 2> &, const unsigned int);
  template bool
  is_free(const ContactFields<3> &, const std::array<unsigned int, 2> &, const unsigned int);
  template std::vector<ContactNode<2>>
  find_contact_nodes(const ContactFields<2> &, const bool);
  template std::vector<ContactNode<3>>
  find_contact_nodes(const ContactFields<3> &, const bool);
} // namespace kedge
