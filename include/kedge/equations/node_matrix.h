#ifndef kedge_equations_node_matrix_h
#define kedge_equations_node_matrix_h

#include <kedge/fields/patch.h>

namespace kedge
{
  /**
   * A matrix that couples each node with the nodes of the (2 radius + 1)^dim
   * lattice neighbourhood around it, by blocks of n_components x n_components. Rows
   * are the local active nodes; a block is found from the lattice offset of
   * its two nodes, so assembly needs no sparsity pattern. On several ranks
   * each holds the sum over its own points; the shares are added up only when
   * a linear system is formed (EquationSystem).
   *
   * Storage: values[((row * n_components + p) * n_slots + slot) * n_components + m].
   */
  template <int dim>
  class NodeMatrix
  {
  public:
    void
    reinit(const unsigned int n_rows, const unsigned int n_components, const int radius)
    {
      n_components_ = n_components;
      radius_       = radius;
      n_slots_      = 1;
      for (int d = 0; d < dim; ++d)
        n_slots_ *= 2 * radius + 1;
      values_.resize(std::size_t(n_rows) * n_components * n_slots_ * n_components);
    }

    void
    set_zero()
    {
      std::fill(values_.begin(), values_.end(), 0.);
    }

    unsigned int
    n_slots() const
    {
      return n_slots_;
    }

    unsigned int
    n_components() const
    {
      return n_components_;
    }

    int
    radius() const
    {
      return radius_;
    }

    /** Slot of a node's neighbour at lattice offset @p offset. */
    unsigned int
    slot(const LatticeIndex<dim> &offset) const
    {
      int number = 0;
      for (int d = dim - 1; d >= 0; --d)
        number = number * (2 * radius_ + 1) + offset[d] + radius_;
      return number;
    }

    /** Lattice offset of a slot. */
    LatticeIndex<dim>
    offset(unsigned int slot) const
    {
      LatticeIndex<dim> result;
      for (int d = 0; d < dim; ++d)
        {
          result[d] = static_cast<int>(slot % (2 * radius_ + 1)) - radius_;
          slot /= 2 * radius_ + 1;
        }
      return result;
    }

    /** Change of the window node number from a node to its neighbour at each slot. */
    std::vector<int>
    slot_strides(const LatticeWindow<dim> &window) const
    {
      const auto       strides = window.node_strides();
      std::vector<int> result(n_slots_);
      for (unsigned int s = 0; s < n_slots_; ++s)
        {
          int rest = s, step = 0;
          for (int d = 0; d < dim; ++d)
            {
              step += (rest % (2 * radius_ + 1) - radius_) * strides[d];
              rest /= 2 * radius_ + 1;
            }
          result[s] = step;
        }
      return result;
    }

    /** Values of row @p node, component @p p: n_slots x n_components. */
    double *
    row(const unsigned int node, const unsigned int p)
    {
      return values_.data() + (std::size_t(node) * n_components_ + p) * n_slots_ * n_components_;
    }

    const double *
    row(const unsigned int node, const unsigned int p) const
    {
      return values_.data() + (std::size_t(node) * n_components_ + p) * n_slots_ * n_components_;
    }

    /** Values per node. */
    unsigned int
    row_size() const
    {
      return n_components_ * n_slots_ * n_components_;
    }

    std::vector<double> &
    values()
    {
      return values_;
    }

    const std::vector<double> &
    values() const
    {
      return values_;
    }

  private:
    unsigned int        n_components_ = 0;
    unsigned int        n_slots_      = 0;
    int                 radius_       = 0;
    std::vector<double> values_;
  };

  /** Calls visit(slot, local node) for the active nodes at all slots of a local node's row. */
  template <int dim, typename Visit>
  inline void
  for_neighbours(const Patch<dim>      &patch,
                 const unsigned int     node,
                 const NodeMatrix<dim> &matrix,
                 const Visit           &visit)
  {
    const auto &window  = patch.window();
    const auto &nodes   = patch.nodes;
    const auto  here    = window.node_index(nodes.window_node(node));
    const auto  strides = window.node_strides();
    const int   radius = matrix.radius(), width = 2 * radius + 1;
    int         low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (int d = 0; d < dim; ++d)
      {
        low[d]  = std::max(-radius, window.low[d] - here[d]);
        high[d] = std::min(radius, window.low[d] + window.n_cells[d] - here[d]);
      }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          {
            int step = i * int(strides[0]) + j * int(strides[1]);
            int slot = i + radius + width * (j + radius);
            if constexpr (dim == 3)
              {
                step += k * int(strides[2]);
                slot += width * width * (k + radius);
              }
            const int local = nodes.local(nodes.window_node(node) + step);
            if (local >= 0)
              visit(static_cast<unsigned int>(slot), static_cast<unsigned int>(local));
          }
  }

  /**
   * Where the nodes of a stencil stand in the row of each of them: [A][run] is the
   * slot of the first node of each run in x direction. The others of a run follow.
   */
  template <int dim, unsigned int pattern>
  using RowSlots =
    std::array<std::array<unsigned int, stencil_size<dim>(pattern) / stencil_width(pattern, 0)>,
               stencil_size<dim>(pattern)>;

  template <int dim, unsigned int pattern>
  inline RowSlots<dim, pattern>
  row_slots(const NodeMatrix<dim> &matrix)
  {
    constexpr int n = stencil_size<dim>(pattern), run = stencil_width(pattern, 0);
    const auto    coordinates = [](int A) {
      LatticeIndex<dim> index;
      for (int d = 0; d < dim; ++d)
        {
          index[d] = A % stencil_width(pattern, d);
          A /= stencil_width(pattern, d);
        }
      return index;
    };
    RowSlots<dim, pattern> slots;
    for (int A = 0; A < n; ++A)
      for (int r = 0; r < n / run; ++r)
        {
          const auto        a = coordinates(A), b = coordinates(r * run);
          LatticeIndex<dim> offset;
          for (int d = 0; d < dim; ++d)
            offset[d] = b[d] - a[d];
          slots[A][r] = matrix.slot(offset);
        }
    return slots;
  }

  /** Adds @p values, n_components per node of the stencil, to a row; slots from row_slots(). */
  template <int dim, unsigned int pattern, int n_components = dim>
  inline void
  add_to_row(
    const std::array<unsigned int, stencil_size<dim>(pattern) / stencil_width(pattern, 0)> &slots,
    const double                                                                           *values,
    double                                                                                 *row)
  {
    constexpr int length = stencil_width(pattern, 0) * n_components;
    for (const unsigned int slot : slots)
      {
        double *target = row + slot * n_components;
        for (int e = 0; e < length; ++e)
          target[e] += values[e];
        values += length;
      }
  }
} // namespace kedge

#endif
