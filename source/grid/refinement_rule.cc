#include <kedge/base/exceptions.h>
#include <kedge/grid/refinement_rule.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** Whether one of the variables occurs in an expression. */
    bool
    depends_on(const std::string            &variable,
               const std::string            &expression,
               std::map<std::string, double> constants)
    {
      for (const std::string &other : refinement_variables())
        if (other != variable)
          constants[other] = 0.;
      return !Expression(expression, {variable}, constants).is_constant();
    }
  } // namespace



  template <int dim>
  RefinementRule<dim>::RefinementRule(const std::string                   &expression,
                                      const std::map<std::string, double> &constants)
  {
    if (expression.empty())
      return;
    refinement       = Expression(expression, refinement_variables(), constants);
    follows_time     = depends_on("t", expression, constants);
    follows_strain   = depends_on("plastic_strain", expression, constants);
    follows_distance = depends_on("distance", expression, constants);
  }



  template <int dim>
  std::vector<dealii::Point<dim>>
  middles_of_cells(const Lattice<dim> &lattice, const LatticeWindow<dim> &cells)
  {
    std::vector<dealii::Point<dim>> result(cells.n_cells_total());
    for (unsigned int c = 0; c < result.size(); ++c)
      {
        const LatticeIndex<dim> cell = cells.cell_index(c);
        for (int d = 0; d < dim; ++d)
          result[c][d] = lattice.origin[d] + (cell[d] + 0.5) * lattice.h[d];
      }
    return result;
  }



  template <int dim>
  std::vector<unsigned char>
  RefinementRule<dim>::wanted(const Lattice<dim>       &lattice,
                              const LatticeWindow<dim> &cells,
                              const RefinementState    &state) const
  {
    std::vector<unsigned char> result(cells.n_cells_total(), 0);
    if (!refinement)
      return result;
    const auto middles = middles_of_cells(lattice, cells);
    for (unsigned int c = 0; c < result.size(); ++c)
      {
        double values[6] = {0.,
                            0.,
                            0.,
                            state.t,
                            state.plastic_strain.empty() ? 0. : state.plastic_strain[c],
                            state.distance.empty() ? std::numeric_limits<double>::max()
                                                   : state.distance[c]};
        for (int d = 0; d < dim; ++d)
          values[d] = middles[c][d];
        const double value = (*refinement)(values);
        if (!(value >= 0. && value <= most_refinements && value == std::floor(value)))
          {
            std::ostringstream message;
            message << "Grid/Refinement is " << value << " at (" << values[0] << " " << values[1];
            if (dim == 3)
              message << " " << values[2];
            message << "), the middle of a cell, at t = " << state.t
                    << " s; it must be a whole number from 0 to " << most_refinements
                    << ": how often the cell is halved in each direction.";
            throw UserError(message.str());
          }
        result[c] = static_cast<unsigned char>(value);
      }
    return result;
  }

  template std::vector<dealii::Point<2>>
  middles_of_cells(const Lattice<2> &, const LatticeWindow<2> &);
  template std::vector<dealii::Point<3>>
  middles_of_cells(const Lattice<3> &, const LatticeWindow<3> &);
  template class RefinementRule<2>;
  template class RefinementRule<3>;
} // namespace kedge
