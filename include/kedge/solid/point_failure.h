#ifndef kedge_solid_point_failure_h
#define kedge_solid_point_failure_h

#include <kedge/fields/patch.h>

namespace kedge
{
  /**
   * Why a point has no answer to a trial displacement, in words: a volume that is not left, pores
   * that are not, or else @p otherwise.
   *
   * @param displacement of the step, dim values per local node [m]
   * @param fraction     of the step at which the balance is stated
   * @param grains       volume of grains over that at the start, 1 - n_0, of each body; empty: none
   *                     has pores to lose
   */
  template <int dim>
  std::string
  describe_failure(const Patch<dim>          &patch,
                   const unsigned int         slot,
                   const std::vector<double> &displacement,
                   const double               fraction,
                   const std::vector<double> &grains,
                   const std::string         &otherwise);
} // namespace kedge

#endif
