#ifndef kedge_contact_tool_penetration_h
#define kedge_contact_tool_penetration_h

#include <kedge/equations/ledger.h>
#include <kedge/points/material_points.h>
#include <kedge/rigid/rigid_bodies.h>
#include <kedge/surfaces/body_surface.h>
#include <kedge/surfaces/facet_search.h>

namespace kedge
{
  /**
   * How far bodies have come into a rigid body at the end of a step, as it is seen from outside:
   * of all material points and all vertices of the surfaces, whatever the contact knows of them,
   * the largest depth in the closed surface of the tool and the number of those deeper than 0.02 of
   * a cell.
   */
  template <int dim>
  class ToolPenetration
  {
  public:
    /** Places that are deeper than this part of a cell are counted. */
    static constexpr double allowed = 0.02;

    /** @param search of the tool's facets, in its axes */
    ToolPenetration(const RigidBodies<dim> &bodies,
                    const unsigned int      tool,
                    const FacetSearch<dim> &search,
                    const double            cell_size);

    void
    declare(Ledger &ledger, const std::string &contact);

    /** Books the state that has been committed: this rank's points, and on the first the surfaces.
     */
    void
    book(Ledger                                      &ledger,
         const std::vector<const BodySurface<dim> *> &surfaces,
         const MaterialPoints<dim>                   &cloud) const;

  private:
    struct Count
    {
      double deepest = 0., n = 0.;
    };

    void
    add(const dealii::Point<dim> &x, Count &count) const;

    const RigidBodies<dim> &bodies;
    const unsigned int      tool;
    const FacetSearch<dim> &search;
    const double            cell_size;
    double                  radius  = 0.; ///< of a ball around the tool's centre [m]
    Ledger::Index           deepest = 0, number = 0;
  };
} // namespace kedge

#endif
