#include <kedge/io/rigid_output.h>
#include <kedge/io/vtu_file.h>

#include <deal.II/base/utilities.h>

namespace kedge
{
  namespace
  {
    template <int dim>
    VtuFile
    make_piece(const RigidBodies<dim> &bodies)
    {
      constexpr std::uint8_t line = 3, triangle = 5;

      std::vector<std::int64_t> connectivity, numbers;
      std::vector<Vector3>      places, velocities;
      for (unsigned int b = 0; b < bodies.size() && bodies.is_first(); ++b)
        {
          const RigidState &state    = bodies[b].state;
          const Matrix33    attitude = matrix_of(state.attitude);
          const Vector3     rate     = attitude * state.angular_velocity;
          const auto        first    = static_cast<std::int64_t>(places.size());
          for (const auto &vertex : bodies.surface(b).vertices)
            {
              Vector3 on_it;
              for (int d = 0; d < dim; ++d)
                on_it[d] = vertex[d];
              const Vector3 lever = attitude * on_it;
              places.push_back(Vector3(state.centre) + lever);
              velocities.push_back(state.velocity + cross_product_3d(rate, lever));
            }
          for (const auto &facet : bodies.surface(b).facets)
            {
              for (const unsigned int vertex : facet)
                connectivity.push_back(first + vertex);
              numbers.push_back(b);
            }
        }
      VtuFile piece;
      piece.set_nodes(with_three_components<3>(places));
      piece.set_cells(connectivity, dim, dim == 2 ? line : triangle);
      piece.add_field({"velocity", "", 3, {"x", "y", "z"}}, with_three_components<3>(velocities));
      piece.add_cell_field({"body", "", 1, {}}, numbers);
      return piece;
    }
  } // namespace



  template <int dim>
  RigidOutput<dim>::RigidOutput(const RunFolder &folder, const unsigned int n_kept)
    : folder(folder)
    , n_done(n_kept)
    , pvd(folder, "rigid_bodies.pvd", TimeSeries::Format::pvd, n_kept)
  {}



  template <int dim>
  void
  RigidOutput<dim>::write(const double time, const RigidBodies<dim> &bodies)
  {
    folder.make_subfolder("rigid_bodies");
    const std::string stem = "rigid_bodies-" + dealii::Utilities::int_to_string(n_done, 6);
    pvd.add(time, write_pieces(folder, "rigid_bodies", stem, make_piece(bodies), time));
    ++n_done;
  }



  template <int dim>
  unsigned int
  RigidOutput<dim>::n_written() const
  {
    return n_done;
  }



  template <int dim>
  void
  RigidOutput<dim>::flush() const
  {
    pvd.flush();
  }

  template class RigidOutput<2>;
  template class RigidOutput<3>;
} // namespace kedge
