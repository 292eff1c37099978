// What a contact takes anew once the equations are solved: directions, partners, multipliers.
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



  template <int dim>
  bool
  ContactTerm<dim>::refresh(const Trial<dim> &trial)
  {
    using Samples = std::vector<std::vector<typename SurfaceSamples<dim>::Sample>>;
    move_surfaces(trial);
    const auto find_anew = [&]() {
      Samples known;
      for (auto &half : passes)
        known.push_back(half.find_anew());
      return known;
    };
    const auto go_back = [&](Samples &known) {
      for (std::size_t k = 0; k < passes.size(); ++k)
        passes[k].exchange(known[k]);
    };
    const bool again = directions.pass(
      [&]() {
        return sample_forces();
      },
      find_anew,
      go_back);
    if (!at_rest)
      return again;
    const auto &grid      = passes.front().sampled.surface.patch.grid();
    const auto  bodies_of = [](const SurfaceSamples<dim> &half) {
      return "'" + half.sampled.surface.body_name + "' and '" + half.other.surface.body_name + "'";
    };
    const auto add_side = [](SurfaceSamples<dim> &half, CellMultipliers<dim> &cells) {
      half.for_multipliers(cells);
    };
    return uzawa.step(passes, grid.levels().finest(), bodies_of, add_side) || again;
  }



  template <int dim>
  bool
  WallTerm<dim>::refresh(const Trial<dim> &trial)
  {
    if (!at_rest)
      return false;
    move(trial);
    const auto bodies_of = [](const Side &side) {
      return "'" + side.surface->body_name + "' and the wall";
    };
    const auto add_side = [&](Side &side, CellMultipliers<dim> &cells) {
      for (Sample &sample : side.samples)
        cells.add(sample.place + alpha * sample.D,
                  sample.area,
                  plane.normal,
                  side.law,
                  sample.start.multiplier,
                  sample.start.slip,
                  response(side, sample));
    };
    const auto &grid = sides.front().surface->patch.grid();
    return uzawa.step(sides, grid.levels().finest(), bodies_of, add_side);
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
