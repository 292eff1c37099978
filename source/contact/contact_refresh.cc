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
    std::vector<std::vector<typename SurfaceSamples<dim>::Sample>> samples;
    for (auto &half : passes)
      samples.push_back(half.find_anew());
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
    const Lattice<dim> &lattice = passes.front().sampled.surface.patch.grid().levels().finest();
    if (!kedge::update_multipliers<dim>(passes,
                                        lattice,
                                        [](SurfaceSamples<dim> &half, CellMultipliers<dim> &cells) {
                                          half.for_multipliers(cells);
                                        }))
      return false;
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
    const Lattice<dim> &lattice = sides.front().surface->patch.grid().levels().finest();
    if (!update_multipliers<dim>(sides, lattice, [&](Side &side, CellMultipliers<dim> &cells) {
          for (Sample &sample : side.samples)
            cells.add(sample.place + alpha * sample.D,
                      sample.area,
                      plane.normal,
                      side.law,
                      sample.start.multiplier,
                      sample.start.slip,
                      response(side, sample));
        }))
      return false;
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
