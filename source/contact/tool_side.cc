#include <kedge/contact/tool_side.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  ToolSide<dim>::ToolSide(const WallBody<dim>    &body,
                          const ContactLaw       &law,
                          const RigidBodies<dim> &bodies,
                          const unsigned int      tool,
                          const ShearLimit<dim>  &limit,
                          const double            reach,
                          const double            depth)
    : body(body)
    , law(law)
    , bodies(bodies)
    , tool(tool)
    , limit(limit)
    , reach(reach)
    , depth(depth)
  {}



  template <int dim>
  void
  ToolSide<dim>::read_strengths()
  {
    if (body.clay != nullptr)
      strengths = undrained_strengths(*body.surface, *body.clay);
  }



  template <int dim>
  void
  ToolSide<dim>::move(const std::vector<double> &of_nodes)
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
  ToolSide<dim>::read_pore_pressures(const std::vector<double> &unknowns)
  {
    if (body.carries_water)
      body.surface->interpolate_pressure(unknowns, pore_pressures);
  }



  template <int dim>
  typename ToolSide<dim>::Pose
  ToolSide<dim>::pose(const double part) const
  {
    const RigidBody &of = bodies[tool];
    return {of.state.centre + part * of.displacement, cayley(part * of.theta) * of.attitude_start};
  }



  template <int dim>
  void
  ToolSide<dim>::read_displacements()
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
  ToolSide<dim>::displacement_of_place(const Sample &sample) const
  {
    dealii::Tensor<1, dim> D;
    for_vertices(sample, [&](const unsigned int v, const double weight) {
      D += weight * displacements[v];
    });
    return D;
  }



  template <int dim>
  void
  ToolSide<dim>::find()
  {
    samples.clear();
    find_places();
    samples.erase(std::remove_if(samples.begin(),
                                 samples.end(),
                                 [&](Sample &sample) {
                                   sample.gap_slope = sample.normal;
                                   sample.shear_limit =
                                     sample.stretch * limit(sample.place, strength_at(sample));
                                   return !set_start(sample);
                                 }),
                  samples.end());
    read_displacements();
    if (law.conserving)
      for (Sample &sample : samples)
        tilt_to_end(sample);
  }



  template <int dim>
  double
  ToolSide<dim>::strength_at(const Sample &sample) const
  {
    if (strengths.empty())
      return std::numeric_limits<double>::quiet_NaN();
    double strength = 0.;
    for_vertices(sample, [&](const unsigned int v, const double weight) {
      strength += weight * strengths[v];
    });
    return strength;
  }



  /** The sample's state at the start of the step; false if it is no contact. */
  template <int dim>
  bool
  ToolSide<dim>::set_start(Sample &sample) const
  {
    sample.gap       = gap_at_start(sample);
    const auto known = memory.find(sample.key);
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
  ToolSide<dim>::tilt_to_end(Sample &sample) const
  {
    double gap = 0.;
    if (!measure_at_end(sample, gap))
      return;
    const dealii::Tensor<1, dim> D =
      displacement(sample) - sample.moves_by + displacement_of_place(sample);
    const dealii::Tensor<1, dim> D_t     = D - (D * sample.normal) * sample.normal;
    const double                 way     = D_t.norm();
    const double                 missing = gap + sample.lead - sample.gap - sample.gap_slope * D;
    if (way > 0.)
      sample.gap_slope += std::clamp(missing / way, -largest_tilt, largest_tilt) / way * D_t;
  }



  template <int dim>
  void
  ToolSide<dim>::find_anew()
  {
    std::map<unsigned int, Sample> before;
    for (const Sample &sample : samples)
      before.emplace(sample.key, sample);
    find();
    for (Sample &sample : samples)
      if (law.at_rest)
        {
          const auto known  = before.find(sample.key);
          sample.multiplier = known == before.end() ? 0. : known->second.multiplier;
          if (known != before.end())
            sample.slip = turned(known->second.slip, known->second.normal, sample.normal);
        }
  }



  template <int dim>
  dealii::Tensor<1, dim>
  ToolSide<dim>::displacement(const Sample &sample) const
  {
    return sample.moves_by - in_scene<dim>(bodies.displacement(point(sample)));
  }



  template <int dim>
  ContactResponse<dim>
  ToolSide<dim>::response(const Sample &sample) const
  {
    double pore_pressure = 0.;
    if (!pore_pressures.empty())
      for_vertices(sample, [&](const unsigned int v, const double weight) {
        pore_pressure += weight * pore_pressures[v];
      });
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
  ToolSide<dim>::gap_at_start(const Sample &sample) const
  {
    const Pose start = pose(0.);
    return in_space<dim>(sample.normal) *
           (in_space<dim>(sample.place) - start.centre - start.attitude * sample.on_tool);
  }



  template <int dim>
  double
  ToolSide<dim>::true_gap(const Sample &sample) const
  {
    const Pose end = pose(1.);
    return in_space<dim>(sample.normal) *
           (in_space<dim>(dealii::Point<dim>(sample.place + sample.moves_by)) - end.centre -
            end.attitude * sample.on_tool);
  }

  template class ToolSide<2>;
  template class ToolSide<3>;
} // namespace kedge
