#include <kedge/contact/surface_samples.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** The box around a mesh, wider by @p margin on all sides. */
    template <int dim>
    dealii::BoundingBox<dim>
    box_around(const SurfaceMesh<dim> &mesh, const double margin)
    {
      dealii::Point<dim> lower = mesh.vertices.front(), upper = lower;
      for (const auto &x : mesh.vertices)
        for (int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      for (int d = 0; d < dim; ++d)
        {
          lower[d] -= margin;
          upper[d] += margin;
        }
      return dealii::BoundingBox<dim>({lower, upper});
    }

    template <int dim>
    dealii::Point<dim>
    middle(const SurfaceMesh<dim> &mesh, const unsigned int facet)
    {
      dealii::Point<dim> x;
      for (const unsigned int v : mesh.facets[facet])
        x += mesh.vertices[v] / dim;
      return x;
    }

    template <int dim>
    dealii::Point<dim>
    place_of(const SurfaceMesh<dim> &mesh, const typename FacetSearch<dim>::Partner &partner)
    {
      dealii::Point<dim> y;
      for (int i = 0; i < dim; ++i)
        y += partner.weights[i] * mesh.vertices[mesh.facets[partner.facet][i]];
      return y;
    }
  } // namespace



  template <int dim>
  void
  MovingSurface<dim>::move(const std::vector<dealii::Tensor<1, dim>> &of_step, const double part)
  {
    if (mesh.facets.empty() || generation != surface.generation())
      mesh = end = surface.mesh();
    generation = surface.generation();
    mesh.left = end.left = surface.mesh().left;
    displacements        = of_step;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      {
        const dealii::Point<dim> &start = surface.mesh().vertices[v];
        mesh.vertices[v]                = start + part * displacements[v];
        end.vertices[v]                 = start + displacements[v];
      }
  }



  template <int dim>
  dealii::BoundingBox<dim>
  SurfaceSamples<dim>::box_of_samples() const
  {
    return box_around(sampled.mesh, 0.);
  }



  template <int dim>
  void
  SurfaceSamples<dim>::find()
  {
    samples_.clear();
    const dealii::BoundingBox<dim> here  = box_around(sampled.mesh, reach),
                                   there = box_around(other.mesh, reach);
    if (!boost::geometry::intersects(here, there))
      return;
    const FacetSearch<dim> search(other.mesh, here);
    if (search.empty())
      return;
    guesses.resize(sampled.mesh.facets.size(), search.no_facet);
    const FacetSearch<dim> search_end(other.end, box_around(sampled.end, reach));
    for (unsigned int f = 0; f < sampled.mesh.facets.size(); ++f)
      {
        const auto corners = sampled.mesh.corners(f);
        const auto x       = middle(sampled.mesh, f);
        if (sampled.mesh.has_left(f) || !there.point_inside(x))
          continue;
        const auto   known    = memory.find(f);
        const auto   previous = known == memory.end() ? search.no_facet : known->second.partner;
        const auto   outward  = area_vector<dim>(corners);
        const double area     = outward.norm();
        // facets may have been divided and united since
        const auto guess = guesses[f] < other.mesh.facets.size() ? guesses[f] : search.no_facet;
        Sample     sample;
        if (!(area > 0.) || !search.find(x, outward / area, reach, previous, sample.partner, guess))
          continue;
        guesses[f]   = sample.partner.facet;
        sample.facet = f;
        sample.area  = share * sampled.surface.reference_area(f);
        if (!set_start(sample))
          continue;
        sample.stretch     = sampled.surface.stretch(f);
        sample.shear_limit = sample.stretch * shear_limit_at(sample);
        if (law.conserving)
          tilt_to_end(search_end, sample);
        samples_.push_back(sample);
      }
  }



  template <int dim>
  void
  SurfaceSamples<dim>::find_anew()
  {
    std::map<unsigned int, Multipliers> multipliers;
    for (const Sample &sample : samples_)
      if (sample.multiplier > 0.)
        multipliers[sample.facet] = {sample.multiplier, sample.slip_n, sample.partner.normal};
    find();
    set_multipliers(multipliers);
  }



  /** Tilts s so that g_0 + s.D is the gap that the moved surfaces have at the end of the step. */
  template <int dim>
  void
  SurfaceSamples<dim>::tilt_to_end(const FacetSearch<dim> &search, Sample &sample) const
  {
    const auto               outward = area_vector<dim>(sampled.end.corners(sample.facet));
    const dealii::Point<dim> x       = middle(sampled.end, sample.facet);
    typename FacetSearch<dim>::Partner partner;
    if (!search.find(x,
                     outward / outward.norm(),
                     reach,
                     sample.partner.facet,
                     partner,
                     sample.partner.facet))
      return;
    const double                 measured = partner.normal * (x - place_of(other.end, partner));
    const dealii::Tensor<1, dim> D        = relative_displacement(sample);
    const dealii::Tensor<1, dim> D_t      = D - (D * sample.partner.normal) * sample.partner.normal;
    const double                 way      = D_t.norm();
    const double                 missing  = measured - sample.gap_n - sample.gap_slope * D;
    if (way > 0.)
      sample.gap_slope += std::clamp(missing / way, -largest_tilt, largest_tilt) / way * D_t;
  }



  /** The sample's state at the start of the step; false if it is no contact. */
  template <int dim>
  bool
  SurfaceSamples<dim>::set_start(Sample &sample) const
  {
    sample.gap_n      = sample.partner.normal * (place(sample) - partner_place(sample));
    sample.gap_slope  = sample.partner.normal;
    sample.multiplier = 0.;
    const auto known  = memory.find(sample.facet);
    if (known == memory.end())
      {
        // one that is first seen inside begins as if it touched
        const bool is_deep = sample.gap_n < -depth;
        if (law.conserving)
          sample.gap_n = std::max(sample.gap_n, 0.);
        return !is_deep;
      }
    const Memory &last = known->second;
    sample.slip_n      = turned(last.slip, last.normal, sample.partner.normal);
    sample.multiplier  = last.multiplier;
    if (law.conserving)
      sample.gap_n = last.gap;
    return true;
  }



  /** By the weaker of the two soils that meet there. */
  template <int dim>
  double
  SurfaceSamples<dim>::shear_limit_at(const Sample &sample) const
  {
    double strength = std::numeric_limits<double>::quiet_NaN();
    if (!sampled.strengths.empty())
      {
        strength = 0.;
        for (const unsigned int v : sampled.mesh.facets[sample.facet])
          strength += sampled.strengths[v] / dim;
      }
    if (!other.strengths.empty())
      {
        double there = 0.;
        for (int i = 0; i < dim; ++i)
          there +=
            sample.partner.weights[i] * other.strengths[other.mesh.facets[sample.partner.facet][i]];
        strength = std::fmin(strength, there); // a number, if one of them is
      }
    return limit(place(sample), strength);
  }



  template <int dim>
  dealii::Point<dim>
  SurfaceSamples<dim>::place_in(const SurfaceMesh<dim> &mesh, const Sample &sample) const
  {
    return middle(mesh, sample.facet);
  }



  template <int dim>
  dealii::Point<dim>
  SurfaceSamples<dim>::partner_in(const SurfaceMesh<dim> &mesh, const Sample &sample) const
  {
    return place_of(mesh, sample.partner);
  }



  template <int dim>
  dealii::Tensor<1, dim>
  SurfaceSamples<dim>::relative_displacement(const Sample &sample) const
  {
    dealii::Tensor<1, dim> D;
    for (const unsigned int v : sampled.mesh.facets[sample.facet])
      D += sampled.displacements[v] / dim;
    const auto &facet = other.mesh.facets[sample.partner.facet];
    for (int i = 0; i < dim; ++i)
      D -= sample.partner.weights[i] * other.displacements[facet[i]];
    return D;
  }



  template <int dim>
  typename SurfaceSamples<dim>::Outcome
  SurfaceSamples<dim>::outcome(const Sample &sample) const
  {
    return {response(sample),
            sample.partner.normal *
              (place(sample) - partner_place(sample) + relative_displacement(sample))};
  }



  template <int dim>
  void
  SurfaceSamples<dim>::set_multipliers(const std::map<unsigned int, Multipliers> &values)
  {
    for (Sample &sample : samples_)
      {
        const auto found  = values.find(sample.facet);
        sample.multiplier = 0.;
        if (found == values.end())
          continue;
        sample.multiplier = found->second.pressure;
        sample.slip_n     = turned(found->second.slip, found->second.normal, sample.partner.normal);
      }
  }



  template <int dim>
  double
  SurfaceSamples<dim>::stored_at_start() const
  {
    double sum = 0.;
    for (const Sample &sample : samples_)
      sum += sample.area * energy(sample.gap_n, sample.multiplier, sample.slip_n);
    return sum;
  }



  template <int dim>
  std::map<unsigned int, typename SurfaceSamples<dim>::Memory>
  SurfaceSamples<dim>::memory_of_step(double &stored) const
  {
    std::map<unsigned int, Memory> result;
    stored = 0.;
    for (const Sample &sample : samples_)
      {
        const Outcome               end = outcome(sample);
        const ContactResponse<dim> &r   = end.response;
        stored += sample.area * energy(r.gap_end, sample.multiplier, r.slip_end);
        const bool is_closed =
          law.conserving ? r.gap_end < 0. || end.true_gap < 0. : r.pressure > 0.;
        if (is_closed)
          result[sample.facet] = {{r.gap_end, sample.multiplier, r.slip_end},
                                  sample.partner.facet,
                                  sample.partner.normal};
      }
    return result;
  }

  template struct MovingSurface<2>;
  template struct MovingSurface<3>;
  template class SurfaceSamples<2>;
  template class SurfaceSamples<3>;
} // namespace kedge
