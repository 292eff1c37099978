#ifndef kedge_base_shortened_h
#define kedge_base_shortened_h

#include <string>

namespace kedge
{
  /** The text, or of a longer one its beginning and how long it is. */
  inline std::string
  shortened(const std::string &text, const std::size_t longest = 160)
  {
    if (text.size() <= longest)
      return text;
    std::size_t end = longest; // not within a character of several bytes
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
      --end;
    return text.substr(0, end) + " .. (" + std::to_string(text.size()) + " characters)";
  }
} // namespace kedge

#endif
