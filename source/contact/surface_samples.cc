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
  MovingSurface<dim>::move(const std::vector<double> &of_nodes,
                           const double               factor,
                           const double               part)
  {
    nodal = of_nodes;
    for (double &u : nodal)
      u *= factor;
    if (nodal.empty())
      displacements.assign(surface.n_vertices(), dealii::Tensor<1, dim>());
    else
      surface.interpolate(nodal, displacements);
    if (mesh.facets.empty() || generation != surface.generation())
      mesh = end = surface.mesh();
    generation = surface.generation();
    mesh.left = end.left = surface.mesh().left;
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
    for (unsigned int f = 0; f < sampled.mesh.facets.size(); ++f)
      {
        Sample sample;
        if (!sampled.mesh.has_left(f) && there.point_inside(middle(sampled.mesh, f)) &&
            find_sample(f, search, sample))
          samples_.push_back(std::move(sample));
      }
    read_displacements();
    if (!law.conserving)
      return;
    const FacetSearch<dim> search_end(other.end, box_around(sampled.end, reach));
    for (Sample &sample : samples_)
      tilt_to_end(search_end, sample);
  }



  /** What a facet meets; false if it is no contact. */
  template <int dim>
  bool
  SurfaceSamples<dim>::find_sample(const unsigned int      facet,
                                   const FacetSearch<dim> &search,
                                   Sample                 &sample)
  {
    const auto   known    = memory.find(facet);
    const auto   previous = known == memory.end() ? search.no_facet : known->second.partner;
    const auto   outward  = area_vector<dim>(sampled.mesh.corners(facet));
    const double area     = outward.norm();
    // facets may have been divided and united since
    const auto guess = guesses[facet] < other.mesh.facets.size() ? guesses[facet] : search.no_facet;
    if (!(area > 0.) || !search.find(middle(sampled.mesh, facet),
                                     outward / area,
                                     reach,
                                     previous,
                                     sample.partner,
                                     guess))
      return false;
    guesses[facet] = sample.partner.facet;
    sample.facet   = facet;
    sample.area    = share * sampled.surface.reference_area(facet);
    if (!set_start(sample))
      return false;
    sample.stretch     = sampled.surface.stretch(facet);
    sample.shear_limit = sample.stretch * shear_limit_at(sample);
    sample.on_partner  = functions_on_partner(sample);
    return true;
  }



  /** Those of the other body over the facet, moved so that its middle lies at the partner's place.
   */
  template <int dim>
  MeanFunctions
  SurfaceSamples<dim>::functions_on_partner(const Sample &sample) const
  {
    const dealii::Tensor<1, dim> to_partner = partner_place(sample) - place(sample);
    auto                         corners    = sampled.surface.mesh().corners(sample.facet);
    for (auto &corner : corners)
      corner += to_partner;
    return mean_functions<dim>(other.surface,
                               corners,
                               -sample.partner.normal,
                               sample.partner.facet);
  }



  template <int dim>
  void
  SurfaceSamples<dim>::read_displacements()
  {
    std::vector<dealii::Tensor<1, dim>> of_samples;
    if (!sampled.nodal.empty() || !other.nodal.empty())
      for (const Sample &sample : samples_)
        of_samples.push_back(own_part_of_mean<dim>(on_sampled(sample), sampled.nodal) -
                             own_part_of_mean<dim>(sample.on_partner, other.nodal));
    of_samples.resize(samples_.size());
    sum_over_ranks<dim>(sampled.surface.patch, of_samples);
    for (std::size_t n = 0; n < samples_.size(); ++n)
      samples_[n].D = of_samples[n];
  }



  template <int dim>
  std::vector<typename SurfaceSamples<dim>::Sample>
  SurfaceSamples<dim>::find_anew()
  {
    std::vector<Sample> before;
    samples_.swap(before);
    find();
    auto known = before.begin(); // both ascend
    for (Sample &sample : samples_)
      {
        while (known != before.end() && known->facet < sample.facet)
          ++known;
        sample.multiplier = 0.;
        if (known == before.end() || known->facet != sample.facet || !(known->multiplier > 0.))
          continue;
        sample.multiplier = known->multiplier;
        sample.slip_n     = turned(known->slip_n, known->partner.normal, sample.partner.normal);
      }
    return before;
  }



  template <int dim>
  void
  SurfaceSamples<dim>::for_multipliers(CellMultipliers<dim> &cells)
  {
    for (Sample &sample : samples_)
      cells.add(place_at_balance(sample),
                sample.area,
                sample.partner.normal,
                law,
                sample.multiplier,
                sample.slip_n,
                response(sample));
  }



  /** Of the middle of a sample's facet and of its partner's place, by the vertices. */
  template <int dim>
  dealii::Tensor<1, dim>
  SurfaceSamples<dim>::displacement_of_middle(const Sample &sample) const
  {
    dealii::Tensor<1, dim> D;
    for (const unsigned int v : sampled.mesh.facets[sample.facet])
      D += sampled.displacements[v] / dim;
    const auto &facet = other.mesh.facets[sample.partner.facet];
    for (int i = 0; i < dim; ++i)
      D -= sample.partner.weights[i] * other.displacements[facet[i]];
    return D;
  }



  /**
   * Tilts s so that g_0 + s.D is the gap that the moved surfaces have at the end of the step, but
   * for how far the mean over the facet has led its middle: a part of a strain, which comes and
   * goes with it.
   */
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
    const dealii::Tensor<1, dim> D        = displacement_of_middle(sample);
    const dealii::Tensor<1, dim> D_t      = D - (D * sample.partner.normal) * sample.partner.normal;
    const double                 way      = D_t.norm();
    const double missing = measured + sample.lead_n - sample.gap_n - sample.gap_slope * D;
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
      {
        sample.gap_n  = last.gap;
        sample.lead_n = last.lead;
      }
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
  typename SurfaceSamples<dim>::Outcome
  SurfaceSamples<dim>::outcome(const Sample &sample) const
  {
    return {response(sample),
            sample.partner.normal * (place(sample) - partner_place(sample) + sample.D)};
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
                                  sample.partner.normal,
                                  sample.lead_n +
                                    sample.gap_slope * (sample.D - displacement_of_middle(sample))};
      }
    return result;
  }

  template struct MovingSurface<2>;
  template struct MovingSurface<3>;
  template class SurfaceSamples<2>;
  template class SurfaceSamples<3>;
} // namespace kedge
