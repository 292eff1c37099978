#include <kedge/base/exceptions.h>
#include <kedge/points/clipped_moments.h>
#include <kedge/points/generation.h>

namespace kedge
{
  namespace
  {
    /** What differs from a whole or an empty sub-cell by less than this part is one. */
    constexpr double rounding_tolerance = 1e-9;

    /** Smaller parts of a sub-cell join a neighbour in their cell, boxes one in any cell. */
    constexpr double smallest_part = 0.1;

    /** Integer box of sub-cells [low, high) of one level that may hold points of a body. */
    template <int dim>
    struct SubCells
    {
      const GridLevels<dim> &levels;
      unsigned int           level;
      Lattice<dim>           lattice; ///< of the level
      std::array<int, dim>   per_cell;
      LatticeIndex<dim>      low, high;

      /** Whether the cell of the grid around a sub-cell is of this level. */
      bool
      is_of_level(const LatticeIndex<dim> &sub) const
      {
        if (levels.size() == 1)
          return true;
        LatticeIndex<dim> coarsest;
        for (int d = 0; d < dim; ++d)
          {
            const int size = per_cell[d] << level;
            coarsest[d]    = sub[d] < 0 ? -1 : sub[d] / size;
          }
        return levels.level_of_cell(coarsest) == level;
      }

      dealii::Point<dim>
      centre(const LatticeIndex<dim> &sub) const
      {
        dealii::Point<dim> x;
        for (int d = 0; d < dim; ++d)
          {
            // cell and place in it apart: the same in every cell to round-off
            const int cell = sub[d] / per_cell[d], within = sub[d] % per_cell[d];
            x[d] = lattice.origin[d] + (cell + (within + 0.5) / per_cell[d]) * lattice.h[d];
          }
        return x;
      }

      /** The cell of the grid that holds a sub-cell. */
      LatticeIndex<dim>
      cell(const LatticeIndex<dim> &sub) const
      {
        LatticeIndex<dim> result;
        for (int d = 0; d < dim; ++d)
          result[d] = sub[d] / per_cell[d];
        return result;
      }

      dealii::Tensor<1, dim>
      half_lengths() const
      {
        dealii::Tensor<1, dim> half;
        for (int d = 0; d < dim; ++d)
          half[d] = 0.5 * (lattice.h[d] / per_cell[d]);
        return half;
      }

      double
      volume() const
      {
        double volume = 1;
        for (int d = 0; d < dim; ++d)
          volume *= lattice.h[d] / per_cell[d];
        return volume;
      }

      /** Number of a sub-cell of the box or of the layer of sub-cells around it. */
      std::size_t
      key(const LatticeIndex<dim> &sub) const
      {
        std::size_t key = 0;
        for (int d = dim - 1; d >= 0; --d)
          key = key * (high[d] - low[d] + 2) + (sub[d] - low[d] + 1);
        return key;
      }

      std::size_t
      n_keys() const
      {
        std::size_t n = 1;
        for (int d = 0; d < dim; ++d)
          n *= high[d] - low[d] + 2;
        return n;
      }

      /** Calls visit(sub) for all sub-cells, cell after cell. */
      template <typename Visitor>
      void
      for_each(const Visitor &visit) const
      {
        LatticeIndex<dim> sub = low;
        while (true)
          {
            visit(sub);
            int d = 0;
            while (d < dim && ++sub[d] == high[d])
              {
                sub[d] = low[d];
                ++d;
              }
            if (d == dim)
              return;
          }
      }
    };

    template <int dim>
    SubCells<dim>
    sub_cells_of(const BodyParameters<dim> &body,
                 const GridLevels<dim>     &levels,
                 const unsigned int         level)
    {
      const Lattice<dim> &lattice = levels.lattice(level);
      dealii::Point<dim>  upper;
      for (int d = 0; d < dim; ++d)
        upper[d] = lattice.upper(d);
      const dealii::BoundingBox<dim> domain({lattice.origin, upper});
      const auto bounds = body.geometry->bounding_box(domain).get_boundary_points();

      SubCells<dim> sub_cells{levels, level, lattice, {}, {}, {}};
      for (int d = 0; d < dim; ++d)
        {
          const double tolerance = 1e-9 * (upper[d] - lattice.origin[d]);
          if (bounds.first[d] < lattice.origin[d] - tolerance ||
              bounds.second[d] > upper[d] + tolerance)
            {
              std::ostringstream message;
              message << "Body '" << body.name << "' reaches past the background grid: it spans "
                      << bounds.first << " to " << bounds.second << ", the grid " << lattice.origin
                      << " to " << upper
                      << ". Move the body or make the grid (Grid/Origin, Grid/Extent) larger.";
              throw UserError(message.str());
            }
          const int per_cell    = body.points_per_cell[d];
          sub_cells.per_cell[d] = per_cell;
          const auto line       = [&](const double x) {
            return lattice.scaled(x, d) * per_cell;
          };
          sub_cells.low[d]  = std::max(0, static_cast<int>(std::floor(line(bounds.first[d]))) - 1);
          sub_cells.high[d] = std::min(per_cell * lattice.n_cells[d],
                                       static_cast<int>(std::ceil(line(bounds.second[d]))) + 1);
        }
      return sub_cells;
    }

    /** Half edges of a box with the radii of gyration that a piece has about its centre. */
    template <int dim>
    dealii::Tensor<1, dim>
    box_of(const VolumeMoments<dim> &moments)
    {
      const VolumeMoments<dim> central = moments.about(moments.centre());
      dealii::Tensor<1, dim>   half;
      for (int d = 0; d < dim; ++d)
        half[d] = std::sqrt(3. * central.second[d][d] / central.volume);
      return half;
    }

    /** Whether a piece is a box along the axes: it fills the one with its radii. */
    template <int dim>
    bool
    is_box(const VolumeMoments<dim> &moments)
    {
      const double volume = VolumeMoments<dim>::of_box(box_of(moments)).volume;
      return std::abs(volume - moments.volume) < 1e-6 * moments.volume;
    }

    /** What of a body lies in a sub-cell: a material point, or a part of one. */
    template <int dim>
    struct Piece
    {
      LatticeIndex<dim>  sub;
      bool               whole;       ///< it fills its sub-cell and nothing joined it
      bool               is_box;      ///< along the axes, before anything joined it
      double             part;        ///< of the sub-cell's volume
      VolumeMoments<dim> moments;     ///< about the sub-cell's centre
      int                joined = -1; ///< the piece it joined
    };

    /** The pieces of a body and which of them lies in which sub-cell. */
    template <int dim>
    struct Pieces
    {
      std::vector<Piece<dim>> list;
      std::vector<int>        of_key; ///< by SubCells::key; -1: empty
    };

    template <int dim>
    std::optional<Piece<dim>>
    clipped_piece(const Geometry<dim>     &geometry,
                  const SubCells<dim>     &sub_cells,
                  const LatticeIndex<dim> &sub)
    {
      const dealii::Tensor<1, dim>   half   = sub_cells.half_lengths();
      const dealii::Point<dim>       centre = sub_cells.centre(sub);
      const dealii::BoundingBox<dim> box({centre - half, centre + half});
      const Filling                  filling = geometry.filling(box);
      if (filling == Filling::empty)
        return std::nullopt;
      const auto whole = VolumeMoments<dim>::of_box(half);
      Piece<dim> piece{sub, true, true, 1., whole};
      if (filling == Filling::full)
        return piece;
      const VolumeMoments<dim> moments = clipped_moments(geometry, box);
      piece.part                       = moments.volume / whole.volume;
      if (piece.part < rounding_tolerance)
        return std::nullopt;
      if (piece.part > 1. - rounding_tolerance)
        return Piece<dim>{sub, true, true, 1., whole};
      piece.whole   = false;
      piece.is_box  = is_box(moments);
      piece.moments = moments;
      return piece;
    }

    /** What of a body lies in a sub-cell, if anything. */
    template <int dim>
    std::optional<Piece<dim>>
    piece_in(const BodyParameters<dim> &body,
             const SubCells<dim>       &sub_cells,
             const LatticeIndex<dim>   &sub)
    {
      if (body.clip)
        return clipped_piece<dim>(*body.geometry, sub_cells, sub);
      if (!body.geometry->contains(sub_cells.centre(sub)))
        return std::nullopt;
      const auto whole = VolumeMoments<dim>::of_box(sub_cells.half_lengths());
      return Piece<dim>{sub, true, true, 1., whole};
    }

    template <int dim>
    Pieces<dim>
    find_pieces(const BodyParameters<dim> &body, const SubCells<dim> &sub_cells)
    {
      Pieces<dim> pieces;
      pieces.of_key.assign(sub_cells.n_keys(), -1);
      sub_cells.for_each([&](const LatticeIndex<dim> &sub) {
        if (!sub_cells.is_of_level(sub))
          return;
        const auto piece = piece_in<dim>(body, sub_cells, sub);
        if (!piece)
          return;
        pieces.of_key[sub_cells.key(sub)] = static_cast<int>(pieces.list.size());
        pieces.list.push_back(*piece);
      });
      return pieces;
    }

    /**
     * Among the neighbours of a small piece the one that it joins: with a common
     * face if there is any, then the largest. -1 if all are small. A neighbour in another cell
     * comes into question only if both are boxes, which make a larger box: the functions of that
     * cell are not those of any other part.
     */
    template <int dim>
    int
    neighbour_to_join(const Pieces<dim>   &pieces,
                      const SubCells<dim> &sub_cells,
                      const Piece<dim>    &small)
    {
      int          best       = -1;
      double       best_score = 0;
      unsigned int n          = 1;
      for (int d = 0; d < dim; ++d)
        n *= 3;
      for (unsigned int i = 0; i < n; ++i)
        {
          LatticeIndex<dim> sub   = small.sub;
          int               steps = 0;
          bool              known = true;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= 3)
            {
              const int step = static_cast<int>(rest % 3) - 1;
              sub[d] += step;
              steps += std::abs(step);
              known = known && sub[d] >= sub_cells.low[d] - 1 && sub[d] <= sub_cells.high[d];
            }
          const int other = known ? pieces.of_key[sub_cells.key(sub)] : -1;
          if (steps == 0 || other < 0 || pieces.list[other].part < smallest_part)
            continue;
          const bool same_cell = sub_cells.cell(sub) == sub_cells.cell(small.sub);
          if (!same_cell && !(small.is_box && pieces.list[other].is_box))
            continue;
          const double score = pieces.list[other].part + 2. * (dim - steps);
          if (score > best_score)
            {
              best       = other;
              best_score = score;
            }
        }
      return best;
    }

    /** Volume and first moment stay: no material point weighs next to nothing. */
    template <int dim>
    void
    join_small_pieces(Pieces<dim> &pieces, const SubCells<dim> &sub_cells)
    {
      for (auto &piece : pieces.list)
        {
          if (piece.part >= smallest_part)
            continue;
          piece.joined = neighbour_to_join(pieces, sub_cells, piece);
          if (piece.joined < 0)
            continue;
          Piece<dim>            &other = pieces.list[piece.joined];
          dealii::Tensor<1, dim> shift;
          for (int d = 0; d < dim; ++d)
            shift[d] = (other.sub[d] - piece.sub[d]) * 2. * sub_cells.half_lengths()[d];
          other.moments.add(piece.moments.about(shift));
          other.whole = false;
        }
    }

    /**
     * Half edges of the box that stands for a piece, a GIMP domain: its volume is that
     * of the piece, its edges are as the radii of gyration of the piece about its
     * centre. A piece that is itself a box gets this box, so that its faces lie on the
     * body's surface. The box of any other ends where its cell does, so that the means of the
     * grid's functions over it are those of the cell.
     */
    template <int dim>
    dealii::Tensor<1, dim>
    domain_of(const SubCells<dim> &sub_cells, const Piece<dim> &piece)
    {
      dealii::Tensor<1, dim> half = box_of(piece.moments);
      half *= std::pow(piece.moments.volume / VolumeMoments<dim>::of_box(half).volume, 1. / dim);
      if (is_box(piece.moments))
        return half;
      const auto x    = sub_cells.centre(piece.sub) + piece.moments.centre();
      const auto cell = sub_cells.cell(piece.sub);
      for (int d = 0; d < dim; ++d)
        {
          const double s = sub_cells.lattice.scaled(x[d], d) - cell[d];
          half[d]        = std::min(half[d], std::min(s, 1. - s) * sub_cells.lattice.h[d]);
        }
      return half;
    }

    template <int dim>
    PointState<dim>
    state_at_rest(const dealii::Point<dim>                       &x,
                  const dealii::Tensor<1, dim>                   &half_lengths,
                  const double                                    volume,
                  const unsigned int                              body_index,
                  const double                                    density,
                  const std::array<Expression, std::size_t(dim)> &velocity)
    {
      PointState<dim> state;
      std::fill_n(reinterpret_cast<double *>(&state), n_state_values<dim>, 0.);
      state.body             = body_index;
      state.reference_volume = volume;
      double coordinates[3]  = {0, 0, 0};
      for (int d = 0; d < dim; ++d)
        {
          coordinates[d]                  = x[d];
          state.reference_half_lengths[d] = state.half_lengths[d] = half_lengths[d];
          state.reference_position[d]                             = x[d];
          state.deformation_gradient[d][d] = state.elastic_frame[d][d] = 1.;
        }
      state.out_of_plane_elastic_stretch = 1.;
      state.mass                         = density * state.reference_volume;
      for (int d = 0; d < dim; ++d)
        state.velocity[d] = velocity[d](coordinates);
      return state;
    }

    /** Appends the points of the cells of one level. */
    template <int dim>
    void
    add_points_of_level(const BodyParameters<dim>                      &body,
                        const unsigned int                              body_index,
                        const double                                    density,
                        const SubCells<dim>                            &sub_cells,
                        const std::array<Expression, std::size_t(dim)> &velocity,
                        const std::uint64_t                             first_id,
                        std::vector<GeneratedPoint<dim>>               &points)
    {
      Pieces<dim> pieces = find_pieces(body, sub_cells);
      join_small_pieces(pieces, sub_cells);

      const double     whole_volume = sub_cells.volume();
      std::vector<int> point_of(pieces.list.size(), -1);
      points.reserve(points.size() + pieces.list.size());
      for (std::size_t i = 0; i < pieces.list.size(); ++i)
        {
          const Piece<dim> &piece = pieces.list[i];
          if (piece.joined >= 0)
            continue;
          point_of[i]  = static_cast<int>(points.size());
          const auto x = sub_cells.centre(piece.sub) +
                         (piece.whole ? dealii::Tensor<1, dim>() : piece.moments.centre());
          points.push_back({{first_id + points.size(),
                             x,
                             state_at_rest<dim>(x,
                                                piece.whole ? sub_cells.half_lengths()
                                                            : domain_of(sub_cells, piece),
                                                piece.whole ? whole_volume : piece.moments.volume,
                                                body_index,
                                                density,
                                                velocity)},
                            0u});
        }
      for (std::size_t i = 0; i < pieces.list.size(); ++i)
        {
          const Piece<dim> &piece = pieces.list[i];
          auto &point = points[point_of[piece.joined >= 0 ? piece.joined : static_cast<int>(i)]];
          for (int side = 0; side < 2 * dim; ++side)
            {
              LatticeIndex<dim> neighbour = piece.sub;
              neighbour[side / 2] += side % 2 == 0 ? -1 : 1;
              const bool covered = sub_cells.is_of_level(neighbour)
                                     ? pieces.of_key[sub_cells.key(neighbour)] >= 0
                                     : piece_in<dim>(body, sub_cells, neighbour).has_value();
              if (!covered)
                point.exposed_sides |= 1u << side;
            }
        }
    }
  } // namespace



  template <int dim>
  std::vector<GeneratedPoint<dim>>
  generate_points(const BodyParameters<dim>           &body,
                  const unsigned int                   body_index,
                  const double                         density,
                  const GridLevels<dim>               &levels,
                  const std::map<std::string, double> &constants,
                  const std::uint64_t                  first_id)
  {
    std::array<Expression, dim> velocity;
    for (int d = 0; d < dim; ++d)
      velocity[d] = Expression(body.initial_velocity[d], {"x", "y", "z"}, constants);

    std::vector<GeneratedPoint<dim>> points;
    for (unsigned int level = 0; level < levels.size(); ++level)
      add_points_of_level<dim>(body,
                               body_index,
                               density,
                               sub_cells_of(body, levels, level),
                               velocity,
                               first_id,
                               points);
    if (points.empty())
      throw UserError("Body '" + body.name + "' got no material point: its geometry contains no " +
                      (body.clip ? "part of the grid's cells"
                                 : "centre of the grid's sub-cells. Refine the grid (Grid/Cells) "
                                   "or use more points per cell (Bodies/" +
                                     body.name + "/Points per cell)") +
                      ".");
    return points;
  }

  template std::vector<GeneratedPoint<2>>
  generate_points(const BodyParameters<2> &,
                  const unsigned int,
                  const double,
                  const GridLevels<2> &,
                  const std::map<std::string, double> &,
                  const std::uint64_t);
  template std::vector<GeneratedPoint<3>>
  generate_points(const BodyParameters<3> &,
                  const unsigned int,
                  const double,
                  const GridLevels<3> &,
                  const std::map<std::string, double> &,
                  const std::uint64_t);
} // namespace kedge
