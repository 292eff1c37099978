// What ToolTerm finds anew once the equations are solved.
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



  template <int dim>
  bool
  ToolTerm<dim>::refresh(const Trial<dim> &trial)
  {
    move(trial);
    const auto find_anew = [&]() {
      std::vector<std::vector<Sample>> known;
      for (const auto &side : sides)
        {
          known.push_back(side->samples);
          side->find_anew();
        }
      return known;
    };
    const auto go_back = [&](std::vector<std::vector<Sample>> &known) {
      for (std::size_t k = 0; k < sides.size(); ++k)
        sides[k]->samples.swap(known[k]);
    };
    const bool again = directions.pass(
      [&]() {
        return forces();
      },
      find_anew,
      go_back);
    if (!at_rest)
      return again;
    const auto &grid      = sides.front()->body.surface->patch.grid();
    const auto  bodies_of = [&](const auto &side) {
      return "'" + side->body.surface->body_name + "' and '" + rigid[tool].name + "'";
    };
    const auto add_side = [](auto &side, CellMultipliers<dim> &cells) {
      for (Sample &sample : side->samples)
        cells.add(side->place_at_balance(sample),
                  sample.area,
                  sample.normal,
                  side->law,
                  sample.multiplier,
                  sample.slip,
                  side->response(sample));
    };
    return uzawa.step(sides, grid.levels().finest(), bodies_of, add_side) || again;
  }

#define KEDGE_INSTANTIATE(dim)                                                             \
  template std::vector<std::vector<dealii::Tensor<1, dim>>> ToolTerm<dim>::forces() const; \
  template bool ToolTerm<dim>::refresh(const Trial<dim> &);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
