#include <kedge/contact/contact_books.h>
#include <kedge/contact/tool_penetration.h>
#include <kedge/contact/tool_samples.h>
#include <kedge/rigid/rotation.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  ToolPenetration<dim>::ToolPenetration(const RigidBodies<dim> &bodies,
                                        const unsigned int      tool,
                                        const FacetSearch<dim> &search,
                                        const double            cell_size)
    : bodies(bodies)
    , tool(tool)
    , search(search)
    , cell_size(cell_size)
  {
    for (const auto &x : bodies.surface(tool).vertices)
      radius = std::max(radius, x.norm());
  }



  template <int dim>
  void
  ToolPenetration<dim>::declare(Ledger &ledger, const std::string &contact)
  {
    deepest = ledger.declare(contact_column("penetration", "m", Ledger::Kind::highest, contact));
    number  = ledger.declare(contact_column("penetrating", "", Ledger::Kind::present, contact));
  }



  template <int dim>
  void
  ToolPenetration<dim>::add(const dealii::Point<dim> &x, Count &count) const
  {
    const RigidState &state = bodies[tool].state;
    const Vector3     off   = in_space<dim>(x) - state.centre;
    if (off.norm() > radius)
      return;
    const dealii::Point<dim> in_axes(in_scene<dim>(transpose(matrix_of(state.attitude)) * off));
    const double             depth = search.depth(in_axes, 0.25 * cell_size);
    count.deepest                  = std::max(count.deepest, depth);
    count.n += depth > allowed * cell_size ? 1. : 0.;
  }



  template <int dim>
  void
  ToolPenetration<dim>::book(Ledger                                      &ledger,
                             const std::vector<const BodySurface<dim> *> &surfaces,
                             const MaterialPoints<dim>                   &cloud) const
  {
    const bool is_first =
      dealii::Utilities::MPI::this_mpi_process(surfaces.front()->patch.grid().communicator()) == 0;
    Count count;
    cloud.for_each_core([&](const unsigned int,
                            const std::uint64_t,
                            const dealii::Point<dim> &location,
                            const PointCore<dim>     &core) {
      if (std::any_of(surfaces.begin(), surfaces.end(), [&](const BodySurface<dim> *surface) {
            return surface->body == static_cast<unsigned int>(core.body);
          }))
        add(location, count);
    });
    if (is_first) // all ranks have the whole surface
      for (const BodySurface<dim> *surface : surfaces)
        for (const auto &x : surface->mesh().vertices)
          add(x, count);
    ledger.book(deepest, count.deepest);
    ledger.book(number, count.n);
  }

  template class ToolPenetration<2>;
  template class ToolPenetration<3>;
} // namespace kedge
