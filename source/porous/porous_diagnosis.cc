#include <kedge/porous/porous_problem.h>

#include <iomanip>

namespace kedge
{
  namespace
  {
    /** A tangent worse than this may be why Newton's method fails. */
    constexpr double suspicious_condition = 1e12;
  } // namespace



  template <int dim>
  std::string
  PorousProblem<dim>::diagnosis() const
  {
    if (!warning_.empty() || condition < suspicious_condition)
      return warning_;
    std::ostringstream text;
    text << std::scientific << std::setprecision(0) << "the tangent is nearly singular (condition "
         << condition << ")" << describe_equation(weakest_equation);
    return text.str();
  }



  template <int dim>
  std::string
  PorousProblem<dim>::describe_point(const unsigned int slot) const
  {
    std::ostringstream text;
    unsigned int       body = 0;
    for (const auto &batch : points->batches)
      if (slot >= batch.begin && slot < batch.end)
        body = batch.body;
    text << "material point " << points->id[slot] << " of body '" << body_names[body] << "' at ("
         << points->location[slot] << ") has det F <= 0 or no finite stress";
    return text.str();
  }



  template <int dim>
  std::string
  PorousProblem<dim>::describe_equation(const std::int64_t equation) const
  {
    if (equation < 0)
      return "";
    const SparseSystem &system         = equations.system();
    double              place[dim + 2] = {};
    if (equation >= system.first_row && equation < system.first_row + system.n_rows())
      {
        const unsigned int k =
          equations.nodal_index(static_cast<unsigned int>(equation - system.first_row));
        const auto x = grid->lattice().node_position(
          grid->window().node_index(nodes->window_node(k / (dim + 1))));
        for (int d = 0; d < dim; ++d)
          place[d] = x[d];
        place[dim] = k % (dim + 1);
      }
    MPI_Allreduce(MPI_IN_PLACE, place, dim + 2, MPI_DOUBLE, MPI_SUM, nodes->communicator());
    const int          component = static_cast<int>(place[dim]);
    std::ostringstream text;
    text << ": nothing holds the "
         << (component == dim ? std::string("pore pressure")
                              : std::string("displacement component ") + "xyz"[component])
         << " of the node at (";
    for (int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << place[d];
    text << "), in the cells around it the body is too thin or too loosely held";
    return text.str();
  }

  template class PorousProblem<2>;
  template class PorousProblem<3>;
} // namespace kedge
