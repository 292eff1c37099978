#include <kedge/io/files.h>
#include <kedge/io/json.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <cstdio>

namespace kedge
{
  std::string
  JsonWriter::quoted(const std::string &text)
  {
    std::string result = "\"";
    for (const char c : text)
      if (c == '"' || c == '\\')
        result += std::string("\\") + c;
      else if (c == '\n')
        result += "\\n";
      else if (static_cast<unsigned char>(c) < 0x20)
        {
          char code[8];
          std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned int>(c));
          result += code;
        }
      else
        result += c;
    return result + '"';
  }



  void
  JsonWriter::begin(const std::string &key)
  {
    document += first ? "" : ",";
    if (!document.empty())
      document += '\n' + std::string(2 * closing.size(), ' ');
    if (!key.empty())
      document += quoted(key) + ": ";
    first = false;
  }



  void
  JsonWriter::open(const std::string &key, const char bracket)
  {
    begin(key);
    document += bracket;
    closing += (bracket == '{' ? '}' : ']');
    first = true;
  }



  void
  JsonWriter::close()
  {
    const char bracket = closing.back();
    closing.pop_back();
    if (!first)
      document += '\n' + std::string(2 * closing.size(), ' ');
    document += bracket;
    first = false;
  }



  void
  JsonWriter::add(const std::string &key, const std::string &value)
  {
    begin(key);
    document += quoted(value);
  }



  void
  JsonWriter::add(const std::string &key, const char *value)
  {
    add(key, std::string(value));
  }



  void
  JsonWriter::add(const std::string &key, const double value)
  {
    begin(key);
    document += std::isfinite(value) ? exact_text(value) : "null";
  }



  void
  JsonWriter::add(const std::string &key, const std::uint64_t value)
  {
    begin(key);
    document += std::to_string(value);
  }



  void
  JsonWriter::add(const std::string &key, const bool value)
  {
    begin(key);
    document += value ? "true" : "false";
  }



  const std::string &
  JsonWriter::text() const
  {
    Assert(closing.empty(), dealii::ExcInternalError());
    return document;
  }
} // namespace kedge
