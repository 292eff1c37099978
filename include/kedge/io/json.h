#ifndef kedge_io_json_h
#define kedge_io_json_h

#include <cstdint>
#include <string>

namespace kedge
{
  /**
   * Writes one JSON document, indented. Numbers keep all their digits; those
   * that JSON has no word for (NaN, infinity) become null.
   */
  class JsonWriter
  {
  public:
    /** An object or a list; @p key is empty at the top and inside lists. */
    void
    open(const std::string &key, const char bracket);
    void
    close();

    void
    add(const std::string &key, const std::string &value);
    void
    add(const std::string &key, const char *value);
    void
    add(const std::string &key, const double value);
    void
    add(const std::string &key, const std::uint64_t value);
    void
    add(const std::string &key, const bool value);

    /** The document; all brackets must be closed. */
    const std::string &
    text() const;

    /** @p text in quotes, escaped. */
    static std::string
    quoted(const std::string &text);

  private:
    void
    begin(const std::string &key);

    std::string document;
    std::string closing;
    bool        first = true;
  };
} // namespace kedge

#endif
