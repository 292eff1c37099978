#include <kedge/simulation/rejections.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** So many are shown in full. */
    constexpr unsigned int most_shown = 20;
  } // namespace



  Rejections::Rejections(const RunFolder &folder)
    : folder(folder)
  {}



  void
  Rejections::print(const double       size,
                    const double       time,
                    const std::string &cause,
                    const std::string &next)
  {
    folder.log() << "  step of " << size << " s at t = " << time << " s rejected: " << cause << next
                 << std::endl;
  }



  void
  Rejections::cut(const double size, const double time, const std::string &why)
  {
    cause = why;
    if (n_shown < most_shown)
      {
        ++n_shown;
        print(size, time, cause, "; trying half of it");
        if (n_shown == most_shown)
          folder.log() << "  further ones are summed up" << std::endl;
        return;
      }
    smallest = n_hidden == 0 ? size : std::min(smallest, size);
    last     = time;
    ++n_hidden;
  }



  void
  Rejections::stop(const double       size,
                   const double       time,
                   const std::string &why,
                   const std::string &next)
  {
    sum_up();
    cause = why;
    print(size, time, cause, next);
  }



  void
  Rejections::sum_up()
  {
    if (n_hidden > 0)
      folder.log() << "  " << n_hidden << " more steps rejected, up to t = " << last
                   << " s, the smallest of " << smallest << " s; the last: " << cause << std::endl;
    n_hidden = 0;
  }



  const std::string &
  Rejections::last_cause() const
  {
    return cause;
  }
} // namespace kedge
