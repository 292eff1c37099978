#include <kedge/io/point_fields.h>
#include <kedge/scene/idle_settings.h>
#include <kedge/scene/read_scene.h>
#include <kedge/simulation/drive_point.h>
#include <kedge/simulation/run.h>
#include <kedge/simulation/session.h>
#include <kedge/simulation/size_check.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    /** The points of this rank by their ids. */
    template <int dim>
    std::vector<PointRecord<dim>>
    in_order_of_ids(const MaterialPoints<dim> &points)
    {
      auto result = points.records();
      std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
        return a.id < b.id;
      });
      return result;
    }

    template <int dim>
    class SceneSession : public Session
    {
    public:
      SceneSession(const ParameterFile &file, RunOptions options, const MPI_Comm communicator)
        : scene(read_checked(file, options))
        , the_run(scene, options, communicator)
      {}

      RunEnd
      run() override
      {
        return the_run.run();
      }

      std::optional<RunEnd>
      step() override
      {
        const StopSignals signals(the_run.current().communicator);
        return the_run.advance([&]() {
          return signals.stop_requested();
        });
      }

      void
      write_checkpoint() override
      {
        the_run.write_checkpoint();
      }

      unsigned int
      dimension() const override
      {
        return dim;
      }

      double
      time() const override
      {
        return the_run.last_row().time;
      }

      std::vector<std::string>
      columns() const override
      {
        return history_columns(the_run.current().ledger.columns());
      }

      std::vector<double>
      row() const override
      {
        const HistoryRow   &row    = the_run.last_row();
        std::vector<double> result = {static_cast<double>(row.step),
                                      row.time,
                                      row.time_step,
                                      static_cast<double>(row.newton_iterations),
                                      static_cast<double>(row.linear_iterations),
                                      static_cast<double>(row.rejected_attempts)};
        result.insert(result.end(), row.books.begin(), row.books.end());
        result.push_back(row.wall_time);
        return result;
      }

      std::vector<std::string>
      field_names() const override
      {
        std::vector<std::string> names;
        for (const auto &field : point_fields<dim>())
          names.push_back(field.name);
        return names;
      }

      FieldValues
      field(const std::string &name) const override
      {
        const PointField<dim> &field = point_field<dim>(name);
        const std::size_t      n     = n_values(field.shape);
        FieldValues            result;
        if (field.shape == FieldShape::tensor)
          result.shape = {3, 3};
        else if (n > 1)
          result.shape = {n};
        const auto records = in_order_of_ids(the_run.current().points.points());
        result.values.resize(n * records.size());
        for (std::size_t p = 0; p < records.size(); ++p)
          field.evaluate(records[p], &result.values[n * p]);
        return result;
      }

      std::vector<std::uint64_t>
      ids() const override
      {
        std::vector<std::uint64_t> result;
        for (const auto &record : in_order_of_ids(the_run.current().points.points()))
          result.push_back(record.id);
        return result;
      }

    private:
      static Scene<dim>
      read_checked(const ParameterFile &file, RunOptions &options)
      {
        Scene<dim> scene = read_scene<dim>(file);
        check_size(scene);
        options.notes = idle_settings(file, scene);
        return scene;
      }

      const Scene<dim> scene;
      Run<dim>         the_run;
    };



    template <int dim>
    void
    validate_in(const ParameterFile &file, std::ostream &out, const MPI_Comm communicator)
    {
      const Scene<dim> scene = read_scene<dim>(file);
      check_size(scene);
      validate_scene(scene, out, communicator);
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        for (const std::string &note : idle_settings(file, scene))
          out << "note:             " << note << "\n";
    }
  } // namespace



  std::unique_ptr<Session>
  Session::open(const ParameterFile &file, const RunOptions &options, const MPI_Comm communicator)
  {
    if (scene_dimension(file) == 2)
      return std::make_unique<SceneSession<2>>(file, options, communicator);
    return std::make_unique<SceneSession<3>>(file, options, communicator);
  }



  void
  validate(const ParameterFile &file, std::ostream &out, const MPI_Comm communicator)
  {
    if (is_path(file))
      {
        const PathScene scene = read_path_scene(file);
        check_size(scene);
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          out << "path:             " << scene.path.n_steps << " steps of one material point of '"
              << scene.material.name << "' to t = " << scene.path.end << " s" << std::endl;
        return;
      }
    if (scene_dimension(file) == 2)
      validate_in<2>(file, out, communicator);
    else
      validate_in<3>(file, out, communicator);
  }



  bool
  is_path(const ParameterFile &file)
  {
    return is_path_file(file);
  }



  ExitCode
  drive(const ParameterFile         &file,
        const std::filesystem::path &output,
        const bool                   strict,
        const MPI_Comm               communicator)
  {
    const PathScene scene = read_path_scene(file);
    check_size(scene);
    return drive_point(scene, output, strict, communicator);
  }
} // namespace kedge
