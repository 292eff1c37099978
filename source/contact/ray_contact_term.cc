#include <kedge/contact/ray_contact_term.h>

#include <deal.II/base/quadrature_lib.h>

namespace kedge
{
  template <int dim>
  RayContactTerm<dim>::RayContactTerm(const std::string        &pair,
                                      const ContactFields<dim> &fields,
                                      const RayLaw             &law)
    : pair(pair)
    , fields(fields)
    , law(law)
    , multipliers(fields.number, dim)
  {}



  template <int dim>
  void
  RayContactTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section = Ledger::Section;
    using Kind    = Ledger::Kind;
    using Role    = Ledger::Role;
    columns.lost  = ledger.declare(
      {"contact_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    columns.friction = ledger.declare(
      {"friction_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    resultant.declare(ledger, pair);
    columns.area =
      ledger.declare(contact_column("area", dim == 3 ? "m^2" : "m", Kind::of_step, pair));
    columns.duration = ledger.declare(contact_column("duration", "s", Kind::total, pair));
  }



  /** The faces of the first body that see some of the second, and the points on them. */
  template <int dim>
  void
  RayContactTerm<dim>::activate(const MaterialPoints<dim> &cloud)
  {
    const Lattice<dim>  &lattice = fields.patch[0]->grid().lattice();
    std::array<Cells, 2> filled;
    cloud.for_each_core([&](const unsigned int,
                            const std::uint64_t,
                            const dealii::Point<dim> &location,
                            const PointCore<dim>     &core) {
      for (unsigned int k = 0; k < 2; ++k)
        if (fields.takes_part[k][static_cast<unsigned int>(core.body)])
          filled[k].insert(lattice.cell_of(location));
    });
    faces.clear();
    common.clear();
    held.clear();
    for (const auto &cell : filled[0])
      for (int d = 0; d < dim; ++d)
        for (const int sign : {-1, 1})
          {
            LatticeIndex<dim> neighbour = cell;
            neighbour[d] += sign;
            if (filled[0].count(neighbour) == 0)
              add_face({cell, d, sign}, filled[1]);
          }
  }



  /** The face of a filled cell that looks back along the same row of cells: at the same place, a
   * cell behind, or a cell ahead. */
  template <int dim>
  bool
  RayContactTerm<dim>::find_partner(const CellSide &side,
                                    const Cells    &filled,
                                    CellSide       &partner,
                                    int            &ahead) const
  {
    const int d = side.direction;
    for (const int cells : {0, -1, 1})
      {
        LatticeIndex<dim> beyond = side.cell;
        beyond[d] += side.sign * (1 + cells);
        LatticeIndex<dim> before = beyond;
        before[d] -= side.sign;
        if (filled.count(beyond) == 0 || filled.count(before) != 0)
          continue;
        partner = {beyond, d, -side.sign};
        ahead   = cells;
        return true;
      }
    return false;
  }



  template <int dim>
  typename RayContactTerm<dim>::CornerNodes
  RayContactTerm<dim>::nodes_of(const CellSide &side) const
  {
    CornerNodes result;
    for (unsigned int a = 0; a < n_corners; ++a)
      {
        result[a] = side.cell;
        result[a][side.direction] += side.sign > 0 ? 1 : 0;
        for (int d = 0, k = 0; d < dim; ++d)
          if (d != side.direction)
            result[a][d] += (a >> k++) & 1u;
      }
    return result;
  }



  template <int dim>
  void
  RayContactTerm<dim>::add_face(const CellSide &side, const Cells &filled)
  {
    CellSide partner;
    int      ahead = 0;
    if (!find_partner(side, filled, partner, ahead))
      return;
    const auto here = nodes_of(side), there = nodes_of(partner);
    Face       face;
    Corners    same_place; // nodes of the second field where the first body's are
    for (unsigned int a = 0; a < n_corners; ++a)
      {
        const auto number = fields.patch[0]->window().node_number(here[a]);
        const int  first  = fields.patch[0]->nodes.local(number),
                  both    = fields.patch[1]->nodes.local(number),
                  second =
                    fields.patch[1]->nodes.local(fields.patch[1]->window().node_number(there[a]));
        if (first < 0 || second < 0 || both < 0)
          return;
        face.first[a]  = static_cast<unsigned int>(first);
        face.second[a] = static_cast<unsigned int>(second);
        same_place[a]  = static_cast<unsigned int>(both);
      }
    for (unsigned int a = 0; a < n_corners; ++a)
      {
        const auto [known, is_new] = common.emplace(fields.patch[0]->window().node_number(here[a]),
                                                    static_cast<unsigned int>(common.size()));
        face.multiplier[a]         = known->second;
        for (int d = 0; is_new && d < dim; ++d)
          held.push_back(!is_free(fields, {{face.first[a], same_place[a]}}, d));
      }
    set_places(side, here, there, ahead, face);
    faces.push_back(face);
  }



  template <int dim>
  void
  RayContactTerm<dim>::set_places(const CellSide    &side,
                                  const CornerNodes &first,
                                  const CornerNodes &second,
                                  const int          ahead,
                                  Face              &face) const
  {
    const Lattice<dim> &lattice = fields.patch[0]->grid().lattice();
    RayPlace<dim>       place;
    double              area = 1.;
    for (unsigned int a = 0; a < n_corners; ++a)
      {
        place.first[a]  = lattice.node_position(first[a]);
        place.second[a] = lattice.node_position(second[a]);
      }
    for (int d = 0; d < dim; ++d)
      area *= d == side.direction ? 1. : lattice.h[d];
    // the directions along the face in ascending order are left-handed with y
    place.outward = side.sign * (side.direction == 1 ? -1. : 1.);
    place.overlap = std::max(-ahead, 0) * lattice.h[side.direction];

    const dealii::QGauss<dim - 1> gauss(n_gauss);
    for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        for (unsigned int a = 0; a < n_corners; ++a)
          {
            place.value[a] = 1.;
            for (int k = 0; k < dim - 1; ++k)
              place.slope[k][a] = 1.;
            for (int k = 0; k < dim - 1; ++k)
              {
                const bool   upper = (a >> k) & 1u;
                const double at    = gauss.point(q)[k];
                place.value[a] *= upper ? at : 1. - at;
                for (int l = 0; l < dim - 1; ++l)
                  place.slope[l][a] *= l == k ? (upper ? 1. : -1.) : (upper ? at : 1. - at);
              }
          }
        face.places.push_back(place);
        face.areas.push_back(gauss.weight(q) * area);
      }
  }



  template <int dim>
  template <typename Number, typename Make>
  RayState<dim, Number>
  RayContactTerm<dim>::state_of(const Face &face, const Trial<dim> &trial, const Make &make) const
  {
    RayState<dim, Number> state;
    for (unsigned int a = 0; a < n_corners; ++a)
      for (int d = 0; d < dim; ++d)
        {
          const unsigned int i = a * dim + d;
          state.first[a][d] =
            make(trial.displacement(fields.number[0])[std::size_t(face.first[a]) * dim + d], i);
          state.second[a][d] =
            make(trial.displacement(fields.number[1])[std::size_t(face.second[a]) * dim + d],
                 n_corners * dim + i);
          state.multiplier[a][d] =
            make(law.stiffness * trial.unknowns.others[multipliers.number(face.multiplier[a], d)],
                 2 * n_corners * dim + i);
        }
    return state;
  }



  template <int dim>
  RayState<dim, double>
  RayContactTerm<dim>::plain_state_of(const Face &face, const Trial<dim> &trial) const
  {
    return state_of<double>(face, trial, [](const double value, const unsigned int) {
      return value;
    });
  }



  template <int dim>
  typename RayContactTerm<dim>::FaceUnknowns
  RayContactTerm<dim>::unknowns_of(const Face &face) const
  {
    FaceUnknowns result;
    for (unsigned int a = 0; a < n_corners; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i        = a * dim + d;
          result[i]                   = {fields.number[0], face.first[a], d};
          result[n_corners * dim + i] = {fields.number[1], face.second[a], d};
          result[2 * n_corners * dim + i] =
            UnknownIndex::other(multipliers.number(face.multiplier[a], d));
        }
    return result;
  }



  template <int dim>
  bool
  RayContactTerm<dim>::is_held(const Face &face, const unsigned int corner, const int d) const
  {
    return held[face.multiplier[corner] * dim + d];
  }



  template <int dim>
  Answer
  RayContactTerm<dim>::add_residual(const Trial<dim> &trial, Residual<dim> &residual)
  {
    for (const Face &face : faces)
      {
        const auto state = plain_state_of(face, trial);
        for (std::size_t q = 0; q < face.places.size(); ++q)
          {
            const auto  here = ray_contact<dim, double>(law, face.places[q], state);
            const auto &N    = face.places[q].value;
            for (unsigned int a = 0; a < n_corners; ++a)
              for (int d = 0; d < dim; ++d)
                {
                  const double F = face.areas[q] * here.force[d];
                  residual.partial(fields.number[0])[std::size_t(face.first[a]) * dim + d] -=
                    N[a] * F;
                  residual.partial(fields.number[1])[std::size_t(face.second[a]) * dim + d] +=
                    here.partner[a] * F;
                  if (!is_held(face, a, d))
                    residual.others()[multipliers.number(face.multiplier[a], d)] +=
                      face.areas[q] * N[a] * here.constraint[d];
                }
          }
      }
    return {};
  }



  template <int dim>
  void
  RayContactTerm<dim>::add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent)
  {
    std::vector<bool> is_used(multipliers.size(), false);
    for (const Face &face : faces)
      {
        const auto state =
          state_of<Sloped>(face, trial, [](const double value, const unsigned int which) {
            return Sloped::variable(value, which);
          });
        std::array<Sloped, n_values> rows;
        for (std::size_t q = 0; q < face.places.size(); ++q)
          {
            const auto  here = ray_contact<dim, Sloped>(law, face.places[q], state);
            const auto &N    = face.places[q].value;
            for (unsigned int a = 0; a < n_corners; ++a)
              for (int d = 0; d < dim; ++d)
                {
                  const unsigned int i          = a * dim + d;
                  const Sloped       F          = Sloped(face.areas[q]) * here.force[d];
                  rows[i]                       = rows[i] - Sloped(N[a]) * F;
                  rows[n_corners * dim + i]     = rows[n_corners * dim + i] + here.partner[a] * F;
                  rows[2 * n_corners * dim + i] = rows[2 * n_corners * dim + i] +
                                                  Sloped(face.areas[q] * N[a]) * here.constraint[d];
                }
          }
        const auto unknowns = unknowns_of(face);
        for (unsigned int i = 0; i < n_values; ++i)
          {
            const unsigned int of_multiplier = i - 2 * n_corners * dim;
            if (i >= 2 * n_corners * dim)
              {
                if (is_held(face, of_multiplier / dim, static_cast<int>(of_multiplier % dim)))
                  continue;
                is_used[face.multiplier[of_multiplier / dim] * dim + of_multiplier % dim] = true;
              }
            for (unsigned int j = 0; j < n_values; ++j)
              tangent.add(unknowns[i],
                          unknowns[j],
                          rows[i].slope[j] * (j < 2 * n_corners * dim ? 1. : law.stiffness));
          }
      }
    multipliers.hold_unused(is_used, law.stiffness, tangent);
  }



  template <int dim>
  void
  RayContactTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    double                            lost = 0., friction = 0., area = 0.;
    typename ResultantBooks<dim>::Sum sum;
    for (const Face &face : faces)
      {
        const auto state = plain_state_of(face, trial);
        for (std::size_t q = 0; q < face.places.size(); ++q)
          {
            const auto here = ray_contact<dim, double>(law, face.places[q], state);
            if (!here.closed)
              continue;
            area += face.areas[q];
            dealii::Point<dim>     x;
            dealii::Tensor<1, dim> force, D, normal;
            for (int d = 0; d < dim; ++d)
              {
                force[d]  = face.areas[q] * here.force[d];
                normal[d] = here.normal[d];
                for (unsigned int a = 0; a < n_corners; ++a)
                  {
                    const double N = face.places[q].value[a];
                    x[d] += N * (face.places[q].first[a][d] + law.alpha * state.first[a][d]);
                    D[d] += N * state.first[a][d] - here.partner[a] * state.second[a][d];
                  }
              }
            const double along = force * D - (force * normal) * (normal * D);
            friction -= along;
            lost -= force * D - along;
            sum.add(x, force);
          }
      }
    ledger.book(columns.lost, lost);
    ledger.book(columns.friction, friction);
    ledger.book(columns.area, area);
    ledger.book(columns.duration, area > 0. ? trial.times.dt : 0.);
    resultant.book(ledger, sum);
  }

  template class RayContactTerm<2>;
  template class RayContactTerm<3>;
} // namespace kedge
