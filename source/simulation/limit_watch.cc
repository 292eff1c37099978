#include <kedge/simulation/limit_watch.h>

#include <sstream>

namespace kedge
{
  namespace
  {
    /** So many times as fast as at first: it is the load and not the solver that has its limit. */
    constexpr double run_away = 5.;
  } // namespace



  LimitWatch::LimitWatch(const double failure_displacement)
    : failure_displacement(failure_displacement)
  {}



  void
  LimitWatch::add(const double time_step, const double largest_displacement)
  {
    last_rate    = (largest_displacement - displacement) / time_step;
    displacement = largest_displacement;
    if (first_rate == 0.)
      first_rate = last_rate;
  }



  bool
  LimitWatch::has_failed() const
  {
    return failure_displacement > 0. && displacement >= failure_displacement;
  }



  bool
  LimitWatch::runs_away() const
  {
    return first_rate > 0. && last_rate > run_away * first_rate;
  }



  std::string
  LimitWatch::growth() const
  {
    if (!(first_rate > 0.))
      return "";
    std::ostringstream text;
    text.precision(3);
    text << "the largest displacement, " << displacement << " m, was ";
    if (last_rate > 0.)
      text << "still growing at " << last_rate << " m/s, " << last_rate / first_rate
           << " times as fast as in the first step";
    else
      text << "not growing";
    return text.str();
  }



  std::map<std::string, double>
  LimitWatch::save() const
  {
    return {{"displacement", displacement}, {"first rate", first_rate}, {"last rate", last_rate}};
  }



  void
  LimitWatch::restore(const std::map<std::string, double> &values)
  {
    displacement = values.at("displacement");
    first_rate   = values.at("first rate");
    last_rate    = values.at("last rate");
  }
} // namespace kedge
