#ifndef kedge_materials_lane_by_lane_h
#define kedge_materials_lane_by_lane_h

#include <kedge/materials/history.h>

#include <utility>

namespace kedge
{
  /**
   * A law that is written for one point, as one that answers several at once: it is asked
   * lane by lane. Only the law itself is: what stands around it, spectra, stresses of the
   * step and their tangents, is computed for all lanes together.
   */
  template <class Law>
  class LaneByLane : public Law
  {
  public:
    static constexpr bool takes_packs = true;

    /** The answers of the law, one for each lane. */
    template <typename Number>
    struct Response
    {
      using One =
        decltype(std::declval<const Law &>().respond(std::declval<const double (&)[3]>(),
                                                     std::declval<const double (&)[3]>(),
                                                     std::declval<const HistoryOf<Law> &>()));

      Number            kirchhoff_stress[3]; ///< principal values tau_i [Pa]
      Number            work_increment;      ///< [J/m^3]
      Condition<Number> valid;
      One               lane[pack_width];

      /** That of a lane, at the stress as it is now. */
      One
      of(const unsigned int l) const
      {
        One one = lane[l];
        for (int i = 0; i < 3; ++i)
          one.kirchhoff_stress[i] = kirchhoff_stress[i][l];
        return one;
      }
    };

    explicit LaneByLane(const Law &law)
      : Law(law)
    {}

    Response<Pack>
    respond(const Pack (&strain_n)[3],
            const Pack (&increment)[3],
            const HistoryOf<Law, Pack> &history = {}) const
    {
      Response<Pack> result;
      result.valid = PackMask{};
      for (unsigned int l = 0; l < pack_width; ++l)
        {
          double at[3], by[3];
          for (int i = 0; i < 3; ++i)
            {
              at[i] = strain_n[i][l];
              by[i] = increment[i][l];
            }
          auto &one  = result.lane[l];
          one        = Law::respond(at, by, history_of(history, l));
          bool valid = true;
          if constexpr (Law::can_fail)
            valid = one.valid;
          result.valid.lanes[l] = valid ? -1 : 0;
          for (int i = 0; i < 3; ++i)
            result.kirchhoff_stress[i].set(l, valid ? one.kirchhoff_stress[i] : 0.);
          result.work_increment.set(l, valid ? one.work_increment : 0.);
        }
      return result;
    }

    Pack
    tangent(const Response<Pack> &response, const int i, const int j) const
    {
      return in_lanes(response, [&](const typename Response<Pack>::One &one) {
        return Law::tangent(one, i, j);
      });
    }

    Pack
    secant_shear(const Response<Pack> &response, const int i, const int j) const
    {
      return in_lanes(response, [&](const typename Response<Pack>::One &one) {
        return Law::secant_shear(one, i, j);
      });
    }

    Pack
    work_slope(const Response<Pack> &response, const int i) const
    {
      return in_lanes(response, [&](const typename Response<Pack>::One &one) {
        return Law::work_slope(one, i);
      });
    }

    Pack
    plastic_increment(const Response<Pack> &response, const int i) const
    {
      return in_lanes(response, [&](const typename Response<Pack>::One &one) {
        return Law::plastic_increment(one, i);
      });
    }

    Pack
    dissipation(const Response<Pack> &response) const
    {
      return in_lanes(response, [&](const typename Response<Pack>::One &one) {
        return Law::dissipation(one);
      });
    }

    Pack
    energy(const Pack (&strain)[3], const HistoryOf<Law, Pack> &history = {}) const
    {
      Pack result;
      for (unsigned int l = 0; l < pack_width; ++l)
        {
          const double at[3] = {strain[0][l], strain[1][l], strain[2][l]};
          result.set(l, Law::energy(at, history_of(history, l)));
        }
      return result;
    }

    Pack
    hardening_energy(const HistoryOf<Law, Pack> &history) const
    {
      Pack result;
      for (unsigned int l = 0; l < pack_width; ++l)
        result.set(l, Law::hardening_energy(history_of(history, l)));
      return result;
    }

    HistoryOf<Law, Pack>
    updated(const Response<Pack> &response, const HistoryOf<Law, Pack> &history) const
    {
      Pack columns[n_columns<Law> + 1];
      for (unsigned int l = 0; l < pack_width; ++l)
        if (response.valid[l])
          {
            double values[n_columns<Law> + 1];
            write_history<Law>(Law::updated(response.of(l), history_of(history, l)), values);
            for (unsigned int c = 0; c < n_columns<Law>; ++c)
              columns[c].set(l, values[c]);
          }
        else
          for (unsigned int c = 0; c < n_columns<Law>; ++c)
            columns[c].set(l, 0.);
      HistoryOf<Law, Pack> result{};
      static_assert(sizeof(result) <= sizeof(columns));
      std::memcpy(static_cast<void *>(&result), columns, n_columns<Law> * sizeof(Pack));
      return result;
    }

  private:
    /** One number of the answers; lanes without an answer have 0. */
    template <typename Function>
    static Pack
    in_lanes(const Response<Pack> &response, const Function &function)
    {
      Pack result;
      for (unsigned int l = 0; l < pack_width; ++l)
        result.set(l, response.valid[l] ? double(function(response.of(l))) : 0.);
      return result;
    }

    static HistoryOf<Law>
    history_of(const HistoryOf<Law, Pack> &history, const unsigned int l)
    {
      Pack   columns[n_columns<Law> + 1];
      double values[n_columns<Law> + 1];
      write_history<Law>(history, columns);
      for (unsigned int c = 0; c < n_columns<Law>; ++c)
        values[c] = columns[c][l];
      return read_history<Law>(values);
    }
  };

  /** A law as kernels of packs call it. */
  template <class Law>
  using InPacks = std::conditional_t<Law::takes_packs, const Law &, LaneByLane<Law>>;
} // namespace kedge

#endif
