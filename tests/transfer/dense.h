// Dense counterparts of the sums over points, from the records of the whole
// cloud and directly evaluated basis functions. Every rank computes all.
#ifndef kedge_tests_transfer_dense_h
#define kedge_tests_transfer_dense_h

#include "../basis/direct.h"
#include "cloud.h"

namespace kedge::test
{
  /** A cloud as dense arrays; rows are nodes of the window, columns points by id. */
  template <int dim>
  class DenseCloud
  {
  public:
    DenseCloud(const Cloud<dim> &cloud, const std::vector<BasisKind> &basis_of_body)
      : n_nodes(cloud.window().n_nodes_total())
      , n_points(cloud.records.size())
      , basis(n_nodes * n_points)
      , mass(n_points)
      , number(n_nodes)
    {
      for (std::size_t p = 0; p < n_points; ++p)
        {
          const auto &record = cloud.records[p];
          mass[p]            = record.state.mass;
          for (std::size_t A = 0; A < n_nodes; ++A)
            basis[A * n_points + p] =
              direct_value<dim>(basis_of_body[static_cast<unsigned int>(record.state.body)],
                                cloud.grid.lattice(),
                                record.location,
                                record.state.half_lengths,
                                cloud.window().node_index(A));
        }
      tabulate_mass();
    }

    double
    N(const std::size_t node, const std::size_t point) const
    {
      return basis[node * n_points + point];
    }

    /** (3.118) and (3.161): sum_p m N_A (N_B or, lumped, delta_AB). */
    double
    effective_mass(const double epsilon, const std::size_t A, const std::size_t B) const
    {
      if (number[A] < 0 || number[B] < 0)
        return 0.;
      return (1. - epsilon) * consistent[number[A] * n_reached + number[B]] +
             (A == B ? epsilon * lumped[number[A]] : 0.);
    }

    const std::size_t   n_nodes, n_points;
    std::vector<double> basis; ///< [node][point]
    std::vector<double> mass;

  private:
    void
    tabulate_mass()
    {
      for (std::size_t A = 0; A < n_nodes; ++A)
        {
          double sum = 0.;
          for (std::size_t p = 0; p < n_points; ++p)
            sum += mass[p] * N(A, p);
          number[A] = sum > 0. ? static_cast<int>(n_reached++) : -1;
          if (sum > 0.)
            lumped.push_back(sum);
        }
      consistent.assign(n_reached * n_reached, 0.);
      for (std::size_t p = 0; p < n_points; ++p)
        for (std::size_t A = 0; A < n_nodes; ++A)
          if (N(A, p) != 0.)
            for (std::size_t B = 0; B < n_nodes; ++B)
              if (N(B, p) != 0.)
                consistent[number[A] * n_reached + number[B]] += mass[p] * N(A, p) * N(B, p);
    }

    std::size_t         n_reached = 0;
    std::vector<int>    number; ///< of each reached node among them, or -1
    std::vector<double> consistent, lumped;
  };

  /** The values of all ranks' own nodes of a nodal array, by window number: [node][component]. */
  template <int dim>
  std::vector<double>
  by_window(const Cloud<dim> &cloud, const std::vector<double> &nodal, const unsigned int width)
  {
    std::vector<double> all(std::size_t(cloud.window().n_nodes_total()) * width, 0.);
    for (unsigned int i = 0; i < cloud.nodes.n_owned(); ++i)
      for (unsigned int c = 0; c < width; ++c)
        all[std::size_t(cloud.nodes.window_node(i)) * width + c] =
          nodal[std::size_t(i) * width + c];
    dealii::Utilities::MPI::sum(all, MPI_COMM_WORLD, all);
    return all;
  }
} // namespace kedge::test

#endif
