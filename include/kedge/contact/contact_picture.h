#ifndef kedge_contact_contact_picture_h
#define kedge_contact_contact_picture_h

#include <kedge/contact/contact_books.h>
#include <kedge/surfaces/body_surface.h>

#include <limits>
#include <map>

namespace kedge
{
  /** What a facet of a surface in contact does. */
  enum class FacetState
  {
    alone,  ///< no other surface is near
    open,   ///< one is near and is not touched
    sticks, ///< pressed, and held by friction
    slides  ///< pressed, and slides or is free to
  };

  /**
   * Surfaces in contact as they are after a step, as plain arrays: vertices, facets, and for each
   * facet what the contacts have done to it. What several contacts do to one facet is added up;
   * gap, partner and state are those of the one that presses most, or is nearest. What has left the
   * grid is not in it.
   */
  template <int dim>
  class ContactPicture
  {
  public:
    static constexpr int         no_partner = -1, wall = -2;
    static constexpr std::size_t no_facet = static_cast<std::size_t>(-1);

    struct Facet
    {
      std::array<unsigned int, dim> corners; ///< counted in vertices
      int                           body;
      double                        pressure = 0.; ///< [Pa]
      dealii::Tensor<1, dim>        force; ///< on this surface, of the samples of this facet [N]
      dealii::Tensor<1, dim>        slip_rate; ///< along the surface, against the partner [m/s]
      double                        gap     = std::numeric_limits<double>::quiet_NaN(); ///< [m]
      FacetState                    state   = FacetState::alone;
      int                           partner = no_partner; ///< number of a body, or one of the above
    };

    void
    add_surface(const BodySurface<dim> &surface);

    /** Adds what a contact has done in its last step, on surfaces that were added before. */
    void
    add(const std::vector<ContactPlace<dim>> &places);

    const std::vector<dealii::Point<dim>> &
    vertices() const
    {
      return vertices_;
    }

    const std::vector<Facet> &
    facets() const
    {
      return facets_;
    }

  private:
    std::vector<dealii::Point<dim>> vertices_;
    std::vector<Facet>              facets_;
    /** Of each surface the numbers of its facets here; no_facet of those that have left. */
    std::map<const BodySurface<dim> *, std::vector<std::size_t>> numbers;
  };

  /** What a step has done, on the facets that it has led to (BodySurface::heritage()). */
  template <int dim>
  std::vector<ContactPlace<dim>>
  on_facets_after_step(std::vector<ContactPlace<dim>> &&places);

  /** A contact of which pictures can be made. */
  template <int dim>
  class ShownContact
  {
  public:
    virtual ~ShownContact() = default;

    virtual void
    show(ContactPicture<dim> &picture) const = 0;
  };
} // namespace kedge

#endif
