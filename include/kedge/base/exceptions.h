#ifndef kedge_base_exceptions_h
#define kedge_base_exceptions_h

#include <stdexcept>
#include <string>

namespace kedge
{
  /**
   * Something in the user's input cannot be used: a scene file, an option, a
   * file name. The message names the cause, the place and the remedy; the
   * executable prints it and ends with ExitCode::user_error.
   */
  class UserError : public std::runtime_error
  {
  public:
    explicit UserError(const std::string &message)
      : std::runtime_error(message)
    {}
  };

  /** How a run of the executable ends; the numbers are a promise to scripts. */
  enum class ExitCode : int
  {
    finished       = 0,
    user_error     = 1,
    numerical_stop = 2,
    interrupted    = 3,
    internal_error = 4
  };
} // namespace kedge

#endif
