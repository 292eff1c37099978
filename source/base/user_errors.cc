#include <kedge/base/shortened.h>
#include <kedge/base/user_errors.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    constexpr std::size_t most_shown   = 10;
    constexpr std::size_t longest_line = 700;

    std::string
    joined(const std::vector<std::string> &messages)
    {
      std::string text = "There are " + std::to_string(messages.size()) + " errors.";
      for (std::size_t i = 0; i < std::min(messages.size(), most_shown); ++i)
        text += "\n" + shortened(messages[i], longest_line);
      if (messages.size() > most_shown)
        text += "\n.. and " + std::to_string(messages.size() - most_shown) + " more.";
      return text;
    }
  } // namespace



  SeveralUserErrors::SeveralUserErrors(const std::vector<std::string> &messages)
    : UserError(joined(messages))
    , messages(messages)
  {}



  bool
  UserErrors::attempt(const std::function<void()> &action)
  {
    try
      {
        action();
        return true;
      }
    catch (const SeveralUserErrors &errors)
      {
        messages.insert(messages.end(), errors.messages.begin(), errors.messages.end());
      }
    catch (const UserError &error)
      {
        messages.push_back(error.what());
      }
    return false;
  }



  bool
  UserErrors::empty() const
  {
    return messages.empty();
  }



  void
  UserErrors::throw_if_any() const
  {
    if (messages.size() > 1)
      throw SeveralUserErrors(messages);
    if (!messages.empty())
      throw UserError(messages.front());
  }
} // namespace kedge
