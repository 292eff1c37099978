// What a contact takes anew once the equations are solved: directions, partners, multipliers.
#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/contact_term.h>
#include <kedge/contact/wall_term.h>

namespace kedge
{
  /** Of each half, by sampled facet. */
  template <int dim>
  std::vector<typename ContactTerm<dim>::Forces>
  ContactTerm<dim>::sample_forces() const
  {
    std::vector<Forces> forces;
    for (const auto &half : passes)
      {
        forces.emplace_back(half.sampled.surface.n_facets());
        for (const auto &sample : half.samples())
          forces.back()[sample.facet] = sample.area * half.response(sample).traction;
      }
    return forces;
  }



  /** Finds the samples anew; keeps those before if the forces are nearly the same. */
  template <int dim>
  bool
  ContactTerm<dim>::directions_have_changed()
  {
    const std::vector<Forces>                                      before = sample_forces();
    std::vector<std::vector<typename SurfaceSamples<dim>::Sample>> samples(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k)
      {
        samples[k] = passes[k].samples();
        passes[k].find_anew();
      }
    const std::vector<Forces> after = sample_forces();
    double                    size = 0., change = 0.;
    for (std::size_t k = 0; k < passes.size(); ++k)
      for (std::size_t f = 0; f < before[k].size(); ++f)
        {
          size += std::max(before[k][f].norm(), after[k][f].norm());
          change += (after[k][f] - before[k][f]).norm();
        }
    if (change > small_change * size)
      return true;
    for (std::size_t k = 0; k < passes.size(); ++k)
      passes[k].exchange(samples[k]);
    return false;
  }



  /** Uzawa's step; false if no cell has a large gap and nothing that sticks creeps. */
  template <int dim>
  bool
  ContactTerm<dim>::update_multipliers()
  {
    if (n_updates == most_updates)
      return false;
    using Multipliers = typename SurfaceSamples<dim>::Multipliers;
    double                                           largest = 0.; // violation [m]
    std::vector<std::map<unsigned int, Multipliers>> multipliers;
    for (const auto &half : passes)
      {
        CellMultipliers<dim> cells(half.sampled.surface.patch.grid().lattice());
        multipliers.emplace_back();
        for (const auto &sample : half.samples())
          {
            const ContactResponse<dim> here = half.response(sample);
            cells.add(half.place_at_balance(sample),
                      sample.area,
                      half.law,
                      sample.multiplier,
                      sample.slip_n,
                      here);
            if (here.pressure > 0.)
              multipliers.back()[sample.facet] = {0., here.slip_end, sample.partner.normal};
          }
        for (std::size_t n = 0; n < half.samples().size(); ++n)
          if (const auto known = multipliers.back().find(half.samples()[n].facet);
              known != multipliers.back().end())
            known->second.pressure = cells.updated(n);
        largest = std::max(largest, cells.largest_violation());
      }
    if (largest <= smallest_gap * cell_size)
      return false;
    for (std::size_t k = 0; k < passes.size(); ++k)
      passes[k].set_multipliers(multipliers[k]);
    ++n_updates;
    return true;
  }



  template <int dim>
  bool
  ContactTerm<dim>::refresh(const Trial<dim> &trial)
  {
    move_surfaces(trial);
    bool again = false;
    if (n_passes < most_passes && directions_have_changed())
      {
        ++n_passes;
        again = true;
      }
    if (at_rest)
      again = update_multipliers() || again;
    return again;
  }



  /** Uzawa's step at rest; false if no cell has a large gap and nothing that sticks creeps. */
  template <int dim>
  bool
  WallTerm<dim>::refresh(const Trial<dim> &trial)
  {
    if (!at_rest || n_updates == most_updates)
      return false;
    move(trial);
    std::vector<CellMultipliers<dim>>                cells;
    std::vector<std::vector<dealii::Tensor<1, dim>>> slips;
    double                                           largest = 0.; // [m]
    for (const Side &side : sides)
      {
        cells.emplace_back(side.surface->patch.grid().lattice());
        slips.emplace_back();
        for (const Sample &sample : side.samples)
          {
            const ContactResponse<dim> here = response(side, sample);
            cells.back().add(sample.place + alpha * displacement(side, sample),
                             sample.area,
                             side.law,
                             sample.start.multiplier,
                             sample.start.slip,
                             here);
            slips.back().push_back(here.slip_end);
          }
        largest = std::max(largest, cells.back().largest_violation());
      }
    if (largest <= smallest_gap * cell_size)
      return false;
    for (std::size_t k = 0; k < sides.size(); ++k)
      for (std::size_t n = 0; n < sides[k].samples.size(); ++n)
        {
          sides[k].samples[n].start.multiplier = cells[k].updated(n);
          sides[k].samples[n].start.slip       = slips[k][n];
        }
    ++n_updates;
    return true;
  }

  template bool
  ContactTerm<2>::refresh(const Trial<2> &);
  template bool
  ContactTerm<3>::refresh(const Trial<3> &);
  template bool
  WallTerm<2>::refresh(const Trial<2> &);
  template bool
  WallTerm<3>::refresh(const Trial<3> &);
} // namespace kedge
