#ifndef kedge_fields_active_nodes_h
#define kedge_fields_active_nodes_h

#include <kedge/grid/background_grid.h>

namespace kedge
{
  /**
   * The nodes that material points reach in this step, numbered compactly.
   * Locally there come first the nodes this rank owns, then those that its
   * points reach but other ranks own. Nodal arrays hold `width` values per
   * local node.
   */
  template <int dim>
  class ActiveNodes
  {
  public:
    /**
     * Takes the nodes flagged in @p reached (one entry per node of the
     * window) by this rank; adds what other ranks reach of the nodes owned
     * here (collective).
     *
     * @return true if the set, or its numbering, differs from the last one
     */
    bool
    reinit(const BackgroundGrid<dim> &grid, const std::vector<unsigned char> &reached);

    unsigned int
    n_owned() const
    {
      return n_owned_;
    }

    unsigned int
    n_local() const
    {
      return static_cast<unsigned int>(window_nodes.size());
    }

    std::uint64_t
    n_global() const
    {
      return n_global_;
    }

    /** Local number of a window node, or -1. */
    int
    local(const unsigned int window_node) const
    {
      return local_numbers[window_node];
    }

    unsigned int
    window_node(const unsigned int local) const
    {
      return window_nodes[local];
    }

    /** Adds the values at ghosts to their owners' and leaves the ghosts as they are. */
    void
    add_to_owners(std::vector<double> &values, const unsigned int width) const;

    /** Copies the owners' values to the ghosts. */
    void
    update_ghosts(std::vector<double> &values, const unsigned int width) const;

    /** Same for integers (numbers of equations). */
    void
    update_ghosts(std::vector<std::int64_t> &values, const unsigned int width) const;

    /**
     * Sends `width` integers per ghost to its owner and hands each arriving
     * row to @p receive(owned local number, row).
     */
    void
    send_to_owners(const std::vector<std::int64_t>                               &values,
                   const unsigned int                                             width,
                   const std::function<void(unsigned int, const std::int64_t *)> &receive) const;

    /** The same for doubles. */
    void
    send_to_owners(const std::vector<double>                               &values,
                   const unsigned int                                       width,
                   const std::function<void(unsigned int, const double *)> &receive) const;

    MPI_Comm
    communicator() const
    {
      return communicator_;
    }

  private:
    struct Neighbour
    {
      unsigned int              rank;
      std::vector<unsigned int> ghosts; ///< local numbers here, owned by that rank
      std::vector<unsigned int> owned;  ///< local numbers here, ghosts on that rank
    };

    void
    find_neighbours(const BackgroundGrid<dim>                               &grid,
                    const std::map<unsigned int, std::vector<unsigned int>> &ghost_nodes,
                    std::vector<unsigned int>                               &owned_nodes);

    template <typename T>
    void
    exchange(const std::vector<T>                               &values,
             const unsigned int                                  width,
             const bool                                          to_owners,
             const std::function<void(unsigned int, const T *)> &receive) const;

    MPI_Comm                  communicator_ = MPI_COMM_NULL;
    unsigned int              generation    = 0;
    unsigned int              n_owned_      = 0;
    std::uint64_t             n_global_     = 0;
    std::vector<int>          local_numbers;
    std::vector<unsigned int> window_nodes;
    std::vector<Neighbour>    neighbours;
  };
} // namespace kedge

#endif
