#include <kedge/equations/residual.h>

#include <cmath>

namespace kedge
{
  template <int dim>
  Residual<dim>::Residual(const std::vector<const Patch<dim> *> &patches,
                          const Unknowns<dim>                   &unknowns,
                          const Tangent<dim>                    &tangent)
    : patches(patches)
    , unknowns(unknowns)
    , tangent(tangent)
    , fields(patches.size())
  {}



  template <int dim>
  void
  Residual<dim>::reinit()
  {
    for (unsigned int f = 0; f < fields.size(); ++f)
      {
        const std::size_t n =
          std::size_t(patches[f]->nodes.n_local()) * unknowns.fields[f].n_components;
        fields[f].of_term.assign(n, 0.);
        fields[f].sum.assign(n, 0.);
      }
    others_.assign(unknowns.n_others(), 0.);
  }



  template <int dim>
  void
  Residual<dim>::set_zero()
  {
    for (Field &field : fields)
      std::fill(field.sum.begin(), field.sum.end(), 0.);
    std::fill(others_.begin(), others_.end(), 0.);
    squares.clear();
  }



  template <int dim>
  void
  Residual<dim>::add_square(const double square)
  {
    squares.push_back(square);
    has_square = true;
  }



  template <int dim>
  void
  Residual<dim>::end_term()
  {
    double square = 0.;
    for (unsigned int f = 0; f < fields.size(); ++f)
      {
        Field &field = fields[f];
        if (!field.is_partial && !field.is_complete)
          continue;
        const unsigned int n_components = unknowns.fields[f].n_components;
        if (field.is_partial)
          {
            patches[f]->constraints.restrict_sums(field.of_term);
            patches[f]->nodes.add_to_owners(field.of_term, n_components);
          }
        if (!has_square)
          for (const unsigned int k : tangent.equations_of_field(f))
            square += std::pow(unknowns.fields[f].weight[k % n_components] * field.of_term[k], 2);
        for (std::size_t k = 0; k < field.sum.size(); ++k)
          {
            field.sum[k] += field.of_term[k];
            field.of_term[k] = 0.;
          }
        field.is_partial = field.is_complete = false;
      }
    if (!has_square)
      squares.push_back(square);
    has_square = false;
  }



  template <int dim>
  NewtonProblem::Evaluation
  Residual<dim>::end(const std::vector<std::vector<double>> &diagonal,
                     const UnknownVector                    &x,
                     const unsigned int                      n_failed)
  {
    double square = 0., by_diagonal = 0.;
    for (unsigned int f = 0; f < fields.size(); ++f)
      {
        const auto        &weight       = unknowns.fields[f].weight;
        const unsigned int n_components = unknowns.fields[f].n_components;
        const auto        &equations    = tangent.equations_of_field(f);
        for (const unsigned int k : equations)
          square += std::pow(weight[k % n_components] * fields[f].sum[k], 2);
        if (unknowns.fields[f].measure_diagonal)
          for (unsigned int e = 0; e < diagonal[f].size(); ++e)
            {
              const unsigned int k = equations[e];
              by_diagonal +=
                std::pow(weight[k % n_components] * diagonal[f][e] * x.fields[f][k], 2);
            }
      }
    const MPI_Comm communicator = patches.front()->nodes.communicator();
    if (!others_.empty())
      dealii::Utilities::MPI::sum(others_, communicator, others_);
    squares.insert(squares.end(), {by_diagonal, square, static_cast<double>(n_failed)});
    MPI_Allreduce(MPI_IN_PLACE,
                  squares.data(),
                  static_cast<int>(squares.size()),
                  MPI_DOUBLE,
                  MPI_SUM,
                  communicator);
    const std::size_t n = squares.size();
    for (const double other : others_)
      squares[n - 2] += other * other;

    NewtonProblem::Evaluation result;
    result.residual_norm = std::sqrt(squares[n - 2]);
    result.ok            = squares[n - 1] == 0. && std::isfinite(squares[n - 2]);
    for (std::size_t k = 0; k + 2 < n; ++k)
      result.scale += std::sqrt(squares[k]);
    return result;
  }



  template <int dim>
  const UnknownVector
  Residual<dim>::all() const
  {
    UnknownVector result;
    for (const Field &field : fields)
      result.fields.push_back(field.sum);
    result.others = others_;
    return result;
  }

  template class Residual<2>;
  template class Residual<3>;
} // namespace kedge
