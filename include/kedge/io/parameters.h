#ifndef kedge_io_parameters_h
#define kedge_io_parameters_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace kedge
{
  /** A material point, or the mean over an exposed face of a body, to be followed. */
  template <int dim>
  struct ProbeParameters
  {
    std::string        name;
    std::string        body;              ///< empty: any
    bool               face_mean = false; ///< mean over the points of an exposed face
    dealii::Point<dim> place;             ///< initial place; the nearest point is tracked
    unsigned int       side = 0;          ///< of face_mean: 2*direction + (0: low, 1: high)
  };

  struct OutputParameters
  {
    double       points_interval    = 0;     ///< simulated time between outputs [s]; 0: off
    bool         hit_output_times   = false; ///< whether steps are shortened to end at output times
    unsigned int points_every_steps = 0;     ///< 0: off
    std::vector<std::string> fields;         ///< names of point fields
    bool                     vtu                    = true;
    bool                     hdf5                   = false;
    bool                     grid                   = false;
    unsigned int             checkpoint_every_steps = 0;   ///< 0: off
    double                   checkpoint_interval    = 600; ///< wall seconds; 0: off
    double                   progress_interval      = 1;   ///< wall seconds between lines
  };

  /** What a check makes of the values of a column. */
  enum class CheckStatistic
  {
    at,            ///< value at `time`, linear between rows
    last,          ///< value of the last row
    minimum,       ///< over rows with time >= `time`
    maximum,       ///< over rows with time >= `time`
    max_abs,       ///< over rows with time >= `time`
    drift,         ///< max |v - v(first row with time >= `time`)|, over the same rows
    period,        ///< twice the mean spacing of the zero crossings after `time`
    point_error,   ///< sum_p |v_p - exact(X_p)| V0_p / sum V0_p of a point field, at the end
    point_quantile ///< what `part` of V0 has no more of a point field than, at the end
  };

  /** Whether it is one of the points' fields, not of columns. */
  inline bool
  is_of_points(const CheckStatistic statistic)
  {
    return statistic == CheckStatistic::point_error || statistic == CheckStatistic::point_quantile;
  }

  /** A known answer of a scene. Passes if |value/scale - reference| <= tolerance (absolute) or <=
   * tolerance*|reference| (relative). */
  struct CheckParameters
  {
    std::string    name;
    CheckStatistic statistic = CheckStatistic::last;
    std::string    column; ///< history.COLUMN, probe.NAME.COLUMN, or a point field's name
    double         time = 0;
    std::string    exact;         ///< expression of X, Y, Z (initial place), for point_error
    double         part      = 0; ///< of the volume, in (0, 1), for point_quantile [-]
    double         scale     = 1; ///< the value is divided by it
    double         reference = 0;
    double         tolerance = 0;
    bool           relative  = true;
    std::string    source; ///< where the reference comes from
  };
} // namespace kedge

#endif
