#ifndef kedge_contact_closed_contact_h
#define kedge_contact_closed_contact_h

#include <kedge/contact/contact_law.h>
#include <kedge/surfaces/body_surface.h>

#include <map>

namespace kedge
{
  /** What the middle of a facet carries from step to step while it is closed. */
  template <int dim>
  struct ClosedContact
  {
    double                 gap = 0., multiplier = 0.; ///< [m], [Pa]
    dealii::Tensor<1, dim> slip;                      ///< its elastic part [m]
  };

  /**
   * The mean over a facet of what its parts carry, as pairs with their shares of its area; what is
   * left of the area carries nothing. The law's pressure is linear in it: force and moment stay
   * what they were, and the stored energy does not grow.
   */
  template <int dim, class Memory>
  ClosedContact<dim>
  mean_of_parts(const std::vector<std::pair<const Memory *, double>> &parts)
  {
    ClosedContact<dim> mean;
    for (const auto &[part, share] : parts)
      {
        mean.gap += share * part->gap;
        mean.multiplier += share * part->multiplier;
        mean.slip += share * part->slip;
      }
    return mean;
  }

  /** The same where the partner is a facet too, and the normal that of the place. */
  template <int dim>
  struct PartneredContact : ClosedContact<dim>
  {
    unsigned int           partner = 0; ///< facet
    dealii::Tensor<1, dim> normal;
    double                 lead = 0.; ///< carried gap, less what the facets' middles have made it
  };

  /** What the facets of a surface carry, by facet. */
  template <int dim>
  using ContactMemory = std::map<unsigned int, PartneredContact<dim>>;

  /**
   * Hands what facets carry on to those that a step has divided or united, each with the partner
   * and the normal of the largest part.
   *
   * @param facets, partners of the surface and of the one that it meets
   */
  template <int dim>
  ContactMemory<dim>
  handed_on(ContactMemory<dim> &&of_step,
            const FacetHeritage &facets,
            const FacetHeritage &partners = FacetHeritage());

  /**
   * Where the records begin in what a checkpoint holds: behind their width.
   *
   * @throws UserError for those of a version of kedge that has others
   */
  std::vector<double>::const_iterator
  first_record(const std::vector<double> &saved, const std::size_t width);

  /** What a checkpoint keeps of it. */
  template <int dim>
  std::vector<double>
  saved(const ContactMemory<dim> &memory);

  /** Takes it back. @param to_gaps turns multipliers into gaps that press as hard
   *
   * @throws UserError as first_record() */
  template <int dim>
  ContactMemory<dim>
  restored(const std::vector<double> &saved, const ContactLaw &law, const bool to_gaps);

  /** Energy that facets of a surface store, by facet [J; J/m in 2D].
   *
   * @param area of a facet at the start of the run */
  template <class Memory, typename Area>
  double
  stored_by_facets(const ContactLaw                     &law,
                   const std::map<unsigned int, Memory> &facets,
                   const Area                           &area)
  {
    double sum = 0.;
    for (const auto &[facet, closed] : facets)
      sum += area(facet) * stored_in_contact(law, closed.gap, closed.multiplier, closed.slip);
    return sum;
  }

  /** The same if they are those that the step leads to (BodySurface::move()). */
  template <int dim, class Memory>
  double
  stored_after_step(const ContactLaw                     &law,
                    const BodySurface<dim>               &surface,
                    const std::map<unsigned int, Memory> &facets)
  {
    const FacetHeritage &heritage = surface.heritage();
    return stored_by_facets(law, facets, [&](const unsigned int facet) {
      return heritage.empty() ? surface.reference_area(facet) : heritage.area(facet);
    });
  }
} // namespace kedge

#endif
