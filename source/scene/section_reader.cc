#include <kedge/base/expression.h>
#include <kedge/base/shortened.h>
#include <kedge/scene/parameter_reader.h>
#include <kedge/scene/values.h>

namespace kedge
{
  SectionReader::SectionReader(const ParameterReader &reader, const std::vector<std::string> &path)
    : reader(reader)
    , path(path)
  {}



  const std::string &
  SectionReader::name() const
  {
    return path.back();
  }



  std::string
  SectionReader::text(const std::string &entry) const
  {
    return reader.text(path, entry);
  }



  bool
  SectionReader::is_empty(const std::string &entry) const
  {
    return text(entry).empty();
  }



  double
  SectionReader::number(const std::string &entry) const
  {
    return evaluate_constant(text(entry), constants());
  }



  unsigned int
  SectionReader::whole_number(const std::string &entry) const
  {
    return parse_whole_number(text(entry), constants());
  }



  bool
  SectionReader::truth(const std::string &entry) const
  {
    return parse_truth(text(entry));
  }



  std::vector<std::string>
  SectionReader::list(const std::string &entry) const
  {
    return split_list(text(entry));
  }



  std::vector<double>
  SectionReader::numbers(const std::string &entry) const
  {
    std::vector<double> values;
    for (const std::string &part : list(entry))
      values.push_back(evaluate_constant(part, constants()));
    return values;
  }



  const std::map<std::string, double> &
  SectionReader::constants() const
  {
    return reader.constants();
  }



  UserError
  SectionReader::error(const std::string &entry, const std::string &problem) const
  {
    const std::string value = text(entry);
    return UserError(reader.place(path, entry) + ": " + shortened(reader.full_name(path, entry)) +
                     (value.empty() ? "" : " = " + shortened(value)) + ": " + problem);
  }
} // namespace kedge
