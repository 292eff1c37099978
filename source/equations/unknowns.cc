#include <kedge/equations/unknowns.h>

namespace kedge
{
  template <int dim>
  unsigned int
  Unknowns<dim>::add_others(const unsigned int n, const Retraction &retraction)
  {
    ranges.push_back({n_others_, n, retraction});
    n_others_ += n;
    return ranges.back().first;
  }



  template <int dim>
  void
  Unknowns<dim>::retract(const UnknownVector &base,
                         const double         s,
                         const UnknownVector &dx,
                         UnknownVector       &x) const
  {
    for (std::size_t f = 0; f < fields.size(); ++f)
      for (std::size_t k = 0; k < x.fields[f].size(); ++k)
        x.fields[f][k] = base.fields[f][k] + s * dx.fields[f][k];
    std::vector<double> change(n_others_);
    for (unsigned int k = 0; k < n_others_; ++k)
      change[k] = s * dx.others[k];
    for (const Range &range : ranges)
      if (range.retraction)
        range.retraction(base.others.data() + range.first,
                         change.data() + range.first,
                         x.others.data() + range.first);
      else
        for (unsigned int k = range.first; k < range.first + range.n; ++k)
          x.others[k] = base.others[k] + change[k];
  }

  template class Unknowns<2>;
  template class Unknowns<3>;
} // namespace kedge
