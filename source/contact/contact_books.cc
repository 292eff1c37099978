// What a contact says of itself in the books.
#include <kedge/contact/contact_term.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  ContactTerm<dim>::declare_books(Ledger &ledger)
  {
    using Section  = Ledger::Section;
    using Kind     = Ledger::Kind;
    using Role     = Ledger::Role;
    columns.energy = ledger.declare(
      {"contact_energy", "J", Section::energy, Kind::present, Role::stored, "energy"});
    columns.friction = ledger.declare(
      {"friction_dissipation", "J", Section::energy, Kind::total, Role::lost, "energy"});
    columns.released = ledger.declare(
      {"contact_energy_released", "J", Section::energy, Kind::total, Role::lost, "energy"});

    std::string of_pair = "_" + parameters.name;
    std::replace(of_pair.begin(), of_pair.end(), ' ', '_');
    const auto of_step = [&](const std::string &column, const std::string &unit, const Kind kind) {
      return ledger.declare({"contact_" + column + of_pair, unit, Section::force, kind});
    };
    for (int d = 0; d < dim; ++d)
      columns.force[d] = of_step(std::string("force_") + "xyz"[d], "N", Kind::of_step);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      columns.moment[d] = of_step(std::string("moment_") + "xyz"[d], "N m", Kind::of_step);
    columns.area     = of_step("area", dim == 3 ? "m^2" : "m", Kind::of_step);
    columns.pressure = of_step("pressure", "Pa", Kind::highest);
    columns.overlap  = of_step("overlap", "m", Kind::highest);
    columns.duration = of_step("duration", "s", Kind::total);
  }



  template <int dim>
  void
  ContactTerm<dim>::book(const Trial<dim> &trial, const Residual<dim> &, Ledger &ledger) const
  {
    ledger.book(columns.released, released);
    double area = 0., overlap = 0., friction = 0.;
    // a pressure is resolved by cells: a single sample's is not
    std::map<LatticeIndex<dim>, std::pair<double, double>> load_and_area;
    const auto &lattice  = surfaces.front()->surface.patch.grid().lattice();
    double      force[3] = {0, 0, 0}, moment[3] = {0, 0, 0};
    for (std::size_t k = 0; k < passes.size(); ++k)
      for (const auto &sample : passes[k].samples())
        {
          const auto end = passes[k].outcome(sample);
          friction += sample.area * end.response.dissipation;
          overlap = std::max(overlap, -end.response.gap_end);
          if (!(end.response.pressure > 0.))
            continue;
          area += sample.area;
          auto &of_cell = load_and_area[lattice.cell_of(passes[k].place_at_balance(sample))];
          of_cell.first += sample.area * end.response.pressure;
          of_cell.second += sample.area;
          // on the first body, where that one is: in the configuration of the balance
          const bool                   first = k % 2 == 0;
          const dealii::Tensor<1, dim> f = (first ? 1. : -1.) * sample.area * end.response.traction;
          const dealii::Point<dim>     x =
            first ? passes[k].place_at_balance(sample) : passes[k].partner_at_balance(sample);
          double arm[3] = {0, 0, 0}, on[3] = {0, 0, 0};
          for (int d = 0; d < dim; ++d)
            {
              arm[d] = x[d];
              on[d]  = f[d];
            }
          for (int d = 0; d < 3; ++d)
            {
              force[d] += on[d];
              moment[d] += arm[(d + 1) % 3] * on[(d + 2) % 3] - arm[(d + 2) % 3] * on[(d + 1) % 3];
            }
        }
    double pressure = 0., largest_area = 0.;
    for (const auto &[cell, sums] : load_and_area)
      largest_area = std::max(largest_area, sums.second);
    for (const auto &[cell, sums] : load_and_area)
      if (sums.second >= 0.5 * largest_area)
        pressure = std::max(pressure, sums.first / sums.second);
    ledger.book(columns.friction, friction);
    ledger.book(columns.area, area);
    ledger.book(columns.pressure, pressure);
    ledger.book(columns.overlap, overlap);
    ledger.book(columns.duration, area > 0. ? trial.times.dt : 0.);
    for (int d = 0; d < dim; ++d)
      ledger.book(columns.force[d], force[d]);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(columns.moment[d], moment[d]);
  }



  template <int dim>
  void
  ContactTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &ledger) const
  {
    for (const auto &half : passes)
      ledger.book(columns.energy, half.stored());
    for (const Ledger::Index extreme : {columns.pressure, columns.overlap})
      ledger.book(extreme, 0.); // of states without a step before them
  }

#define KEDGE_INSTANTIATE(dim)                                                                     \
  template void ContactTerm<dim>::declare_books(Ledger &);                                         \
  template void ContactTerm<dim>::book(const Trial<dim> &, const Residual<dim> &, Ledger &) const; \
  template void ContactTerm<dim>::book_state(const MaterialPoints<dim> &, Ledger &) const;
  KEDGE_INSTANTIATE(2)
  KEDGE_INSTANTIATE(3)
} // namespace kedge
