#include <kedge/contact/contact_picture.h>

namespace kedge
{
  template <int dim>
  void
  ContactPicture<dim>::add_surface(const BodySurface<dim> &surface)
  {
    if (!first_facet.emplace(&surface, facets_.size()).second)
      return;
    const auto  first = static_cast<unsigned int>(vertices_.size());
    const auto &mesh  = surface.mesh();
    vertices_.insert(vertices_.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto &corners : mesh.facets)
      {
        Facet facet;
        facet.body = static_cast<int>(surface.body);
        for (int i = 0; i < dim; ++i)
          facet.corners[i] = first + corners[i];
        facets_.push_back(facet);
      }
  }



  template <int dim>
  void
  ContactPicture<dim>::add(const std::vector<ContactPlace<dim>> &places)
  {
    for (const ContactPlace<dim> &place : places)
      {
        Facet     &facet     = facets_[first_facet.at(place.surface) + place.facet];
        const bool presses   = place.pressure > 0.;
        const bool is_nearer = facet.state == FacetState::alone ||
                               (presses ? place.pressure > facet.pressure
                                        : facet.state == FacetState::open && place.gap < facet.gap);
        facet.pressure += place.pressure;
        facet.force += place.on_first ? place.force : -place.force;
        if (!is_nearer)
          continue;
        facet.gap       = place.gap;
        facet.partner   = place.partner;
        facet.slip_rate = place.slip_rate;
        facet.state     = !presses       ? FacetState::open
                          : place.sticks ? FacetState::sticks
                                         : FacetState::slides;
      }
  }

  template class ContactPicture<2>;
  template class ContactPicture<3>;
} // namespace kedge
