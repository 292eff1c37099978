#ifndef kedge_fields_step_points_h
#define kedge_fields_step_points_h

#include <kedge/basis/stencil.h>
#include <kedge/materials/history.h>
#include <kedge/points/material_points.h>
#include <kedge/stress/relative_stress.h>

namespace kedge
{
  /** For each body, where the columns of its law's history stand in PointState::memory. */
  using MemoryColumns = std::vector<std::vector<unsigned int>>;

  /**
   * What a step needs of the material points, in contiguous arrays: slot k
   * of every array is the same point. It is filled from the committed history
   * at the start of a step and read-only until the step is accepted.
   *
   * Slots are ordered so that points of one kind (body, stencil pattern)
   * stand together in a batch, and within a batch points with the same nodes
   * one after the other. The order depends on the points' cells and on their
   * order within a cell, on nothing else.
   */
  template <int dim>
  struct StepPoints
  {
    /** Consecutive slots [begin, end) of one body and stencil pattern. */
    struct Batch
    {
      unsigned int begin, end;
      unsigned int body;
      unsigned int pattern;
    };

    std::vector<Batch>                  batches;
    std::vector<unsigned int>           local_number; ///< in the cloud's order
    std::vector<std::uint64_t>          id;
    std::vector<Stencil<dim>>           stencil;
    std::vector<double>                 mass;         ///< [kg]
    std::vector<double>                 volume;       ///< V0 [m^3]
    std::vector<double>                 determinant;  ///< det F_n
    std::vector<dealii::Point<dim>>     location;     ///< x_n [m]
    std::vector<dealii::Tensor<1, dim>> velocity;     ///< [m/s]
    std::vector<dealii::Tensor<1, dim>> acceleration; ///< [m/s^2]
    std::vector<StressState<dim>>       stress_state;
    std::vector<double>                 history;       ///< of the laws, see history_of()
    unsigned int                        n_history = 0; ///< numbers per slot in history
    std::vector<unsigned int>           slot_of; ///< of each point in the cloud's order, or no_slot
    unsigned int                        n_cells = 0; ///< cells with points
    std::vector<unsigned int>           loaded;      ///< slots of the points that carry loads

    /** Slot of the points of other fields' bodies. */
    static constexpr unsigned int no_slot = static_cast<unsigned int>(-1);

    /**
     * Groups of the points of one body in one cell, of bodies whose points
     * share their change of volume: each slot's group (no_group in other
     * bodies; empty if there is no such body), and each group's cell.
     */
    static constexpr unsigned int no_group = static_cast<unsigned int>(-1);
    std::vector<unsigned int>     group;
    std::vector<unsigned int>     group_cell; ///< number in the window

    /**
     * Reads the cloud; @p basis_of_body says which stencil each body uses,
     * @p columns_of_body where the columns of a body's history stand in
     * PointState::memory (not_in_memory: it is ln det F; is_time_step: see
     * set_time_step(); empty: no body has a history), @p shared_volume whose points share their
     * change of volume (empty: nobody's), @p members which bodies' points to take (empty: all).
     */
    void
    reinit(const BackgroundGrid<dim>    &grid,
           const MaterialPoints<dim>    &points,
           const std::vector<BasisKind> &basis_of_body,
           const MemoryColumns          &columns_of_body = {},
           const std::vector<bool>      &shared_volume   = {},
           const std::vector<bool>      &members         = {});

    /** Tells the histories whose laws ask for it how long the step is [s]. */
    void
    set_time_step(const double dt, const MemoryColumns &columns_of_body);

    /** Numbers of the history of the point in a slot, in the columns of its body's law. */
    const double *
    history_values(const unsigned int slot) const
    {
      return history.data() + std::size_t(slot) * n_history;
    }

    /** History of the point in a slot whose body is of this Material. */
    template <class Material>
    HistoryOf<Material>
    history_of(const unsigned int slot) const
    {
      return read_history<Material>(history_values(slot));
    }

    /** Whether the points of a batch share their change of volume. */
    bool
    is_grouped(const Batch &batch) const
    {
      return !group.empty() && group[batch.begin] != no_group;
    }

    unsigned int
    size() const
    {
      return static_cast<unsigned int>(local_number.size());
    }

    /** Nodes of the window that have a basis function other than zero at some point. */
    std::vector<unsigned char>
    reached_nodes(const LatticeWindow<dim> &window) const;

  private:
    void
    resize(const unsigned int n);
    /** Fills the slots from the cloud; those of points that it takes are known. */
    void
    read_states(const MaterialPoints<dim> &points, const MemoryColumns &columns_of_body);
    void
    set_history(const unsigned int               slot,
                const PointState<dim>           &state,
                const std::vector<unsigned int> &columns);
    void
    find_order(const BackgroundGrid<dim>       &grid,
               const std::vector<unsigned int> &cell,
               const std::vector<unsigned int> &body,
               const std::vector<Stencil<dim>> &stencils,
               const unsigned int               n_bodies);
    void
    find_groups(const BackgroundGrid<dim>       &grid,
                const std::vector<unsigned int> &cell,
                const std::vector<bool>         &shared_volume);
  };

  /** The stress state of a committed history. */
  template <int dim>
  StressState<dim>
  make_stress_state(const PointCore<dim> &state);

  /**
   * All basis functions of a stencil of a given pattern: N_A and dN_A/dx_d,
   * nodes in lexicographic order, x fastest.
   */
  template <int dim, int n_nodes>
  struct BasisValues
  {
    double value[n_nodes];
    double gradient[dim][n_nodes]; ///< [1/m]
  };

  template <int dim, unsigned int pattern>
  inline BasisValues<dim, stencil_size<dim>(pattern)>
  expand(const Stencil<dim> &stencil)
  {
    constexpr int wx = stencil_width(pattern, 0), wy = stencil_width(pattern, 1);
    BasisValues<dim, stencil_size<dim>(pattern)> basis;
    if constexpr (dim == 2)
      {
        for (int j = 0; j < wy; ++j)
          for (int i = 0; i < wx; ++i)
            {
              const int A          = i + wx * j;
              basis.value[A]       = stencil.value[0][i] * stencil.value[1][j];
              basis.gradient[0][A] = stencil.slope[0][i] * stencil.value[1][j];
              basis.gradient[1][A] = stencil.value[0][i] * stencil.slope[1][j];
            }
      }
    else
      {
        constexpr int wz = stencil_width(pattern, 2);
        for (int k = 0; k < wz; ++k)
          for (int j = 0; j < wy; ++j)
            {
              const double v_yz = stencil.value[1][j] * stencil.value[2][k];
              const double y_yz = stencil.slope[1][j] * stencil.value[2][k];
              const double z_yz = stencil.value[1][j] * stencil.slope[2][k];
              for (int i = 0; i < wx; ++i)
                {
                  const int A          = i + wx * (j + wy * k);
                  basis.value[A]       = stencil.value[0][i] * v_yz;
                  basis.gradient[0][A] = stencil.slope[0][i] * v_yz;
                  basis.gradient[1][A] = stencil.value[0][i] * y_yz;
                  basis.gradient[2][A] = stencil.value[0][i] * z_yz;
                }
            }
      }
    return basis;
  }

  /** Window-number offsets of the nodes of a pattern from its first node. */
  template <int dim, unsigned int pattern>
  inline std::array<unsigned int, stencil_size<dim>(pattern)>
  node_offsets(const std::array<int, dim> &strides)
  {
    std::array<unsigned int, stencil_size<dim>(pattern)> offsets;
    int                                                  A = 0;
    for (int k = 0; k < (dim == 3 ? stencil_width(pattern, 2) : 1); ++k)
      for (int j = 0; j < stencil_width(pattern, 1); ++j)
        for (int i = 0; i < stencil_width(pattern, 0); ++i)
          {
            unsigned int offset = i * strides[0] + j * strides[1];
            if constexpr (dim == 3)
              offset += k * strides[2];
            offsets[A++] = offset;
          }
    return offsets;
  }

  namespace internal
  {
    /** Runs the worker if the pattern has the digits of @p number to the base n_widths. */
    template <int dim, int n_widths, unsigned int number, typename Worker>
    inline bool
    run_if_pattern(const unsigned int pattern, Worker &worker)
    {
      constexpr unsigned int candidate =
        pattern_part(2 + number % n_widths, 0) | pattern_part(2 + number / n_widths % n_widths, 1) |
        (dim == 3 ? pattern_part(2 + number / (n_widths * n_widths), 2) : 0u);
      if (pattern != candidate)
        return false;
      worker.template run<candidate>();
      return true;
    }

    template <int dim, int n_widths, typename Worker, unsigned int... number>
    inline void
    dispatch_pattern(const unsigned int pattern,
                     Worker            &worker,
                     std::integer_sequence<unsigned int, number...>)
    {
      const bool found = (run_if_pattern<dim, n_widths, number>(pattern, worker) || ...);
      AssertThrow(found, dealii::ExcInternalError());
    }
  } // namespace internal

  /**
   * Calls worker.template run<pattern>() with the pattern as a compile-time
   * constant: once per batch. Each pattern makes code of its own; workers that never see
   * splines say so by @p most_nodes, in a direction.
   */
  template <int dim, int most_nodes = most_stencil_nodes, typename Worker>
  inline void
  dispatch_pattern(const unsigned int pattern, Worker &&worker)
  {
    constexpr int n_widths = most_nodes - 1;
    internal::dispatch_pattern<dim, n_widths>(
      pattern,
      worker,
      std::make_integer_sequence<unsigned int, n_widths * n_widths *(dim == 3 ? n_widths : 1)>());
  }
} // namespace kedge

#endif
