#ifndef kedge_grid_lattice_h
#define kedge_grid_lattice_h

#include <kedge/grid/parameters.h>

#include <cmath>

namespace kedge
{
  /** Integer coordinates of a cell or node of a Cartesian grid. */
  template <int dim>
  using LatticeIndex = std::array<int, dim>;

  /**
   * The Cartesian geometry of the background grid's nodes. Cell c covers
   * [origin + c h, origin + (c+1) h]; node i stands at origin + i h. Quadratic
   * elements, and cells that carry the pore pressure alone, have a node in the
   * middle of their edges: each is made of 2^dim cells of the lattice and begins
   * at an even one.
   */
  template <int dim>
  struct Lattice
  {
    dealii::Point<dim>     origin;
    dealii::Tensor<1, dim> h; ///< cell size per direction [m]
    LatticeIndex<dim>      n_cells;
    int                    node_intervals; ///< cells of the lattice along an element's edge

    explicit Lattice(const GridParameters<dim> &parameters)
      : origin(parameters.origin)
      , node_intervals(static_cast<int>(parameters.node_intervals))
    {
      for (int d = 0; d < dim; ++d)
        {
          n_cells[d] = static_cast<int>(parameters.n_cells[d]) * node_intervals;
          h[d]       = parameters.extent[d] / n_cells[d];
        }
    }

    /** Coordinate in cell sizes from the origin. */
    double
    scaled(const double x, const int d) const
    {
      return (x - origin[d]) / h[d];
    }

    double
    upper(const int d) const
    {
      return std::fma(n_cells[d], h[d], origin[d]); // the same bits with any compiler flags
    }

    /** The cell that holds @p x; a point on the box's upper side is in the last cell. */
    LatticeIndex<dim>
    cell_of(const dealii::Point<dim> &x) const
    {
      LatticeIndex<dim> cell;
      for (int d = 0; d < dim; ++d)
        {
          cell[d] = static_cast<int>(std::floor(scaled(x[d], d)));
          if (cell[d] == n_cells[d] && x[d] <= upper(d))
            --cell[d];
        }
      return cell;
    }

    bool
    contains(const dealii::Point<dim> &x) const
    {
      for (int d = 0; d < dim; ++d)
        if (!(x[d] >= origin[d] && x[d] <= upper(d)))
          return false;
      return true;
    }

    dealii::Point<dim>
    node_position(const LatticeIndex<dim> &node) const
    {
      dealii::Point<dim> x;
      for (int d = 0; d < dim; ++d)
        x[d] = origin[d] + node[d] * h[d];
      return x;
    }

    /** [m^3; m^2 in 2D] */
    double
    cell_volume() const
    {
      double volume = 1.;
      for (int d = 0; d < dim; ++d)
        volume *= h[d];
      return volume;
    }

    double
    smallest_cell_size() const
    {
      double smallest = h[0];
      for (int d = 1; d < dim; ++d)
        smallest = std::min(smallest, h[d]);
      return smallest;
    }
  };

  /**
   * A rectangular part of the lattice, in cells [low, low + n_cells), with
   * lexicographic numbers (x fastest) for its cells and nodes.
   */
  template <int dim>
  struct LatticeWindow
  {
    LatticeIndex<dim> low     = {};
    LatticeIndex<dim> n_cells = {};

    unsigned int
    n_cells_total() const
    {
      unsigned int n = 1;
      for (int d = 0; d < dim; ++d)
        n *= n_cells[d];
      return n;
    }

    unsigned int
    n_nodes_total() const
    {
      unsigned int n = 1;
      for (int d = 0; d < dim; ++d)
        n *= n_cells[d] + 1;
      return n;
    }

    unsigned int
    cell_number(const LatticeIndex<dim> &cell) const
    {
      unsigned int number = 0;
      for (int d = dim - 1; d >= 0; --d)
        number = number * n_cells[d] + (cell[d] - low[d]);
      return number;
    }

    unsigned int
    node_number(const LatticeIndex<dim> &node) const
    {
      unsigned int number = 0;
      for (int d = dim - 1; d >= 0; --d)
        number = number * (n_cells[d] + 1) + (node[d] - low[d]);
      return number;
    }

    LatticeIndex<dim>
    node_index(unsigned int number) const
    {
      LatticeIndex<dim> node;
      for (int d = 0; d < dim; ++d)
        {
          node[d] = low[d] + static_cast<int>(number % (n_cells[d] + 1));
          number /= n_cells[d] + 1;
        }
      return node;
    }

    LatticeIndex<dim>
    cell_index(unsigned int number) const
    {
      LatticeIndex<dim> cell;
      for (int d = 0; d < dim; ++d)
        {
          cell[d] = low[d] + static_cast<int>(number % n_cells[d]);
          number /= n_cells[d];
        }
      return cell;
    }

    /** Node number's increment for one step in direction d. */
    std::array<int, dim>
    node_strides() const
    {
      std::array<int, dim> strides;
      strides[0] = 1;
      for (int d = 1; d < dim; ++d)
        strides[d] = strides[d - 1] * (n_cells[d - 1] + 1);
      return strides;
    }

    bool
    contains_cell(const LatticeIndex<dim> &cell, const int margin = 0) const
    {
      for (int d = 0; d < dim; ++d)
        if (cell[d] < low[d] + margin || cell[d] >= low[d] + n_cells[d] - margin)
          return false;
      return true;
    }
  };
} // namespace kedge

#endif
