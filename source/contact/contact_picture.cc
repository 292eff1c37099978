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

  namespace
  {
    /** A facet that has part of one before. */
    struct Heir
    {
      unsigned int facet;
      double       of_old, of_new; ///< parts of the areas of both
    };

    /** Of each facet before. */
    std::vector<std::vector<Heir>>
    find_heirs(const FacetHeritage &heritage)
    {
      std::vector<double>            areas(heritage.heirs.size(), 0.);
      std::vector<std::vector<Heir>> heirs(heritage.heirs.size());
      for (const auto &parts : heritage.parts)
        for (const auto &part : parts)
          areas[part.facet] += part.area;
      for (unsigned int f = 0; f < heritage.parts.size(); ++f)
        for (const auto &part : heritage.parts[f])
          heirs[part.facet].push_back(
            {f, part.area / areas[part.facet], part.area / heritage.area(f)});
      return heirs;
    }
  } // namespace



  template <int dim>
  std::vector<ContactPlace<dim>>
  on_facets_after_step(std::vector<ContactPlace<dim>> &&places)
  {
    std::map<const BodySurface<dim> *, std::vector<std::vector<Heir>>> heirs;
    for (const auto &place : places)
      if (const auto &heritage = place.surface->heritage();
          !heritage.empty() && heirs.count(place.surface) == 0)
        heirs.emplace(place.surface, find_heirs(heritage));
    if (heirs.empty())
      return std::move(places);
    std::vector<ContactPlace<dim>> result;
    for (const ContactPlace<dim> &place : places)
      {
        const auto known = heirs.find(place.surface);
        if (known == heirs.end())
          {
            result.push_back(place);
            continue;
          }
        for (const Heir &heir : known->second[place.facet])
          {
            ContactPlace<dim> here = place;
            here.facet             = heir.facet;
            here.force *= heir.of_old;
            here.area *= heir.of_old;
            here.friction *= heir.of_old;
            here.pressure *= heir.of_new;
            result.push_back(here);
          }
      }
    return result;
  }

  template std::vector<ContactPlace<2>>
  on_facets_after_step(std::vector<ContactPlace<2>> &&);
  template std::vector<ContactPlace<3>>
  on_facets_after_step(std::vector<ContactPlace<3>> &&);
  template class ContactPicture<2>;
  template class ContactPicture<3>;
} // namespace kedge
