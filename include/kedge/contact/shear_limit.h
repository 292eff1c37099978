#ifndef kedge_contact_shear_limit_h
#define kedge_contact_shear_limit_h

#include <kedge/base/expression.h>
#include <kedge/contact/parameters.h>
#include <kedge/materials/material.h>
#include <kedge/surfaces/body_surface.h>

namespace kedge
{
  /** Whether a law has an undrained strength s_u. */
  bool
  has_undrained_strength(const Material &material);

  /**
   * The undrained strength of a body's soil at the vertices of its surface, softened as it is but
   * without what a rate adds [Pa]: the linear function that is nearest, in the mean over their
   * volumes, to that of the body's material points in the cells around a vertex, and not below 0.
   * A strength that is linear in the place is met exactly (collective).
   *
   * @param material with an undrained strength
   */
  template <int dim>
  std::vector<double>
  undrained_strengths(const BodySurface<dim> &surface, const Material &material);

  /** The largest shear stress of a contact whatever its pressure, of the place [Pa]. */
  template <int dim>
  class ShearLimit
  {
  public:
    ShearLimit(const ContactParameters &parameters, const std::map<std::string, double> &constants);

    /** Whether it is not the same everywhere. */
    bool
    is_of_place() const
    {
      return !expression.is_constant();
    }

    /** Notes how high a body reaches that depths are counted from. */
    void
    count_from(const BodySurface<dim> &surface);

    /**
     * That at @p place; what is less than 0 counts as 0.
     * @param strength s_u there, not a number if no soil has one [Pa]
     */
    double
    operator()(const dealii::Point<dim> &place, const double strength) const;

    /**
     * Throws UserError where it is not at least 0 at a facet's middle.
     * @param has_strength whether the facet's body or its partners have a law with s_u
     */
    void
    check(const BodySurface<dim> &surface, const bool has_strength) const;

    /** Where depth is zero, the highest place that count_from() has seen [m]. */
    double top = std::numeric_limits<double>::lowest();

  private:
    double
    value(const dealii::Point<dim> &place, const double strength) const;

    const std::string contact;
    const Expression  expression; ///< of shear_limit_variables()
  };
} // namespace kedge

#endif
