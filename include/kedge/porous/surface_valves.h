#ifndef kedge_porous_surface_valves_h
#define kedge_porous_surface_valves_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kedge
{
  /** What a place on a surface with a prescribed pressure lets through. */
  enum class SurfaceFlow : unsigned char
  {
    both_ways,
    one_way, ///< what would leave; nothing that would come in
    closed   ///< nothing
  };

  /**
   * Which places of seepage faces are open in an attempt at a step. Each is a valve: it takes part
   * in Newton's method as what leaves or nothing, as the iterate would have it. If that has not
   * settled after some iterations, places are held as they are, the equations solved, and what
   * is wrong then is turned over, a few times at most.
   */
  class SurfaceValves
  {
  public:
    /** Tangents in which places are free. */
    static constexpr unsigned int free_tangents = 10;

    /** How often places that are held are turned over. */
    static constexpr unsigned int most_passes = 10;

    /** Takes the places of a new configuration. */
    void
    reinit(const std::vector<bool> &is_valve)
    {
      valves = is_valve;
      start();
    }

    /** A new attempt: all are free. */
    void
    start()
    {
      n_tangents = n_passes = 0;
      flows_.assign(valves.size(), SurfaceFlow::both_ways);
      for (std::size_t f = 0; f < valves.size(); ++f)
        if (valves[f])
          flows_[f] = SurfaceFlow::one_way;
    }

    /** One per place. */
    const std::vector<SurfaceFlow> &
    flows() const
    {
      return flows_;
    }

    /** Counts a tangent: whether places are to be held from here on. */
    bool
    count_tangent()
    {
      return ++n_tangents == free_tangents;
    }

    /** Whether the state of held places is to be looked at again. */
    bool
    may_turn() const
    {
      return n_tangents >= free_tangents && n_passes < most_passes;
    }

    /**
     * Holds each valve open or closed by what would leave if all were open.
     *
     * @return whether one is turned over
     */
    bool
    hold(const std::vector<double> &would_leave)
    {
      bool changed = false;
      for (std::size_t f = 0; f < valves.size(); ++f)
        if (valves[f])
          {
            const SurfaceFlow flow =
              would_leave[f] > 0. ? SurfaceFlow::both_ways : SurfaceFlow::closed;
            changed   = changed || flow != flows_[f];
            flows_[f] = flow;
          }
      ++n_passes;
      return changed;
    }

  private:
    std::vector<bool>        valves; ///< places of seepage faces
    std::vector<SurfaceFlow> flows_;
    unsigned int             n_tangents = 0, n_passes = 0;
  };
} // namespace kedge

#endif
