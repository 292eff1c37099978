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
    : body(body)
    , law(law)
    , bodies(bodies)
    , tool(tool)
    , search(search)
    , limit(limit)
    , reach(reach)
    , depth(depth)
    , radius(0.)
  {
    for (const auto &x : bodies.surface(tool).vertices)
      radius = std::max(radius, x.norm());
  }



  template <int dim>
  void
  ToolSamples<dim>::read_strengths()
  {
    if (body.clay != nullptr)
      strengths = undrained_strengths(*body.surface, *body.clay);
  }



  template <int dim>
  void
  ToolSamples<dim>::move(const std::vector<double> &of_nodes)
  {
    nodal = of_nodes;
    read_displacements();
    if (nodal.empty())
      displacements.assign(body.surface->n_vertices(), dealii::Tensor<1, dim>());
    else
      body.surface->interpolate(nodal, displacements);
  }



  template <int dim>
  void
  ToolSamples<dim>::read_pore_pressures(const std::vector<double> &unknowns)
  {
    if (body.carries_water)
      body.surface->interpolate_pressure(unknowns, pore_pressures);
  }



  template <int dim>
  typename ToolSamples<dim>::Pose
  ToolSamples<dim>::pose(const double part) const
  {
    const RigidBody &of = bodies[tool];
    return {of.state.centre + part * of.displacement, cayley(part * of.theta) * of.attitude_start};
  }



  template <int dim>
  void
  ToolSamples<dim>::read_displacements()
  {
    std::vector<dealii::Tensor<1, dim>> of_samples(samples.size());
    if (nodal.empty() || samples.empty())
      return;
    for (std::size_t n = 0; n < samples.size(); ++n)
      of_samples[n] = own_part_of_mean<dim>(functions(samples[n]), nodal);
    sum_over_ranks<dim>(body.surface->patch, of_samples);
    for (std::size_t n = 0; n < samples.size(); ++n)
      samples[n].moves_by = of_samples[n];
  }



  template <int dim>
  dealii::Tensor<1, dim>
  ToolSamples<dim>::displacement_of_middle(const unsigned int facet) const
  {
    dealii::Tensor<1, dim> D;
    for (const unsigned int v : body.surface->mesh().facets[facet])
      D += displacements[v] / dim;
    return D;
  }



  /** What the middle of a facet meets where @p part of the step has led; false if nothing. */
  template <int dim>
  bool
  ToolSamples<dim>::find_partner(const unsigned int                  facet,
                                 const double                        part,
                                 const unsigned int                  previous,
                                 typename FacetSearch<dim>::Partner &partner) const
  {
    const Pose         at = pose(part);
    dealii::Point<dim> middle;
    auto               corners  = body.surface->mesh().corners(facet);
    const auto        &vertices = body.surface->mesh().facets[facet];
    for (int i = 0; i < dim; ++i)
      {
        corners[i] = at.in_axes(corners[i] + part * displacements[vertices[i]]);
        middle += corners[i] / dim;
      }
    if (middle.norm() > radius + reach)
      return false;
    const auto outward = area_vector<dim>(corners);
    return outward.norm() > 0. &&
           search.find(middle, outward / outward.norm(), reach, previous, partner);
  }



  template <int dim>
  void
  ToolSamples<dim>::find()
  {
    samples.clear();
    const Matrix33 attitude = pose(bodies.alpha).attitude;
    const auto    &mesh     = body.surface->mesh();
    for (unsigned int f = 0; f < mesh.facets.size(); ++f)
      {
        if (mesh.has_left(f))
          continue;
        const auto known    = memory.find(f);
        const auto previous = known == memory.end() ? search.no_facet : known->second.partner;
        typename FacetSearch<dim>::Partner partner;
        if (!find_partner(f, bodies.alpha, previous, partner))
          continue;
        Sample sample;
        sample.facet   = f;
        sample.partner = partner.facet;
        for (const auto &corner : mesh.corners(f))
          sample.place += corner / dim;
        const auto &tool_mesh = bodies.surface(tool);
        for (int i = 0; i < dim; ++i)
          sample.on_tool += partner.weights[i] *
                            in_space<dim>(tool_mesh.vertices[tool_mesh.facets[partner.facet][i]]);
        sample.normal      = in_scene<dim>(attitude * in_space<dim>(partner.normal));
        sample.gap_slope   = sample.normal;
        sample.area        = body.surface->reference_area(f);
        sample.stretch     = body.surface->stretch(f);
        sample.shear_limit = sample.stretch * limit(sample.place, strength_at(f));
        if (set_start(sample))
          samples.push_back(sample);
      }
    read_displacements();
    if (law.conserving)
      for (Sample &sample : samples)
        tilt_to_end(sample);
  }



  template <int dim>
  double
  ToolSamples<dim>::strength_at(const unsigned int facet) const
  {
    if (strengths.empty())
      return std::numeric_limits<double>::quiet_NaN();
    double strength = 0.;
    for (const unsigned int v : body.surface->mesh().facets[facet])
      strength += strengths[v] / dim;
    return strength;
  }



  /** The sample's state at the start of the step; false if it is no contact. */
  template <int dim>
  bool
  ToolSamples<dim>::set_start(Sample &sample) const
  {
    const Pose start = pose(0.);
    sample.gap       = in_space<dim>(sample.normal) *
                 (in_space<dim>(sample.place) - start.centre - start.attitude * sample.on_tool);
    const auto known = memory.find(sample.facet);
    if (known == memory.end())
      {
        // one that is first seen inside begins as if it touched
        const bool is_deep = sample.gap < -depth;
        if (law.conserving)
          sample.gap = std::max(sample.gap, 0.);
        return !is_deep;
      }
    sample.slip       = turned(known->second.slip, known->second.normal, sample.normal);
    sample.multiplier = known->second.multiplier;
    if (law.conserving)
      {
        sample.gap  = known->second.gap;
        sample.lead = known->second.lead;
      }
    return true;
  }



  /** Tilts s so that g_0 + s.D is the gap that is measured at the end of the step. */
  template <int dim>
  void
  ToolSamples<dim>::tilt_to_end(Sample &sample) const
  {
    typename FacetSearch<dim>::Partner partner;
    if (!find_partner(sample.facet, 1., sample.partner, partner))
      return;
    const dealii::Tensor<1, dim> D =
      displacement(sample) - sample.moves_by + displacement_of_middle(sample.facet);
    const dealii::Tensor<1, dim> D_t = D - (D * sample.normal) * sample.normal;
    const double                 way = D_t.norm();
    const double missing = partner.gap + sample.lead - sample.gap - sample.gap_slope * D;
    if (way > 0.)
      sample.gap_slope += std::clamp(missing / way, -largest_tilt, largest_tilt) / way * D_t;
  }



  template <int dim>
  void
  ToolSamples<dim>::find_anew()
  {
    std::map<unsigned int, Sample> before;
    for (const Sample &sample : samples)
      before.emplace(sample.facet, sample);
    find();
    for (Sample &sample : samples)
      if (law.at_rest)
        {
          const auto known  = before.find(sample.facet);
          sample.multiplier = known == before.end() ? 0. : known->second.multiplier;
          if (known != before.end())
            sample.slip = turned(known->second.slip, known->second.normal, sample.normal);
        }
  }



  template <int dim>
  std::pair<double, dealii::Point<dim>>
  ToolSamples<dim>::deepest() const
  {
    std::pair<double, dealii::Point<dim>> result{0., {}};
    typename FacetSearch<dim>::Partner    partner;
    for (unsigned int f = 0; f < body.surface->n_facets(); ++f)
      if (find_partner(f, 0., search.no_facet, partner) && -partner.gap > result.first)
        {
          result = {-partner.gap, {}};
          for (const auto &corner : body.surface->mesh().corners(f))
            result.second += corner / dim;
        }
    return result;
  }



  template <int dim>
  dealii::Tensor<1, dim>
  ToolSamples<dim>::displacement(const Sample &sample) const
  {
    return sample.moves_by - in_scene<dim>(bodies.displacement(point(sample)));
  }



  template <int dim>
  ContactResponse<dim>
  ToolSamples<dim>::response(const Sample &sample) const
  {
    double pore_pressure = 0.;
    if (!pore_pressures.empty())
      for (const unsigned int v : body.surface->mesh().facets[sample.facet])
        pore_pressure += pore_pressures[v] / dim;
    ContactLaw here  = law;
    here.shear_limit = sample.shear_limit;
    here.adhesion *= sample.stretch;
    return contact_response(here,
                            sample.normal,
                            sample.gap_slope,
                            sample.gap,
                            sample.slip,
                            sample.multiplier,
                            displacement(sample),
                            pore_pressure);
  }



  template <int dim>
  double
  ToolSamples<dim>::true_gap(const Sample &sample) const
  {
    const Pose end = pose(1.);
    return in_space<dim>(sample.normal) *
           (in_space<dim>(dealii::Point<dim>(sample.place + sample.moves_by)) - end.centre -
            end.attitude * sample.on_tool);
  }

  template class ToolSamples<2>;
  template class ToolSamples<3>;
} // namespace kedge
