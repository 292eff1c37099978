#include <kedge/base/exceptions.h>
#include <kedge/points/generation.h>
#include <kedge/simulation/size_check.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace kedge
{
  namespace
  {
    // A step takes at least some microseconds, and its row in history.csv some hundred
    // bytes: 1e9 of them are days without a material point, and a full disk.
    constexpr double most_steps    = 1e9;
    constexpr double most_rows     = 1e8; ///< of a single point
    constexpr double most_pictures = 1e6;
    constexpr double row_bytes     = 400.;

    /** Memory that programs can still have [bytes]; infinite if the system does not say. */
    double
    free_memory()
    {
      std::ifstream file("/proc/meminfo");
      std::string   name, unit;
      double        kilobytes = 0., sum = 0.;
      while (file >> name >> kilobytes && std::getline(file, unit))
        if (name == "MemAvailable:" || name == "SwapFree:")
          sum += 1024. * kilobytes;
      return sum > 0. ? sum : std::numeric_limits<double>::infinity();
    }

    /** The part of its bounding box that a body fills, by samples at the centres of equal boxes. */
    template <int dim>
    double
    filled_part(const Geometry<dim> &geometry, const dealii::BoundingBox<dim> &box)
    {
      constexpr unsigned int n = dim == 2 ? 64 : 24;
      const auto [low, high]   = box.get_boundary_points();
      unsigned int n_inside = 0, n_all = 1;
      for (int d = 0; d < dim; ++d)
        n_all *= n;
      for (unsigned int sample = 0; sample < n_all; ++sample)
        {
          dealii::Point<dim> place;
          unsigned int       rest = sample;
          for (int d = 0; d < dim; ++d, rest /= n)
            place[d] = low[d] + (high[d] - low[d]) * (rest % n + 0.5) / n;
          n_inside += geometry.contains(place) ? 1 : 0;
        }
      return static_cast<double>(n_inside) / n_all;
    }

    template <int dim>
    double
    estimated_points(const BodyParameters<dim> &body, const GridParameters<dim> &grid)
    {
      const dealii::BoundingBox<dim> whole({grid.origin, grid.origin + grid.extent});
      const auto                     box = body.geometry->bounding_box(whole);
      double                         n   = filled_part(*body.geometry, box);
      for (int d = 0; d < dim; ++d)
        n *= box.side_length(d) / grid.extent[d] * grid.n_cells[d] * body.points_per_cell[d];
      return n;
    }

    /** Every rank makes all points, twice for a moment, before it keeps its share. */
    template <int dim>
    void
    check_points(const Scene<dim> &scene)
    {
      constexpr double bytes_per_point =
        2. * sizeof(GeneratedPoint<dim>) + sizeof(PointOrigin<dim>) + sizeof(PointRecord<dim>);
      double      n_points = 0., largest = -1.;
      std::string body;
      for (const auto &parameters : scene.bodies)
        {
          const double n = estimated_points(parameters, scene.grid);
          n_points += n;
          if (n > largest)
            body = parameters.name;
          largest = std::max(largest, n);
        }
      const double there = free_memory(), needed = bytes_per_point * n_points;
      if (needed <= there)
        return;
      std::ostringstream message;
      message << "The scene would have about " << n_points << " material points, most of them in "
              << "body '" << body << "', for which at least " << needed / 1e9
              << " GB of memory are needed; " << there / 1e9
              << " GB are free. Take fewer Points per cell (Bodies/" << body
              << "), or larger cells (Grid/Cells).";
      throw UserError(message.str());
    }

    [[noreturn]] void
    refuse(const std::string &what, const double n, const double most, const std::string &remedy)
    {
      std::ostringstream message;
      message << what << " " << n << "; there may be " << most << ". " << remedy;
      throw UserError(message.str());
    }
  } // namespace



  template <int dim>
  void
  check_size(const Scene<dim> &scene)
  {
    const TimeParameters &time = scene.time;
    const double          span = time.end - time.start;
    if (time.step_kind == StepSizeKind::fixed && span / time.step > most_steps)
      refuse("The number of steps, (Time/End - Time/Start) over Time/Step, is",
             span / time.step,
             most_steps,
             "Take a larger Time/Step or an earlier Time/End.");
    if (scene.equilibrium.steps > most_steps)
      refuse("Equilibrium/Steps is",
             scene.equilibrium.steps,
             most_steps,
             "Some ten are enough for most scenes.");
    const double interval = scene.output.points_interval;
    if (interval > 0. && span / interval > most_pictures)
      refuse("The number of pictures, (Time/End - Time/Start) over Output/Points interval, is",
             span / interval,
             most_pictures,
             "Take a larger Output/Points interval.");
    check_points(scene);
  }



  void
  check_size(const PathScene &scene)
  {
    if (scene.path.n_steps > most_rows)
      refuse("Path/Steps would write " + std::to_string(scene.path.n_steps * row_bytes / 1e9) +
               " GB into history.csv; it is",
             scene.path.n_steps,
             most_rows,
             "Some hundred are enough for most paths.");
  }

  template void
  check_size(const Scene<2> &);
  template void
  check_size(const Scene<3> &);
} // namespace kedge
