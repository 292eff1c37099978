#ifndef kedge_contact_direction_updates_h
#define kedge_contact_direction_updates_h

#include <algorithm>

namespace kedge
{
  /**
   * When a contact takes its directions and partners anew in the course of a step: with the first
   * corrections of Newton's method, and once the equations are solved until its forces change no
   * more than a little.
   */
  class DirectionUpdates
  {
  public:
    /** How often at most they follow corrections, how often they are taken anew after the end. */
    static constexpr unsigned int most_follows = 2, most_passes = 3;

    /** A change of the contact's forces by less than this part of them is let be. */
    static constexpr double small_change = 1e-3;

    void
    start()
    {
      n_passes = n_tangents = n_follows = 0;
    }

    void
    count_tangent()
    {
      ++n_tangents;
    }

    /** Whether they follow the last correction; counts it. */
    bool
    follow()
    {
      if (n_follows >= std::min(n_tangents, most_follows))
        return false;
      n_follows = n_tangents;
      return true;
    }

    /**
     * Takes them anew; goes back to those before if forces stay nearly the same.
     *
     * @param forces    forces() gives those of all places, by side and place
     * @param find_anew find_anew() gives what was known before
     * @param go_back   go_back(known) takes that again
     * @return whether the equations must be solved again
     */
    template <typename ForcesOf, typename FindAnew, typename GoBack>
    bool
    pass(const ForcesOf &forces, const FindAnew &find_anew, const GoBack &go_back)
    {
      if (n_passes == most_passes)
        return false;
      const auto before = forces();
      auto       known  = find_anew();
      const auto after  = forces();
      double     size = 0., change = 0.;
      for (std::size_t k = 0; k < before.size(); ++k)
        for (std::size_t f = 0; f < before[k].size(); ++f)
          {
            size += std::max(before[k][f].norm(), after[k][f].norm());
            change += (after[k][f] - before[k][f]).norm();
          }
      if (change > small_change * size)
        {
          ++n_passes;
          return true;
        }
      go_back(known);
      return false;
    }

  private:
    unsigned int n_passes = 0, n_tangents = 0, n_follows = 0;
  };
} // namespace kedge

#endif
