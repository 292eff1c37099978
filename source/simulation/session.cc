#include <kedge/base/nearest_name.h>
#include <kedge/io/point_fields.h>
#include <kedge/materials/material.h>
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
    /** A member of PointState that can be looked at where it lies. */
    struct Member
    {
      std::string              name;
      std::size_t              offset; ///< in bytes
      std::vector<std::size_t> shape;
    };

    template <int dim>
    std::vector<Member>
    members()
    {
      using C                             = PointCore<dim>;
      using E                             = PointExtras<dim>;
      constexpr std::size_t          past = sizeof(C); // where the extras begin
      const std::vector<std::size_t> number, vector = {dim}, tensor = {dim, dim},
                                             symmetric = {dim * (dim + 1) / 2};

      std::vector<Member> result = {
        {"body", offsetof(C, body), number},
        {"mass", offsetof(C, mass), number},
        {"reference_volume", offsetof(C, reference_volume), number},
        {"reference_position", offsetof(C, reference_position), vector},
        {"displacement", offsetof(C, displacement), vector},
        {"velocity", offsetof(C, velocity), vector},
        {"half_lengths", offsetof(C, half_lengths), vector},
        {"deformation_gradient", offsetof(C, deformation_gradient), tensor},
        {"kirchhoff_stress", offsetof(C, kirchhoff_stress), symmetric},
        {"out_of_plane_kirchhoff_stress", offsetof(C, out_of_plane_kirchhoff_stress), number},
        {"strain_energy", offsetof(C, strain_energy), number},
        {"acceleration", past + offsetof(E, acceleration), vector},
        {"hardening_energy", past + offsetof(E, hardening_energy), number},
        {"plastic_dissipation", past + offsetof(E, plastic_dissipation), number},
        {"pore_pressure", past + offsetof(E, pore_pressure), number},
        {"porosity", past + offsetof(E, porosity), number},
        {"darcy_velocity", past + offsetof(E, darcy_velocity), vector}};
      const auto &columns = memory_columns();
      for (std::size_t c = 0; c < columns.size(); ++c)
        result.push_back(
          {columns[c].name, past + offsetof(E, memory) + c * sizeof(double), number});
      return result;
    }

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
    PointMemory<dim>
    memory_of(const MaterialPoints<dim> &points)
    {
      auto memory = points.memory();
      if (!memory)
        throw UserError("What this process's points remember cannot be looked at in place, for "
                        "points have gone to other processes; take a copy of the field.");
      return std::move(*memory);
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
      ids(const bool as_stored) const override
      {
        const MaterialPoints<dim> &points = the_run.current().points.points();
        if (as_stored)
          return memory_of(points).ids;
        std::vector<std::uint64_t> result;
        for (const auto &record : in_order_of_ids(points))
          result.push_back(record.id);
        return result;
      }

      std::vector<std::string>
      stored_names() const override
      {
        const PointMemory<dim>   memory = memory_of(the_run.current().points.points());
        std::vector<std::string> names  = {"position"};
        for (const Member &member : members<dim>())
          if (memory.layout.place_of(member.offset))
            names.push_back(member.name);
        return names;
      }

      StoredValues
      stored(const std::string &name) const override
      {
        const PointMemory<dim> memory = memory_of(the_run.current().points.points());
        const std::size_t      n      = memory.ids.size();
        if (name == "position")
          return {n > 0 ? &(*memory.locations)[0] : nullptr, n, dim, {dim}};
        for (const Member &member : members<dim>())
          if (const auto place = memory.layout.place_of(member.offset);
              place && member.name == name)
            return {n > 0 ? memory.states + *place : nullptr,
                    n,
                    memory.layout.n_values(),
                    member.shape};
        const auto  names = stored_names();
        std::string list;
        for (const std::string &valid : names)
          list += (list.empty() ? "" : ", ") + valid;
        throw UserError("The points of this scene do not remember '" + name + "'." +
                        did_you_mean(name, names) + " They remember: " + list + ".");
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
