#ifndef kedge_points_material_points_h
#define kedge_points_material_points_h

#include <kedge/grid/background_grid.h>
#include <kedge/points/point_layout.h>

#include <deal.II/particles/particle_handler.h>

namespace kedge
{
  /**
   * Where the numbers of the local points lie in memory: a row of n_values doubles (as
   * layout says) and a place each, until points move from cell to cell or rank to rank.
   */
  template <int dim>
  struct PointMemory
  {
    std::vector<std::uint64_t> ids; ///< of the points, in the order of the rows
    const dealii::Point<dim>  *locations = nullptr;
    const double              *states    = nullptr;
    PointLayout<dim>           layout;
  };

  /**
   * The cloud of material points with their committed history, stored cell by
   * cell in a deal.II ParticleHandler. Points are visited in the handler's
   * order; the position in that order is the point's local number until the
   * next relocation.
   */
  template <int dim>
  class MaterialPoints
  {
  public:
    /** @p layout says what of the points' states is stored: everything if nothing is said. */
    explicit MaterialPoints(const PointLayout<dim> &layout = PointLayout<dim>())
      : layout(layout)
    {}

    /**
     * Starts an empty cloud on the grid and inserts @p records: each rank
     * passes any share of them, they go to the ranks that own their cells
     * (collective). Within a cell they stand in the order given, shares of
     * lower ranks first.
     *
     * @throws dealii::ExceptionBase if a record lies outside the grid's window.
     */
    void
    distribute(const BackgroundGrid<dim> &grid, std::vector<PointRecord<dim>> records);

    /** Lets go of all points; to be called before the grid's triangulation is replaced. */
    void
    clear()
    {
      handler.reset();
    }

    /** The local points in their order. */
    std::vector<PointRecord<dim>>
    records() const;

    /** Nothing if there are gaps between the rows, as points that have left leave them. */
    std::optional<PointMemory<dim>>
    memory() const;

    unsigned int
    n_local() const
    {
      return handler ? handler->n_locally_owned_particles() : 0;
    }

    std::uint64_t
    n_global() const
    {
      return n_global_;
    }

    /** Calls visit(local number, id, location, const PointState &) for all local points. */
    template <typename Visitor>
    void
    for_each(const Visitor &visit) const
    {
      unsigned int number = 0;
      for (const auto &particle : *handler)
        visit(number++, particle.get_id(), particle.get_location(), state_of(particle));
    }

    /** Calls update(local number, location, PointState &); both may be changed. */
    template <typename Update>
    void
    update_each(const Update &update)
    {
      unsigned int number = 0;
      for (auto &particle : *handler)
        {
          dealii::Point<dim> location = particle.get_location();
          PointState<dim>    state    = state_of(particle);
          update(number++, location, state);
          layout.store(state, particle.get_properties().data());
          particle.set_location(location);
        }
    }

    /** As for_each() with the core alone, where it is stored: visit(number, id, location, core). */
    template <typename Visitor>
    void
    for_each_core(const Visitor &visit) const
    {
      unsigned int number = 0;
      for (const auto &particle : *handler)
        visit(number++,
              particle.get_id(),
              particle.get_location(),
              *reinterpret_cast<const PointCore<dim> *>(particle.get_properties().data()));
    }

    /** As update_each() with the core alone, where it is stored. */
    template <typename Update>
    void
    update_each_core(const Update &update)
    {
      unsigned int number = 0;
      for (auto &particle : *handler)
        {
          dealii::Point<dim> location = particle.get_location();
          update(number++,
                 location,
                 *reinterpret_cast<PointCore<dim> *>(particle.get_properties().data()));
          particle.set_location(location);
        }
    }

    /** Whether the points store more than their core. */
    bool
    stores_extras() const
    {
      return layout.has_extras();
    }

    /**
     * Sorts the points into the cells (and to the ranks) where they stand
     * now (collective). All must lie in the window.
     *
     * @return the number of points that went missing, which must be 0
     */
    std::uint64_t
    relocate(const BackgroundGrid<dim> &grid);

  private:
    template <typename Accessor>
    PointState<dim>
    state_of(const Accessor &particle) const
    {
      PointState<dim> state{};
      layout.load(particle.get_properties().data(), state);
      return state;
    }

    using ActiveCell = typename dealii::Triangulation<dim>::active_cell_iterator;

    /**
     * Moves the points of the cells from @p cell on that have left them, until it is
     * about so many, and sets the cell to go on from (collective).
     */
    void
    move_some(const BackgroundGrid<dim> &grid, const std::size_t most, ActiveCell &cell);
    /** Takes the points out of a cell that have left it: for this @p rank, or for others. */
    void
    take_movers(const BackgroundGrid<dim>     &grid,
                const ActiveCell              &cell,
                const unsigned int             rank,
                std::vector<PointRecord<dim>> &staying,
                std::vector<PointRecord<dim>> &leaving);
    void
    insert(const BackgroundGrid<dim> &grid, const PointRecord<dim> &record);

    PointLayout<dim>                                         layout;
    std::unique_ptr<dealii::Particles::ParticleHandler<dim>> handler;
    std::uint64_t                                            n_global_ = 0;
  };
} // namespace kedge

#endif
