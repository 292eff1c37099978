#include <kedge/grid/background_grid.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>

namespace kedge
{
  namespace
  {
    /** Cells kept free around the points, so that a window serves many steps. */
    constexpr int window_margin = 4;

    /** One p4est tree per cell is dear; larger windows are refined from fewer trees. */
    constexpr unsigned int most_trees = 4096;
  } // namespace



  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const GridParameters<dim> &parameters,
                                      const MPI_Comm             communicator)
    : levels_(Lattice<dim>(parameters))
    , communicator_(communicator)
    , element(dealii::FE_Q<dim>(1), dim)
  {}



  template <int dim>
  void
  BackgroundGrid<dim>::cover(const LatticeWindow<dim>        &cells,
                             const std::vector<unsigned int> &weights)
  {
    ++generation_;
    LatticeWindow<dim> window;
    for (int d = 0; d < dim; ++d)
      {
        const int spread = std::max(window_margin, cells.n_cells[d] / 8);
        window.low[d]    = std::max(0, cells.low[d] - spread);
        window.low[d] -= window.low[d] % lattice().node_intervals; // whole elements
        const int end = std::min(lattice().n_cells[d], cells.low[d] + cells.n_cells[d] + spread);
        window.n_cells[d] = std::max(2, end - window.low[d]); // room for three nodes
      }
    n_refinements = 0;
    while (window.n_cells_total() >> (dim * n_refinements) > most_trees)
      ++n_refinements;
    const int unit = std::max(1 << n_refinements, lattice().node_intervals);
    for (int d = 0; d < dim; ++d)
      window.n_cells[d] = (window.n_cells[d] + unit - 1) / unit * unit;
    levels_.cover(window);

    create_triangulation(weights, cells);
    tabulate_cells();
    tabulate_node_owners();
  }



  template <int dim>
  bool
  BackgroundGrid<dim>::refine(const std::vector<unsigned char> &wanted)
  {
    Assert(!parallel(), dealii::ExcNotImplemented());
    if (!levels_.refine(wanted))
      return false;
    ++generation_;
    cell_owners.assign(window().n_cells_total(), 0);
    tabulate_node_owners();
    return true;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::create_triangulation(const std::vector<unsigned int> &weights,
                                            const LatticeWindow<dim>        &weighted_cells)
  {
    using Distributed = dealii::parallel::distributed::Triangulation<dim>;
    cell_iterators.clear();
    dof_handler.reset();
    // p4est takes four times as long as one process needs without it
    if (parallel())
      triangulation_ = std::make_unique<Distributed>(communicator_);
    else
      triangulation_ = std::make_unique<dealii::Triangulation<dim>>();

    dealii::Point<dim>        low = lattice().node_position(coarsest().low), high;
    std::vector<unsigned int> trees(dim);
    for (int d = 0; d < dim; ++d)
      {
        high[d] =
          lattice().origin[d] + (coarsest().low[d] + coarsest().n_cells[d]) * lattice().h[d];
        trees[d] = coarsest().n_cells[d] >> n_refinements;
      }
    dealii::GridGenerator::subdivided_hyper_rectangle(*triangulation_, trees, low, high);
    if (n_refinements > 0)
      triangulation_->refine_global(n_refinements);
    if (!parallel())
      return;

    share_out_cells(dynamic_cast<Distributed &>(*triangulation_), weights, weighted_cells);
    dof_handler = std::make_unique<dealii::DoFHandler<dim>>(*triangulation_);
    dof_handler->distribute_dofs(element);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::share_out_cells(dealii::parallel::distributed::Triangulation<dim> &cells,
                                       const std::vector<unsigned int>                   &weights,
                                       const LatticeWindow<dim> &weighted_cells) const
  {
    // an empty cell weighs 1, so that empty regions are shared out too
    const auto weight = [&](const auto &cell, const auto) -> unsigned int {
      const LatticeIndex<dim> index = lattice().cell_of(cell->center());
      return 1u + (weighted_cells.contains_cell(index)
                     ? 1000u * weights[weighted_cells.cell_number(index)]
                     : 0u);
    };
    const auto connection = cells.signals.weight.connect(weight);
    cells.repartition();
    connection.disconnect();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::tabulate_cells()
  {
    cell_iterators.assign(coarsest().n_cells_total(), triangulation_->end());
    cell_owners.assign(window().n_cells_total(), 0);
    for (const auto &cell : triangulation_->active_cell_iterators())
      if (!cell->is_artificial())
        {
          LatticeIndex<dim> index;
          const auto        center = cell->center();
          for (int d = 0; d < dim; ++d)
            index[d] = static_cast<int>(std::floor(lattice().scaled(center[d], d)));
          cell_iterators[coarsest().cell_number(index)] = cell;
          cell_owners[window().cell_number(index)]      = cell->subdomain_id();
        }
    MPI_Allreduce(MPI_IN_PLACE,
                  cell_owners.data(),
                  static_cast<int>(cell_owners.size()),
                  MPI_UNSIGNED,
                  MPI_MAX,
                  communicator_);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::tabulate_node_owners()
  {
    node_owners.assign(window().n_nodes_total(), 0);
    if (!parallel())
      return;

    const auto ranges =
      dealii::Utilities::MPI::all_gather(communicator_, dof_handler->locally_owned_dofs());
    std::vector<dealii::types::global_dof_index> first_of_next;
    for (const auto &range : ranges)
      first_of_next.push_back((first_of_next.empty() ? 0 : first_of_next.back()) +
                              range.n_elements());

    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int v : cell->vertex_indices())
          {
            LatticeIndex<dim> node;
            for (int d = 0; d < dim; ++d)
              node[d] = static_cast<int>(std::lround(lattice().scaled(cell->vertex(v)[d], d)));
            const auto dof                            = cell->vertex_dof_index(v, 0);
            node_owners[coarsest().node_number(node)] = static_cast<unsigned int>(
              std::upper_bound(first_of_next.begin(), first_of_next.end(), dof) -
              first_of_next.begin());
          }
    // what lies far from this rank's cells, other ranks know
    MPI_Allreduce(MPI_IN_PLACE,
                  node_owners.data(),
                  static_cast<int>(node_owners.size()),
                  MPI_UNSIGNED,
                  MPI_MAX,
                  communicator_);
  }



  template <int dim>
  bool
  BackgroundGrid<dim>::too_close_to_border(const LatticeIndex<dim> &cell) const
  {
    for (int d = 0; d < dim; ++d)
      {
        if (cell[d] <= coarsest().low[d] && coarsest().low[d] > 0)
          return true;
        const int end = coarsest().low[d] + coarsest().n_cells[d];
        if (cell[d] >= end - 1 && end < lattice().n_cells[d])
          return true;
      }
    return false;
  }

  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace kedge
