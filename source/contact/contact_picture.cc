#include <kedge/contact/contact_picture.h>

namespace kedge
{
  template <int dim>
  void
  ContactPicture<dim>::add_surface(const BodySurface<dim> &surface)
  {
    const auto [entry, is_new] = numbers.emplace(&surface, surface.n_facets());
    if (!is_new)
      return;
    const auto                          &mesh = surface.mesh();
    std::map<unsigned int, unsigned int> vertex_here;
    for (unsigned int f = 0; f < surface.n_facets(); ++f)
      {
        entry->second[f] = mesh.has_left(f) ? no_facet : facets_.size();
        if (mesh.has_left(f))
          continue;
        Facet facet;
        facet.body = static_cast<int>(surface.body);
        for (int i = 0; i < dim; ++i)
          {
            const unsigned int v = mesh.facets[f][i];
            const auto [known, is_first] =
              vertex_here.emplace(v, static_cast<unsigned int>(vertices_.size()));
            if (is_first)
              vertices_.push_back(mesh.vertices[v]);
            facet.corners[i] = known->second;
          }
        facets_.push_back(facet);
      }
  }



  template <int dim>
  void
  ContactPicture<dim>::add(const std::vector<ContactPlace<dim>> &places)
  {
    for (const ContactPlace<dim> &place : places)
      {
        const std::size_t number = numbers.at(place.surface)[place.facet];
        if (number == no_facet)
          continue;
        Facet     &facet     = facets_[number];
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
