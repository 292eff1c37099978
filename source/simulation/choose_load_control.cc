// The term of a scene whose loads are found.
#include <kedge/base/exceptions.h>
#include <kedge/simulation/model.h>
#include <kedge/solid/load_control_term.h>

#include <algorithm>

namespace kedge
{
  template <int dim>
  void
  Model<dim>::choose_load_control()
  {
    const auto &names   = bodies.names;
    const auto &control = *scene.load_control;
    const auto  found   = std::find(names.begin(), names.end(), control.body);
    if (found == names.end())
      throw UserError("Load control/Body = " + control.body +
                      ": Its pieces are bodies of their own (Pieces = apart).");
    const auto   body  = static_cast<unsigned int>(found - names.begin());
    const double h     = points.grid().lattice().smallest_cell_size();
    const double stiff = p_wave_modulus(bodies.materials[body]) * (dim == 3 ? h : 1.);
    terms.push_back(std::make_unique<LoadControlTerm<dim>>(control,
                                                           scene.constants,
                                                           names,
                                                           bodies.field[body],
                                                           fields[bodies.field[body]]->patch,
                                                           stiff,
                                                           scene.time.start,
                                                           load_terms));
  }

  template void
  Model<2>::choose_load_control();
  template void
  Model<3>::choose_load_control();
} // namespace kedge
