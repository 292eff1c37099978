#include <kedge/base/nearest_name.h>

#include <algorithm>
#include <cctype>
#include <limits>

namespace kedge
{
  namespace
  {
    std::string
    lower_case(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char letter) {
        return static_cast<char>(std::tolower(letter));
      });
      return text;
    }

    /** In lower case, with spaces for all kinds of blanks. */
    std::string
    plain(const std::string &text)
    {
      std::string result = lower_case(text);
      std::replace_if(
        result.begin(),
        result.end(),
        [](const char letter) {
          return letter == '_' || letter == '-';
        },
        ' ');
      return result;
    }

    /** Whether @p part stands in @p text as a whole word or several. */
    bool
    holds_words(const std::string &text, const std::string &part)
    {
      return part.size() > 2 && (' ' + text + ' ').find(' ' + part + ' ') != std::string::npos;
    }

    /** Damerau's and Levenshtein's distance, each pair of neighbours swapped at most once. */
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::vector<std::size_t>> distance(a.size() + 1,
                                                     std::vector<std::size_t>(b.size() + 1));
      for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j)
          {
            if (i == 0 || j == 0)
              {
                distance[i][j] = i + j;
                continue;
              }
            distance[i][j] = std::min({distance[i - 1][j] + 1,
                                       distance[i][j - 1] + 1,
                                       distance[i - 1][j - 1] + (a[i - 1] != b[j - 1] ? 1 : 0)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
          }
      return distance[a.size()][b.size()];
    }
  } // namespace



  std::string
  nearest_name(const std::string &name, const std::vector<std::string> &candidates)
  {
    std::string nearest;
    std::size_t smallest = std::numeric_limits<std::size_t>::max();
    for (const std::string &candidate : candidates)
      {
        const std::size_t distance = edit_distance(lower_case(name), lower_case(candidate));
        if (distance < smallest)
          {
            smallest = distance;
            nearest  = candidate;
          }
      }
    return nearest;
  }



  std::string
  did_you_mean(const std::string &name, const std::vector<std::string> &candidates)
  {
    constexpr std::size_t longest = 200; // nobody mistypes more
    std::string           best;
    std::size_t           smallest = std::numeric_limits<std::size_t>::max();
    if (name.size() > longest)
      return "";
    for (const std::string &candidate : candidates)
      {
        const std::string a = plain(name), b = plain(candidate);
        const std::size_t length   = std::max(a.size(), b.size());
        std::size_t       distance = edit_distance(a, b);
        if (holds_words(a, b) || holds_words(b, a))
          distance = std::min<std::size_t>(distance, 2);
        const bool alike = distance <= std::max<std::size_t>(2, length / 3) && distance < length;
        if (alike && distance < smallest)
          {
            smallest = distance;
            best     = candidate;
          }
      }
    return best.empty() ? "" : " Did you mean '" + best + "'?";
  }
} // namespace kedge
