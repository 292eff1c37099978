#ifndef kedge_base_user_errors_h
#define kedge_base_user_errors_h

#include <kedge/base/exceptions.h>

#include <functional>
#include <string>
#include <vector>

namespace kedge
{
  /** Several errors of the user's at once; the message has a line for each of the first ten. */
  class SeveralUserErrors : public UserError
  {
  public:
    explicit SeveralUserErrors(const std::vector<std::string> &messages);

    const std::vector<std::string> messages;
  };

  /**
   * Collects errors that do not depend on each other, so that the user sees all of them
   * in one go. Use:
   * @code
   *   UserErrors errors;
   *   errors.attempt([&] { grid = read_grid(reader); });
   *   errors.attempt([&] { time = read_time(reader); });
   *   errors.throw_if_any();
   * @endcode
   */
  class UserErrors
  {
  public:
    /** Runs @p action; a UserError that it throws is kept. Returns whether there was none. */
    bool
    attempt(const std::function<void()> &action);

    /** Whether there was no error so far. */
    bool
    empty() const;

    /** @throws UserError if there was one, SeveralUserErrors if there were more. */
    void
    throw_if_any() const;

  private:
    std::vector<std::string> messages;
  };
} // namespace kedge

#endif
