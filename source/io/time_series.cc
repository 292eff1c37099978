#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/time_series.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** What stands around the time and the text of an entry. */
    struct Frame
    {
      std::string head, before_time, before_text, after_text, foot;
    };

    const Frame &
    frame(const TimeSeries::Format format)
    {
      static const Frame pvd  = {"<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                                  "version=\"0.1\">\n<Collection>\n",
                                 "<DataSet timestep=\"",
                                 "\" part=\"0\" file=\"",
                                 "\"/>\n",
                                 "</Collection>\n</VTKFile>\n"};
      static const Frame xdmf = {"<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
                                 "<Grid Name=\"series\" GridType=\"Collection\" "
                                 "CollectionType=\"Temporal\">\n",
                                 "<Grid Name=\"points\" GridType=\"Uniform\">\n<Time Value=\"",
                                 "\"/>\n",
                                 "</Grid>\n",
                                 "</Grid>\n</Domain>\n</Xdmf>\n"};
      return format == TimeSeries::Format::pvd ? pvd : xdmf;
    }
  } // namespace



  TimeSeries::TimeSeries(const RunFolder   &folder,
                         const std::string &name,
                         const Format       format,
                         const unsigned int n_kept)
    : folder(folder)
    , name(name)
    , format(format)
  {
    if (n_kept > 0)
      run_on_root(folder.communicator(), [&]() {
        if (!std::filesystem::exists(folder.path(name)))
          return; // somebody has removed it: begin a new one
        read(n_kept);
        replace_file(folder.path(name), document());
      });
  }



  void
  TimeSeries::read(const unsigned int n_kept)
  {
    const std::string document = read_file(folder.path(name));
    const Frame      &parts    = frame(format);
    std::size_t       position = document.find(parts.before_time);
    while (position != std::string::npos && entries.size() < n_kept)
      {
        const std::size_t time   = position + parts.before_time.size();
        const std::size_t middle = document.find(parts.before_text, time);
        const std::size_t text   = middle + parts.before_text.size();
        const std::size_t end    = document.find(parts.after_text, text);
        if (middle == std::string::npos || end == std::string::npos)
          return;
        entries.push_back(
          {document.substr(time, middle - time), document.substr(text, end - text)});
        position = document.find(parts.before_time, end);
      }
  }



  void
  TimeSeries::add(const double time, const std::string &entry)
  {
    run_on_root(folder.communicator(), [&]() {
      entries.push_back({exact_text(time), entry});
      replace_file(folder.path(name), document(), OnDisk::later);
    });
  }



  void
  TimeSeries::flush() const
  {
    run_on_root(folder.communicator(), [&]() {
      if (std::filesystem::exists(folder.path(name)))
        flush_to_disk(folder.path(name));
    });
  }



  std::string
  TimeSeries::document() const
  {
    const Frame &parts = frame(format);
    std::string  text  = parts.head;
    for (const Entry &entry : entries)
      text += parts.before_time + entry.time + parts.before_text + entry.text + parts.after_text;
    return text + parts.foot;
  }
} // namespace kedge
