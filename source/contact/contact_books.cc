#include <kedge/contact/contact_books.h>

#include <algorithm>
#include <map>

namespace kedge
{
  template <int dim>
  void
  ContactPlace<dim>::set_response(const ContactResponse<dim>   &response,
                                  const dealii::Tensor<1, dim> &normal,
                                  const dealii::Tensor<1, dim> &displacement,
                                  const double                  dt)
  {
    // the law is per area at the start of the run; what is shown is per present area
    const double stretch = surface->stretch(facet);
    force                = (on_first ? area : -area) * response.traction;
    friction             = area * response.dissipation;
    pressure             = response.pressure / stretch;
    area *= stretch;
    gap       = response.gap_end;
    slip_rate = (displacement - (displacement * normal) * normal) / dt;
    sticks    = response.sticks;
  }



  Ledger::Entry
  contact_column(const std::string &what,
                 const std::string &unit,
                 const Ledger::Kind kind,
                 const std::string &contact)
  {
    std::string name = "contact_" + what + "_" + contact;
    std::replace(name.begin(), name.end(), ' ', '_');
    return {name, unit, Ledger::Section::force, kind};
  }



  template <int dim>
  void
  ResultantBooks<dim>::Sum::add(const dealii::Point<dim> &at, const dealii::Tensor<1, dim> &on)
  {
    for (int d = 0; d < dim; ++d)
      force[d] += on[d];
    // x_i f_j is in the moment about the axis that follows both, x_j f_i against it
    for (int i = 0; i < dim; ++i)
      for (int j = i + 1; j < dim; ++j)
        moment[3 - i - j] += (j - i == 1 ? 1. : -1.) * (at[i] * on[j] - at[j] * on[i]);
  }



  template <int dim>
  void
  ResultantBooks<dim>::declare(Ledger &ledger, const std::string &contact)
  {
    const auto declared = [&](const std::string &what, const int d, const std::string &unit) {
      return ledger.declare(
        contact_column(what + "_" + "xyz"[d], unit, Ledger::Kind::of_step, contact));
    };
    for (int d = 0; d < dim; ++d)
      force[d] = declared("force", d, "N");
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      moment[d] = declared("moment", d, "N m");
  }



  template <int dim>
  void
  ResultantBooks<dim>::book(Ledger &ledger, const Sum &sum) const
  {
    for (int d = 0; d < dim; ++d)
      ledger.book(force[d], sum.force[d]);
    for (int d = dim == 3 ? 0 : 2; d < 3; ++d)
      ledger.book(moment[d], sum.moment[d]);
  }



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

    const auto of_pair = [&](const std::string &what, const std::string &unit, const Kind kind) {
      return ledger.declare(contact_column(what, unit, kind, pair));
    };
    resultant.declare(ledger, pair);
    columns.area       = of_pair("area", dim == 3 ? "m^2" : "m", Kind::of_step);
    columns.stick_area = of_pair("stick_area", dim == 3 ? "m^2" : "m", Kind::of_step);
    columns.pressure   = of_pair("pressure", "Pa", Kind::highest);
    columns.overlap    = of_pair("overlap", "m", Kind::highest);
    columns.duration   = of_pair("duration", "s", Kind::total);
  }



  template <int dim>
  void
  ContactBooks<dim>::book(Ledger                               &ledger,
                          const std::vector<ContactPlace<dim>> &places,
                          const double                          released,
                          const double                          dt,
                          const Lattice<dim>                   &lattice) const
  {
    double area = 0., stick_area = 0., overlap = 0., friction = 0.;

    typename ResultantBooks<dim>::Sum                      sum;
    std::map<LatticeIndex<dim>, std::pair<double, double>> load_and_area;
    for (const ContactPlace<dim> &place : places)
      {
        friction += place.friction;
        overlap = std::max(overlap, -place.gap);
        if (!(place.pressure > 0.))
          continue;
        area += place.area;
        stick_area += place.sticks ? place.area : 0.;
        auto &of_cell = load_and_area[lattice.cell_of(place.at)];
        of_cell.first += place.area * place.pressure;
        of_cell.second += place.area;
        sum.add(place.at, place.force);
      }
    double pressure = 0., largest_area = 0.;
    for (const auto &[cell, sums] : load_and_area)
      largest_area = std::max(largest_area, sums.second);
    for (const auto &[cell, sums] : load_and_area)
      if (sums.second >= 0.5 * largest_area)
        pressure = std::max(pressure, sums.first / sums.second);
    ledger.book(columns.released, kept_here ? released : 0.);
    ledger.book(columns.friction, friction);
    ledger.book(columns.area, area);
    ledger.book(columns.stick_area, stick_area);
    ledger.book(columns.pressure, pressure);
    ledger.book(columns.overlap, overlap);
    ledger.book(columns.duration, area > 0. ? dt : 0.);
    resultant.book(ledger, sum);
  }



  template <int dim>
  void
  ContactBooks<dim>::book_state(Ledger &ledger, const double stored) const
  {
    ledger.book(columns.energy, kept_here ? stored : 0.);
    for (const Ledger::Index extreme : {columns.pressure, columns.overlap})
      ledger.book(extreme, 0.); // of states without a step before them
  }

  template struct ContactPlace<2>;
  template struct ContactPlace<3>;
  template class ResultantBooks<2>;
  template class ResultantBooks<3>;
  template class ContactBooks<2>;
  template class ContactBooks<3>;
} // namespace kedge
