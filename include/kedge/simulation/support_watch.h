#ifndef kedge_simulation_support_watch_h
#define kedge_simulation_support_watch_h

#include <kedge/points/held_material.h>
#include <kedge/simulation/model.h>

namespace kedge
{
  /** Which entries go with the material where a node condition does not; for messages. */
  template <int dim>
  std::string
  entries_that_follow(const NodeConditionParameters<dim> &condition);

  /**
   * Notices when node conditions lose the material that they held at the start: those that move
   * what they hold, that prescribe a pore pressure, or that hold by a Where. A fixed side of the
   * grid is a wall, which bodies may leave.
   */
  template <int dim>
  class SupportWatch
  {
  public:
    explicit SupportWatch(const Model<dim> &model);

    struct Finding
    {
      std::vector<std::string> lines; ///< for the log
      std::string              stop;  ///< why the run cannot go on; empty if it can
    };

    /**
     * What is new after step number @p step, which has reached @p time [s]: a line when three
     * quarters of a condition's material are gone, and when all is. Without inertia, a
     * displacement since the start that holds nothing of what it has moved ends the run. Looks
     * after each of the first steps, and after every tenth or if it @p must (collective).
     */
    Finding
    look(const std::uint64_t step, const double time, const bool must);

  private:
    std::string
    line(const NodeConditionParameters<dim> &condition, const double part, const double time) const;

    const Model<dim>                                  &model;
    std::vector<const NodeConditionParameters<dim> *>  watched;
    std::vector<typename HeldMaterial<dim>::Condition> conditions;
    std::optional<HeldMaterial<dim>>                   held;
    std::vector<unsigned int>                          n_said; ///< lines of each condition
  };
} // namespace kedge

#endif
