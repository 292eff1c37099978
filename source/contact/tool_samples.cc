#include <kedge/contact/tool_samples.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  ToolSamples<dim>::ToolSamples(const WallBody<dim>    &body,
                                const ContactLaw       &law,
                                const RigidBodies<dim> &bodies,
                                const unsigned int      tool,
                                const FacetSearch<dim> &search,
                                const ShearLimit<dim>  &limit,
                                const double            reach,
                                const double            depth)
    : ToolSide<dim>(body, law, bodies, tool, limit, reach, depth)
    , search(search)
  {
    for (const auto &x : bodies.surface(tool).vertices)
      radius = std::max(radius, x.norm());
  }



  /** What the middle of a facet meets where @p part of the step has led; false if nothing. */
  template <int dim>
  bool
  ToolSamples<dim>::find_partner(const unsigned int                  facet,
                                 const double                        part,
                                 const unsigned int                  previous,
                                 typename FacetSearch<dim>::Partner &partner) const
  {
    const auto         at = this->pose(part);
    dealii::Point<dim> middle;
    auto               corners  = this->body.surface->mesh().corners(facet);
    const auto        &vertices = this->body.surface->mesh().facets[facet];
    for (int i = 0; i < dim; ++i)
      {
        corners[i] = at.in_axes(corners[i] + part * this->displacements[vertices[i]]);
        middle += corners[i] / dim;
      }
    if (middle.norm() > radius + this->reach)
      return false;
    const auto outward = area_vector<dim>(corners);
    return outward.norm() > 0. &&
           search.find(middle, outward / outward.norm(), this->reach, previous, partner);
  }



  template <int dim>
  void
  ToolSamples<dim>::find_places()
  {
    const Matrix33 attitude = this->pose(this->bodies.alpha).attitude;
    const auto    &mesh     = this->body.surface->mesh();
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        typename FacetSearch<dim>::Partner partner;
        if (mesh.has_left(f) ||
            !find_partner(f, this->bodies.alpha, this->partner_before(f), partner))
          continue;
        Sample sample;
        sample.key = sample.facet = f;
        sample.partner            = partner.facet;
        sample.weights.fill(1. / dim);
        for (const auto &corner : mesh.corners(f))
          sample.place += corner / dim;
        const auto &tool_mesh = this->bodies.surface(this->tool);
        for (int i = 0; i < dim; ++i)
          sample.on_tool += partner.weights[i] *
                            in_space<dim>(tool_mesh.vertices[tool_mesh.facets[partner.facet][i]]);
        sample.normal  = in_scene<dim>(attitude * in_space<dim>(partner.normal));
        sample.area    = this->body.surface->reference_area(f);
        sample.stretch = this->body.surface->stretch(f);
        this->samples.push_back(sample);
      }
  }



  template <int dim>
  bool
  ToolSamples<dim>::measure_at_end(const Sample &sample, double &gap) const
  {
    typename FacetSearch<dim>::Partner partner;
    if (!find_partner(sample.facet, 1., sample.partner, partner))
      return false;
    gap = partner.gap;
    return true;
  }



  template <int dim>
  std::pair<double, dealii::Point<dim>>
  ToolSamples<dim>::deepest() const
  {
    std::pair<double, dealii::Point<dim>> result{0., {}};
    typename FacetSearch<dim>::Partner    partner;
    for (unsigned int f = 0; f < this->body.surface->n_facets(); ++f)
      if (find_partner(f, 0., search.no_facet, partner) && -partner.gap > result.first)
        {
          result = {-partner.gap, {}};
          for (const auto &corner : this->body.surface->mesh().corners(f))
            result.second += corner / dim;
        }
    return result;
  }

  template class ToolSamples<2>;
  template class ToolSamples<3>;
} // namespace kedge
