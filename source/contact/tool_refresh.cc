// What ToolTerm finds anew once the equations are solved.
#include <kedge/contact/cell_multipliers.h>
#include <kedge/contact/tool_term.h>

namespace kedge
{
  template <int dim>
  std::vector<std::vector<dealii::Tensor<1, dim>>>
  ToolTerm<dim>::forces() const
  {
    std::vector<std::vector<dealii::Tensor<1, dim>>> result;
    for (const auto &side : sides)
      {
        result.emplace_back(side->n_places());
        for (const Sample &sample : side->samples)
          result.back()[sample.key] = sample.area * side->response(sample).traction;
      }
    return result;
  }



  /** Finds the samples anew; keeps those before if the forces are nearly the same. */
  template <int dim>
  bool
  ToolTerm<dim>::directions_have_changed()
  {
    const auto                       before = forces();
    std::vector<std::vector<Sample>> samples;
    for (const auto &side : sides)
      {
        samples.push_back(side->samples);
        side->find_anew();
      }
    const auto after = forces();
    double     size = 0., change = 0.;
    for (std::size_t k = 0; k < before.size(); ++k)
      for (std::size_t f = 0; f < before[k].size(); ++f)
        {
          size += std::max(before[k][f].norm(), after[k][f].norm());
          change += (after[k][f] - before[k][f]).norm();
        }
    if (change > small_change * size)
      return true;
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k]->samples.swap(samples[k]);
    return false;
  }



  /** Uzawa's step at rest; false if no cell has a large gap and nothing that sticks creeps. */
  template <int dim>
  bool
  ToolTerm<dim>::update_multipliers()
  {
    if (n_updates == most_updates)
      return false;
    const Lattice<dim> &lattice  = sides.front()->body.surface->patch.grid().levels().finest();
    const auto          add_side = [](auto &side, CellMultipliers<dim> &cells) {
      for (Sample &sample : side->samples)
        cells.add(side->place_at_balance(sample),
                  sample.area,
                  sample.normal,
                  side->law,
                  sample.multiplier,
                  sample.slip,
                  side->response(sample));
    };
    if (!kedge::update_multipliers<dim>(sides, lattice, add_side))
      return false;
    ++n_updates;
    return true;
  }



  template <int dim>
  bool
  ToolTerm<dim>::refresh(const Trial<dim> &trial)
  {
    move(trial);
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

#define KEDGE_INSTANTIATE(dim)                                                             \
  template std::vector<std::vector<dealii::Tensor<1, dim>>> ToolTerm<dim>::forces() const; \
  template bool ToolTerm<dim>::directions_have_changed();                                  \
  template bool ToolTerm<dim>::update_multipliers();                                       \
  template bool ToolTerm<dim>::refresh(const Trial<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
