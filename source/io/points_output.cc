#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>
#include <kedge/io/files.h>
#include <kedge/io/points_output.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace kedge
{
  namespace
  {
    constexpr std::uint8_t vtk_vertex = 1;

    std::string
    stem(const unsigned int number)
    {
      return "points-" + dealii::Utilities::int_to_string(number, 6);
    }

    /** The values of a field, all of a point side by side. */
    template <int dim>
    std::vector<double>
    collect(const PointField<dim> &field, const std::vector<PointRecord<dim>> &points)
    {
      const unsigned int  n = n_values(field.shape);
      std::vector<double> values(n * points.size());
      for (std::size_t p = 0; p < points.size(); ++p)
        field.evaluate(points[p], &values[n * p]);
      return values;
    }

    template <int dim>
    VtuFile::Array
    describe(const PointField<dim> &field)
    {
      VtuFile::Array array;
      array.name         = field.name;
      array.n_components = n_values(field.shape);
      if (field.shape != FieldShape::scalar)
        array.component_names = value_names(field.shape);
      return array;
    }

    template <int dim>
    VtuFile
    make_piece(const std::vector<const PointField<dim> *> &fields,
               const std::vector<PointRecord<dim>>        &points)
    {
      VtuFile piece;
      piece.set_nodes(collect(point_field<dim>("position"), points));
      std::vector<std::int64_t> numbers(points.size());
      std::iota(numbers.begin(), numbers.end(), 0);
      piece.set_cells(numbers, 1, vtk_vertex);
      for (const PointField<dim> *field : fields)
        {
          const std::vector<double> values = collect(*field, points);
          if (field->integer)
            piece.add_field(describe(*field),
                            std::vector<std::int64_t>(values.begin(), values.end()));
          else
            piece.add_field(describe(*field), values);
        }
      return piece;
    }

    std::uint64_t
    sum_over_lower_ranks(const std::uint64_t n, const MPI_Comm communicator)
    {
      std::uint64_t sum = 0;
      MPI_Exscan(&n, &sum, 1, MPI_UINT64_T, MPI_SUM, communicator);
      return dealii::Utilities::MPI::this_mpi_process(communicator) == 0 ? 0 : sum;
    }

    void
    write_dataset(dealii::HDF5::File        &file,
                  const std::string         &name,
                  const unsigned int         n_components,
                  const std::vector<double> &values,
                  const hsize_t              first_point,
                  const hsize_t              n_all_points)
    {
      auto dataset = file.create_dataset<double>(name, {n_all_points, n_components});
      if (values.empty())
        dataset.write_none<double>();
      else
        dataset.write_hyperslab(values,
                                {first_point, 0},
                                {values.size() / n_components, n_components});
    }

    /** Names a dataset of the HDF5 file to XDMF. */
    std::string
    data_item(const std::string &file,
              const std::string &name,
              const hsize_t      n_points,
              const unsigned int n_components)
    {
      return "<DataItem Dimensions=\"" + std::to_string(n_points) + ' ' +
             std::to_string(n_components) +
             "\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">" + file + ":/" + name +
             "</DataItem>";
    }

    std::string
    xdmf_attribute(const std::string &name, const FieldShape shape, const std::string &item)
    {
      const char *type = shape == FieldShape::scalar   ? "Scalar"
                         : shape == FieldShape::vector ? "Vector"
                                                       : "Tensor";
      return "<Attribute Name=\"" + name + "\" AttributeType=\"" + type + "\" Center=\"Node\">" +
             item + "</Attribute>\n";
    }

    /** Symmetric tensors go into HDF5 with all nine: readers of XDMF disagree on the order of six.
     */
    unsigned int
    n_columns_of(const FieldShape shape)
    {
      return shape == FieldShape::symmetric_tensor ? 9 : n_values(shape);
    }

    template <int dim>
    std::vector<double>
    collect_columns(const PointField<dim> &field, const std::vector<PointRecord<dim>> &points)
    {
      const std::vector<double> values = collect(field, points);
      if (field.shape != FieldShape::symmetric_tensor)
        return values;
      constexpr unsigned int place[9] =
        {0, 3, 5, 3, 1, 4, 5, 4, 2}; // of ij among xx yy zz xy yz xz
      std::vector<double> all(9 * points.size());
      for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = values[6 * (i / 9) + place[i % 9]];
      return all;
    }
  } // namespace



  template <int dim>
  PointsOutput<dim>::PointsOutput(const RunFolder        &folder,
                                  const OutputParameters &parameters,
                                  const unsigned int      n_kept)
    : folder(folder)
    , n_done(n_kept)
  {
    for (const std::string &name : parameters.fields)
      if (std::find(fields.begin(), fields.end(), &point_field<dim>(name)) == fields.end())
        fields.push_back(&point_field<dim>(name));
    if (parameters.vtu)
      pvd.emplace(folder, "points.pvd", TimeSeries::Format::pvd, n_kept);
    if (parameters.hdf5)
      xdmf.emplace(folder, "points.xdmf", TimeSeries::Format::xdmf, n_kept);
  }



  template <int dim>
  void
  PointsOutput<dim>::write(const double time, const std::vector<PointRecord<dim>> &local_points)
  {
    folder.make_subfolder("points");
    if (pvd)
      write_vtu(time, local_points);
    if (xdmf)
      write_hdf5(time, local_points);
    ++n_done;
  }



  template <int dim>
  void
  PointsOutput<dim>::write_vtu(const double time, const std::vector<PointRecord<dim>> &local_points)
  {
    pvd->add(time,
             write_pieces(folder, "points", stem(n_done), make_piece(fields, local_points), time));
  }



  template <int dim>
  void
  PointsOutput<dim>::write_hdf5(const double                         time,
                                const std::vector<PointRecord<dim>> &local_points)
  {
    const MPI_Comm    communicator = folder.communicator();
    const std::string name         = "points/" + stem(n_done) + ".h5";
    const hsize_t     n_local      = local_points.size();
    const hsize_t     n_all        = dealii::Utilities::MPI::sum(n_local, communicator);
    const hsize_t     first        = sum_over_lower_ranks(n_local, communicator);

    run_on_root(communicator, [&]() {
      write_file(folder.path(name), "");
    });
    const auto item = [&](const PointField<dim> &field) {
      return data_item(name, field.name, n_all, n_columns_of(field.shape));
    };
    const PointField<dim> &position = point_field<dim>("position");
    std::string            entry    = "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" +
                        std::to_string(n_all) +
                        "\" NodesPerElement=\"1\"/>\n<Geometry GeometryType=\"XYZ\">" +
                        item(position) + "</Geometry>\n";
    std::size_t n_columns = 0;
    {
      dealii::HDF5::File file(folder.path(name).string(),
                              dealii::HDF5::File::FileAccessMode::create,
                              communicator);
      const auto         put = [&](const PointField<dim> &field) {
        write_dataset(file,
                      field.name,
                      n_columns_of(field.shape),
                      collect_columns(field, local_points),
                      first,
                      n_all);
        n_columns += n_columns_of(field.shape);
      };
      put(position);
      for (const PointField<dim> *field : fields)
        if (field != &position)
          {
            put(*field);
            entry += xdmf_attribute(field->name, field->shape, item(*field));
          }
    }
    run_on_root(communicator, [&]() { // the HDF5 classes of an optimised deal.II check nothing
      if (std::filesystem::file_size(folder.path(name)) < n_all * n_columns * sizeof(double))
        throw UserError("Cannot write '" + folder.path(name).string() +
                        "': the file came out too short. Is the disk full?");
    });
    xdmf->add(time, entry);
  }



  template <int dim>
  unsigned int
  PointsOutput<dim>::n_written() const
  {
    return n_done;
  }



  template <int dim>
  void
  PointsOutput<dim>::flush() const
  {
    if (pvd)
      pvd->flush();
    if (xdmf)
      xdmf->flush();
  }



  template class PointsOutput<2>;
  template class PointsOutput<3>;
} // namespace kedge
