#include <kedge/contact/contact_books.h>

#include <algorithm>
#include <map>

namespace kedge
{
  template <int dim>
  void
  ContactBooks<dim>::declare(Ledger &ledger, const std::string &pair)
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

    std::string of_pair = "_" + pair;
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
  ContactBooks<dim>::book(Ledger                               &ledger,
                          const std::vector<ContactPlace<dim>> &places,
                          const double                          released,
                          const double                          dt,
                          const Lattice<dim>                   &lattice) const
  {
    double area = 0., overlap = 0., friction = 0., force[3] = {0, 0, 0}, moment[3] = {0, 0, 0};
    std::map<LatticeIndex<dim>, std::pair<double, double>> load_and_area;
    for (const ContactPlace<dim> &place : places)
      {
        friction += place.friction;
        overlap = std::max(overlap, place.overlap);
        if (!(place.pressure > 0.))
          continue;
        area += place.area;
        auto &of_cell = load_and_area[lattice.cell_of(place.at)];
        of_cell.first += place.area * place.pressure;
        of_cell.second += place.area;
        double arm[3] = {0, 0, 0}, on[3] = {0, 0, 0};
        for (int d = 0; d < dim; ++d)
          {
            arm[d] = place.at[d];
            on[d]  = place.force[d];
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
    ledger.book(columns.released, released);
    ledger.book(columns.friction, friction);
    ledger.book(columns.area, area);
    ledger.book(columns.pressure, pressure);
    ledger.book(columns.overlap, overlap);
    ledger.book(columns.duration, area > 0. ? dt : 0.);
    for (int d = 0; d < dim; ++d)
      ledger.book(columns.force[d], force[d]);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(columns.moment[d], moment[d]);
  }



  template <int dim>
  void
  ContactBooks<dim>::book_state(Ledger &ledger, const double stored) const
  {
    ledger.book(columns.energy, stored);
    for (const Ledger::Index extreme : {columns.pressure, columns.overlap})
      ledger.book(extreme, 0.); // of states without a step before them
  }

  template class ContactBooks<2>;
  template class ContactBooks<3>;
} // namespace kedge
