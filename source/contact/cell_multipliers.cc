#include <kedge/contact/cell_multipliers.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace kedge
{
  namespace
  {
    /** 2 d + 1 if the largest component of a direction is a positive one along d, else 2 d. */
    template <int dim>
    unsigned int
    side_of(const dealii::Tensor<1, dim> &direction)
    {
      unsigned int along = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(direction[d]) > std::abs(direction[along]))
          along = d;
      return 2 * along + (direction[along] > 0. ? 1 : 0);
    }
  } // namespace



  template <int dim>
  void
  CellMultipliers<dim>::add(const dealii::Point<dim>     &place,
                            const double                  area,
                            const dealii::Tensor<1, dim> &normal,
                            const ContactLaw             &law,
                            double                       &multiplier,
                            dealii::Tensor<1, dim>       &slip,
                            const ContactResponse<dim>   &response)
  {
    const bool presses = response.pressure > 0.;
    places.push_back({{lattice.cell_of(place), side_of(normal)},
                      place,
                      presses,
                      response.sticks,
                      &multiplier,
                      law.normal_stiffness,
                      &slip,
                      response.slip_end,
                      normal});
    if (!presses)
      return;
    Gap &here = gaps[places.back().key];
    here.area += area;
    here.sum += area * (multiplier - response.pressure) / law.normal_stiffness;
    if (response.sticks)
      for_nodes(places.back(), [&](const Key &node, const double N) {
        Creep &there = creeps[node];
        there.area += N * area;
        there.sum += N * area * (response.slip_end - slip);
      });
  }



  template <int dim>
  template <typename F>
  void
  CellMultipliers<dim>::for_nodes(const Place &place, const F &f) const
  {
    for (unsigned int corner = 0; corner < (1u << dim); ++corner)
      {
        Key    node = place.key;
        double N    = 1.;
        for (int d = 0; d < dim; ++d)
          {
            const double s        = lattice.scaled(place.at[d], d) - place.key.first[d];
            const bool   is_upper = (corner >> d) & 1u;
            N *= is_upper ? s : 1. - s;
            node.first[d] += is_upper;
          }
        if (N > 0.)
          f(node, N);
      }
  }



  template <int dim>
  std::pair<double, LatticeIndex<dim>>
  CellMultipliers<dim>::worst_gap() const
  {
    std::pair<double, LatticeIndex<dim>> worst{0., {}};
    for (const auto &[cell, gap] : gaps)
      if (const double mean = std::abs(gap.sum) / gap.area; mean > worst.first)
        worst = {mean, cell.first};
    return worst;
  }



  template <int dim>
  std::pair<double, LatticeIndex<dim>>
  CellMultipliers<dim>::worst_creep() const
  {
    std::pair<double, LatticeIndex<dim>> worst{0., {}};
    double                               largest_area = 0.;
    for (const auto &[node, creep] : creeps)
      {
        if (creep.sum.norm() > worst.first)
          worst = {creep.sum.norm(), node.first};
        largest_area = std::max(largest_area, creep.area);
      }
    if (largest_area > 0.)
      worst.first /= largest_area;
    return worst;
  }



  template <int dim>
  std::string
  CellMultipliers<dim>::left() const
  {
    const double cell_size   = lattice.smallest_cell_size();
    const auto [gap, cell]   = worst_gap();
    const auto [creep, node] = worst_creep();
    std::ostringstream text;
    if (gap > smallest_gap * cell_size)
      text << "gaps of " << gap << " m, " << smallest_gap * cell_size
           << " m allowed, in the cell from (" << lattice.node_position(cell) << ") on";
    else if (creep > smallest_creep * cell_size)
      text << "creep of " << creep << " m, " << smallest_creep * cell_size
           << " m allowed, of what sticks around (" << lattice.node_position(node) << ")";
    return text.str();
  }



  template <int dim>
  void
  CellMultipliers<dim>::update() const
  {
    for (const Place &place : places)
      {
        if (!place.presses)
          {
            *place.multiplier = 0.;
            continue;
          }
        const Gap &gap    = gaps.at(place.key);
        *place.multiplier = std::max(*place.multiplier - place.stiffness * gap.sum / gap.area, 0.);
        if (!place.sticks)
          {
            *place.slip = place.slip_end;
            continue;
          }
        dealii::Tensor<1, dim> creep;
        for_nodes(place, [&](const Key &node, const double N) {
          const Creep &there = creeps.at(node);
          creep += N / there.area * there.sum;
        });
        *place.slip += creep - (creep * place.normal) * place.normal;
      }
  }

  template class CellMultipliers<2>;
  template class CellMultipliers<3>;
} // namespace kedge
