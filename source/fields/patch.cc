#include <kedge/fields/patch.h>

#include <deal.II/base/mpi.h>

#include <sstream>

namespace kedge
{
  template <int dim>
  Patch<dim>::Patch(const BackgroundGrid<dim> &grid,
                    const PatchParameters     &parameters,
                    const NodeConditions<dim> &conditions)
    : conditions(conditions)
    , background(grid)
    , parameters(parameters)
  {}



  template <int dim>
  void
  Patch<dim>::reinit(const MaterialPoints<dim> &cloud, const Reach &reach, const Reach &claim)
  {
    points.reinit(background,
                  cloud,
                  parameters.basis_of_body,
                  parameters.columns_of_body,
                  parameters.shared_volume,
                  parameters.holds_body);
    auto reached = points.reached_nodes(background.window());
    if (claim)
      claim(reached);
    ties.find(background, points, parameters.smallest_filling, reached, parameters.coarse_pressure);
    reach(reached);
    new_nodes_   = nodes.reinit(background, reached);
    new_pattern_ = new_nodes_ || ties.changed();
    if (new_nodes_)
      conditions.reinit(background, nodes);
    else if (conditions.follows_time())
      new_pattern_ =
        dealii::Utilities::MPI::logical_or(conditions.reinit(background, nodes) || new_pattern_,
                                           background.communicator());
    if (!new_pattern_)
      return;
    ties.localise(nodes, conditions);
    constraints.reinit(nodes, conditions, ties, parameters.n_components);
  }



  template <int dim>
  std::string
  Patch<dim>::describe_point(const unsigned int slot) const
  {
    std::ostringstream text;
    text << "material point " << points.id[slot];
    for (const auto &batch : points.batches)
      if (slot >= batch.begin && slot < batch.end)
        text << " of body '" << parameters.body_names[batch.body] << "'";
    text << " at (" << points.location[slot] << ")";
    return text.str();
  }

  template class Patch<2>;
  template class Patch<3>;
} // namespace kedge
