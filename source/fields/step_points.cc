#include <kedge/fields/step_points.h>
#include <kedge/stress/point_update.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** Stable counting sort of the numbers in @p order by their @p key in [0, n_keys). */
    void
    sort_by_key(const std::vector<unsigned int> &key,
                const unsigned int               n_keys,
                std::vector<unsigned int>       &order)
    {
      std::vector<unsigned int> begin(n_keys + 1, 0);
      for (const unsigned int k : key)
        ++begin[k + 1];
      for (unsigned int k = 0; k < n_keys; ++k)
        begin[k + 1] += begin[k];
      std::vector<unsigned int> sorted(order.size());
      for (const unsigned int i : order)
        sorted[begin[key[i]]++] = i;
      order.swap(sorted);
    }

    /**
     * The level of the functions of a point: the finest of the cells that its domain touches,
     * so that they are those of the cells wherever the domain lies in them.
     */
    template <int dim>
    unsigned int
    level_of_point(const BackgroundGrid<dim>    &grid,
                   const BasisKind               basis,
                   const dealii::Point<dim>     &x,
                   const dealii::Tensor<1, dim> &half_lengths)
    {
      return grid.levels().level_at(x,
                                    basis == BasisKind::linear ? dealii::Tensor<1, dim>()
                                                               : half_lengths,
                                    gimp_smallest_overlap);
    }
  } // namespace



  template <int dim>
  StressState<dim>
  make_stress_state(const PointCore<dim> &state)
  {
    return make_stress_state<dim>(state.elastic_frame,
                                  state.out_of_plane_elastic_stretch,
                                  state.kirchhoff_stress);
  }



  template <int dim>
  void
  StepPoints<dim>::find_order(const BackgroundGrid<dim>       &grid,
                              const std::vector<unsigned int> &cell,
                              const std::vector<unsigned int> &body,
                              const std::vector<Stencil<dim>> &stencils,
                              const unsigned int               n_bodies)
  {
    const unsigned int n = cell.size();
    local_number.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      local_number[i] = i;

    std::vector<unsigned int> key = cell;
    sort_by_key(key, grid.window().n_cells_total(), local_number);
    n_cells = 0;
    for (unsigned int k = 0; k < n; ++k)
      if (k == 0 || cell[local_number[k]] != cell[local_number[k - 1]])
        ++n_cells;
    for (unsigned int i = 0; i < n; ++i)
      key[i] = stencils[i].first_node;
    sort_by_key(key, grid.window().n_nodes_total(), local_number);
    for (unsigned int i = 0; i < n; ++i)
      key[i] = body[i] * n_stencil_patterns<dim> + stencils[i].pattern;
    sort_by_key(key, n_bodies * n_stencil_patterns<dim>, local_number);

    batches.clear();
    for (unsigned int slot = 0; slot < n; ++slot)
      {
        const unsigned int i = local_number[slot];
        if (batches.empty() || batches.back().body != body[i] ||
            batches.back().pattern != stencils[i].pattern)
          batches.push_back({slot, slot, body[i], stencils[i].pattern});
        batches.back().end = slot + 1;
      }
  }



  template <int dim>
  void
  StepPoints<dim>::find_groups(const BackgroundGrid<dim>       &grid,
                               const std::vector<unsigned int> &cell,
                               const std::vector<bool>         &shared_volume)
  {
    group.clear();
    group_cell.clear();
    if (std::find(shared_volume.begin(), shared_volume.end(), true) == shared_volume.end())
      return;
    group.assign(local_number.size(), no_group);
    std::vector<unsigned int> group_in_cell;
    for (std::size_t b = 0; b < batches.size(); ++b)
      {
        const Batch &batch = batches[b];
        if (!shared_volume[batch.body])
          continue;
        if (b == 0 || batches[b - 1].body != batch.body)
          group_in_cell.assign(grid.window().n_cells_total(), no_group);
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          {
            unsigned int &here = group_in_cell[cell[local_number[slot]]];
            if (here == no_group)
              {
                here = group_cell.size();
                group_cell.push_back(cell[local_number[slot]]);
              }
            group[slot] = here;
          }
      }
  }



  template <int dim>
  void
  StepPoints<dim>::resize(const unsigned int n)
  {
    stencil.resize(n);
    mass.resize(n);
    volume.resize(n);
    location.resize(n);
    determinant.resize(n);
    velocity.resize(n);
    acceleration.resize(n);
    stress_state.resize(n);
    history.resize(std::size_t(n) * n_history);
    id.resize(n);
  }



  template <int dim>
  void
  StepPoints<dim>::set_history(const unsigned int               slot,
                               const PointState<dim>           &state,
                               const std::vector<unsigned int> &columns)
  {
    double *values = history.data() + std::size_t(slot) * n_history;
    for (unsigned int c = 0; c < columns.size(); ++c)
      values[c] = columns[c] < most_memory_columns ? state.memory[columns[c]]
                  : columns[c] == is_time_step     ? 0.
                                                   : std::log(determinant[slot]);
  }



  template <int dim>
  void
  StepPoints<dim>::set_time_step(const double dt, const MemoryColumns &columns_of_body)
  {
    if (columns_of_body.empty())
      return;
    for (const Batch &batch : batches)
      {
        const auto &columns = columns_of_body[batch.body];
        const auto  found   = std::find(columns.begin(), columns.end(), is_time_step);
        if (found == columns.end())
          continue;
        const std::size_t column = found - columns.begin();
        for (unsigned int slot = batch.begin; slot < batch.end; ++slot)
          history[std::size_t(slot) * n_history + column] = dt;
      }
  }



  template <int dim>
  void
  StepPoints<dim>::reinit(const BackgroundGrid<dim>    &grid,
                          const MaterialPoints<dim>    &points,
                          const std::vector<BasisKind> &basis_of_body,
                          const MemoryColumns          &columns_of_body,
                          const std::vector<bool>      &shared_volume,
                          const std::vector<bool>      &members)
  {
    std::vector<unsigned int> cell, body, number;
    std::vector<Stencil<dim>> stencils;
    for (auto *numbers : {&cell, &body, &number})
      numbers->reserve(points.n_local());
    stencils.reserve(points.n_local());
    points.for_each_core([&](const unsigned int i,
                             const std::uint64_t,
                             const dealii::Point<dim> &x,
                             const PointCore<dim>     &state) {
      const auto of_body = static_cast<unsigned int>(state.body);
      if (!members.empty() && !members[of_body])
        return;
      number.push_back(i);
      body.push_back(of_body);
      const unsigned int level =
        level_of_point(grid, basis_of_body[of_body], x, state.half_lengths);
      const Lattice<dim>       &lattice   = grid.levels().lattice(level);
      const LatticeWindow<dim> &numbering = grid.levels().numbering(level);
      cell.push_back(numbering.cell_number(lattice.cell_of(x)));
      stencils.push_back(
        make_stencil(basis_of_body[of_body], lattice, numbering, x, state.half_lengths));
    });
    find_order(grid, cell, body, stencils, basis_of_body.size());
    find_groups(grid, cell, shared_volume);

    n_history = 0;
    for (const auto &columns : columns_of_body)
      n_history = std::max<unsigned int>(n_history, columns.size());
    resize(number.size());
    slot_of.assign(points.n_local(), no_slot);
    for (unsigned int slot = 0; slot < number.size(); ++slot)
      {
        const unsigned int i = local_number[slot];
        stencil[slot]        = stencils[i];
        slot_of[number[i]]   = slot;
        local_number[slot]   = number[i];
      }
    read_states(points, columns_of_body);
  }



  template <int dim>
  void
  StepPoints<dim>::read_states(const MaterialPoints<dim> &points,
                               const MemoryColumns       &columns_of_body)
  {
    loaded.clear();
    const auto read_core = [&](const unsigned int        slot,
                               const std::uint64_t       point_id,
                               const dealii::Point<dim> &x,
                               const PointCore<dim>     &state) {
      id[slot] = point_id;
      if (state.loaded != 0.)
        loaded.push_back(slot);
      mass[slot]         = state.mass;
      volume[slot]       = state.reference_volume;
      location[slot]     = x;
      determinant[slot]  = dealii::determinant(state.deformation_gradient);
      velocity[slot]     = state.velocity;
      stress_state[slot] = make_stress_state(state);
    };
    if (points.stores_extras() || n_history > 0)
      points.for_each([&](const unsigned int        i,
                          const std::uint64_t       point_id,
                          const dealii::Point<dim> &x,
                          const PointState<dim>    &state) {
        const unsigned int slot = slot_of[i];
        if (slot == no_slot)
          return;
        read_core(slot, point_id, x, state);
        acceleration[slot] = state.acceleration;
        if (n_history > 0)
          set_history(slot, state, columns_of_body[static_cast<unsigned int>(state.body)]);
      });
    else // accelerations stay as resize() made them
      points.for_each_core([&](const unsigned int        i,
                               const std::uint64_t       point_id,
                               const dealii::Point<dim> &x,
                               const PointCore<dim>     &state) {
        if (slot_of[i] != no_slot)
          read_core(slot_of[i], point_id, x, state);
      });
    std::sort(loaded.begin(), loaded.end());
  }



  template <int dim>
  std::vector<unsigned char>
  StepPoints<dim>::reached_nodes(const LatticeWindow<dim> &window) const
  {
    std::vector<unsigned char> reached(window.n_nodes_total(), 0);
    const auto                 strides   = window.node_strides();
    unsigned int               last_node = static_cast<unsigned int>(-1), last_pattern = 0;
    for (const Stencil<dim> &s : stencil)
      {
        if (s.first_node == last_node && s.pattern == last_pattern)
          continue;
        last_node    = s.first_node;
        last_pattern = s.pattern;
        for (int k = 0; k < (dim == 3 ? stencil_width(s.pattern, 2) : 1); ++k)
          for (int j = 0; j < stencil_width(s.pattern, 1); ++j)
            for (int i = 0; i < stencil_width(s.pattern, 0); ++i)
              reached[s.first_node + i + j * strides[1] + (dim == 3 ? k * strides[dim - 1] : 0)] =
                1;
      }
    return reached;
  }

#define KEDGE_INSTANTIATE(dim)     \
  template struct StepPoints<dim>; \
  template StressState<dim> make_stress_state<dim>(const PointCore<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
