// kedge for Python: the module kedge._core. What it offers to users is written in Python, in
// the package kedge beside this file; here stands what needs the library.

#include <kedge/base/process.h>
#include <kedge/io/versions.h>
#include <kedge/scene/print_parameters.h>
#include <kedge/simulation/session.h>

#include <pybind11/iostream.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <sstream>

namespace py = pybind11;

namespace kedge
{
  namespace
  {
    /** Drops what it gets. */
    class NoBuffer : public std::streambuf
    {
      int_type
      overflow(const int_type letter) override
      {
        return traits_type::not_eof(letter);
      }

      std::streamsize
      xsputn(const char *, const std::streamsize n) override
      {
        return n;
      }
    };

    /** While it lives, the log goes to sys.stdout or nowhere. */
    class LogTo
    {
    public:
      explicit LogTo(const bool shown)
        : previous(std::cout.rdbuf())
      {
        if (shown)
          to_python = std::make_unique<py::scoped_ostream_redirect>();
        else
          std::cout.rdbuf(&nowhere);
      }

      ~LogTo()
      {
        to_python.reset();
        std::cout.rdbuf(previous);
      }

    private:
      NoBuffer                                     nowhere;
      std::streambuf                              *previous;
      std::unique_ptr<py::scoped_ostream_redirect> to_python;
    };



    /** Section, name and value of an entry. */
    using Entry = std::tuple<std::vector<std::string>, std::string, std::string>;



    /**
     * What a run and the arrays that look at its memory hold together: it lasts as long as
     * one of them, but for the end of Python, before which MPI must end, too.
     */
    using SharedSession = std::shared_ptr<std::unique_ptr<Session>>;

    std::vector<std::weak_ptr<std::unique_ptr<Session>>> &
    all_sessions()
    {
      static std::vector<std::weak_ptr<std::unique_ptr<Session>>> sessions;
      return sessions;
    }

    /** Ends all runs, and MPI. */
    void
    end()
    {
      for (const auto &weak : all_sessions())
        if (const SharedSession session = weak.lock())
          session->reset();
      stop_mpi();
    }



    /** A session, and whether anybody looks at its memory. */
    class PythonRun
    {
    public:
      PythonRun(const ParameterFile &file,
                const std::string   &output,
                const bool           resume,
                const bool           log)
        : log(log)
        , looked_at(std::make_shared<int>(0))
      {
        start_mpi();
        const LogTo log_to(log);
        RunOptions  options;
        options.output = output;
        options.resume = resume;
        session =
          std::make_shared<std::unique_ptr<Session>>(Session::open(file, options, MPI_COMM_WORLD));
        all_sessions().push_back(session);
      }

      /** One step. The code of the end and its reason; nothing if the run goes on. */
      std::optional<std::pair<int, std::string>>
      advance()
      {
        Session    &open = changing();
        const LogTo log_to(log);
        const auto  end = open.step();
        if (!end)
          return {};
        return std::make_pair(static_cast<int>(end->code), end->reason);
      }

      void
      write_checkpoint()
      {
        const LogTo log_to(log);
        get().write_checkpoint();
      }

      py::array_t<double>
      field(const std::string &name) const
      {
        const FieldValues        values = get().field(name);
        std::vector<std::size_t> shape  = {count(values)};
        shape.insert(shape.end(), values.shape.begin(), values.shape.end());
        return py::array_t<double>(shape, values.values.data());
      }

      /** What the points remember, in place; the array keeps the session and counts as a look. */
      py::array
      view(const std::string &name) const
      {
        const StoredValues       stored  = get().stored(name);
        std::vector<std::size_t> shape   = {stored.n_points};
        std::vector<std::size_t> strides = {stored.stride * sizeof(double)};
        for (std::size_t d = 0; d < stored.shape.size(); ++d)
          {
            std::size_t size = sizeof(double);
            for (std::size_t inner = d + 1; inner < stored.shape.size(); ++inner)
              size *= stored.shape[inner];
            shape.push_back(stored.shape[d]);
            strides.push_back(size);
          }
        using Look = std::pair<SharedSession, std::shared_ptr<int>>;
        const py::capsule look(new Look(session, looked_at), [](void *pointer) {
          delete static_cast<Look *>(pointer);
        });
        py::array         result(py::dtype::of<double>(), shape, strides, stored.first, look);
        result.attr("flags").attr("writeable") = false;
        return result;
      }

      Session &
      get() const
      {
        if (!session || !*session)
          throw UserError("The run is closed.");
        return **session;
      }

      /** Lets go of the session. */
      void
      close()
      {
        session.reset();
      }

    private:
      static std::size_t
      count(const FieldValues &values)
      {
        std::size_t per_point = 1;
        for (const std::size_t n : values.shape)
          per_point *= n;
        return values.values.size() / per_point;
      }

      /** The session, which a step will change. */
      Session &
      changing() const
      {
        if (looked_at.use_count() > 1)
          throw py::buffer_error("A view of the points is still in use, and a step would change "
                                 "what it shows: delete it, or copy it with numpy.array().");
        return get();
      }

      const bool           log;
      SharedSession        session;
      std::shared_ptr<int> looked_at; ///< held by each view
    };



    /** A parameter file of entries that never stood in a file. */
    ParameterFile
    scene_of_entries(const std::string                           &name,
                     const std::vector<Entry>                    &entries,
                     const std::vector<std::vector<std::string>> &sections)
    {
      ParameterFile file;
      file.file_name = name;
      for (const auto &path : sections)
        file.sections.push_back({path, {name, 0}});
      for (const auto &[section, entry, value] : entries)
        file.set(section, entry, value, {name, 0});
      return file;
    }

    std::vector<Entry>
    entries_of(const ParameterFile &file)
    {
      std::vector<Entry> result;
      for (const ParameterEntry &entry : file.entries)
        result.emplace_back(entry.section, entry.name, entry.value);
      return result;
    }

    /** The text of a parameter file. */
    std::string
    text_of(const ParameterFile &file)
    {
      std::ostringstream out;
      file.print(out);
      return out.str();
    }

    void
    bind_scene(py::module_ &module)
    {
      py::class_<ParameterFile>(module, "Scene")
        .def_static("of_text",
                    [](const std::string &text, const std::string &name) {
                      std::istringstream input(text);
                      return ParameterFile::read(input, name);
                    })
        .def_static("of_entries", &scene_of_entries)
        .def("copy",
             [](const ParameterFile &file) {
               return file;
             })
        .def("set",
             [](ParameterFile                  &file,
                const std::vector<std::string> &section,
                const std::string              &name,
                const std::string              &value) {
               file.set(section, name, value, {file.file_name, 0});
             })
        .def("entries", &entries_of)
        .def("text", &text_of)
        .def("is_path", &is_path)
        .def_property_readonly("name", &ParameterFile::scene_name);
    }

    void
    bind_run(py::module_ &module)
    {
      py::class_<PythonRun>(module, "Run")
        .def(py::init<const ParameterFile &, const std::string &, bool, bool>())
        .def("advance", &PythonRun::advance)
        .def("write_checkpoint", &PythonRun::write_checkpoint)
        .def("close", &PythonRun::close)
        .def("field", &PythonRun::field)
        .def("view", &PythonRun::view)
        .def("dimension",
             [](const PythonRun &run) {
               return run.get().dimension();
             })
        .def("columns",
             [](const PythonRun &run) {
               return run.get().columns();
             })
        .def("row",
             [](const PythonRun &run) {
               return run.get().row();
             })
        .def("field_names",
             [](const PythonRun &run) {
               return run.get().field_names();
             })
        .def("stored_names",
             [](const PythonRun &run) {
               return run.get().stored_names();
             })
        .def("ids", [](const PythonRun &run, const bool as_stored) {
          const auto ids = run.get().ids(as_stored);
          return py::array_t<std::uint64_t>(ids.size(), ids.data());
        });
    }

    void
    bind_functions(py::module_ &module)
    {
      module.def("validate", [](const ParameterFile &file) {
        start_mpi();
        std::ostringstream out;
        validate(file, out, MPI_COMM_WORLD);
        return out.str();
      });
      module.def("drive", [](const ParameterFile &file, const std::string &output, const bool log) {
        start_mpi();
        const LogTo log_to(log);
        return static_cast<int>(drive(file, output, false, MPI_COMM_WORLD));
      });
      module.def("parameters", []() {
        std::ostringstream out;
        print_parameters(out, "json");
        return out.str();
      });
      module.def("versions", &software_versions);
      module.def("rank", []() {
        start_mpi();
        int rank;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        return rank;
      });
      module.def("n_ranks", []() {
        start_mpi();
        int n_ranks;
        MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
        return n_ranks;
      });
      module.def("set_threads", &set_blas_threads);
      module.def("end", &end);
    }
  } // namespace
} // namespace kedge



PYBIND11_MODULE(_core, module)
{
  py::register_exception<kedge::UserError>(module, "UserError", PyExc_ValueError);
  kedge::bind_scene(module);
  kedge::bind_run(module);
  kedge::bind_functions(module);
}
