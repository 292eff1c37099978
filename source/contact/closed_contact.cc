#include <kedge/base/exceptions.h>
#include <kedge/contact/closed_contact.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  ContactMemory<dim>
  handed_on(ContactMemory<dim> &&of_step,
            const FacetHeritage &facets,
            const FacetHeritage &partners)
  {
    if (!partners.empty())
      for (auto &[facet, last] : of_step)
        last.partner = partners.heirs[last.partner];
    if (facets.empty())
      return std::move(of_step);
    return facets.hand_on(of_step, [](const auto &parts) {
      const auto largest =
        std::max_element(parts.begin(), parts.end(), [](const auto &a, const auto &b) {
          return a.second < b.second;
        });
      PartneredContact<dim> result{mean_of_parts<dim>(parts),
                                   largest->first->partner,
                                   largest->first->normal};
      // slips are across the normal that is kept
      result.slip = dealii::Tensor<1, dim>();
      for (const auto &[part, share] : parts)
        {
          result.slip += share * turned(part->slip, part->normal, result.normal);
          result.lead += share * part->lead;
        }
      return result;
    });
  }



  std::vector<double>::const_iterator
  first_record(const std::vector<double> &saved, const std::size_t width)
  {
    if (saved.empty() || saved.front() != double(width) || (saved.size() - 1) % width != 0)
      throw UserError("The checkpoint was written by another version of kedge, whose contacts "
                      "remember other values. Resume with that version, or start afresh without "
                      "--resume.");
    return saved.begin() + 1;
  }



  namespace
  {
    template <int dim>
    constexpr std::size_t width_of_record = 5 + 2 * dim;
  }



  template <int dim>
  std::vector<double>
  saved(const ContactMemory<dim> &memory)
  {
    std::vector<double> result{double(width_of_record<dim>)};
    for (const auto &[facet, last] : memory)
      {
        result.insert(result.end(),
                      {double(facet), double(last.partner), last.gap, last.multiplier, last.lead});
        result.insert(result.end(), last.slip.begin_raw(), last.slip.end_raw());
        result.insert(result.end(), last.normal.begin_raw(), last.normal.end_raw());
      }
    return result;
  }



  template <int dim>
  ContactMemory<dim>
  restored(const std::vector<double> &saved, const ContactLaw &law, const bool to_gaps)
  {
    ContactMemory<dim> memory;
    constexpr auto     width = width_of_record<dim>;
    for (auto next = first_record(saved, width); next != saved.end(); next += width)
      {
        PartneredContact<dim> last;
        last.partner    = static_cast<unsigned int>(next[1]);
        last.gap        = next[2];
        last.multiplier = next[3];
        last.lead       = next[4];
        for (int d = 0; d < dim; ++d)
          {
            last.slip[d]   = next[5 + d];
            last.normal[d] = next[5 + dim + d];
          }
        if (to_gaps)
          {
            last.gap -= last.multiplier / law.normal_stiffness;
            last.multiplier = 0.;
          }
        memory.emplace(static_cast<unsigned int>(next[0]), last);
      }
    return memory;
  }

#define KEDGE_INSTANTIATE(dim)                                            \
  template ContactMemory<dim>  handed_on(ContactMemory<dim> &&,           \
                                         const FacetHeritage &,           \
                                         const FacetHeritage &);          \
  template std::vector<double> saved(const ContactMemory<dim> &);         \
  template ContactMemory<dim>  restored<dim>(const std::vector<double> &, \
                                            const ContactLaw &,          \
                                            const bool);
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
#undef KEDGE_INSTANTIATE
} // namespace kedge
