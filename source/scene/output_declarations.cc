#include <kedge/base/expression.h>
#include <kedge/scene/output_declarations.h>

namespace kedge
{
  template <int dim>
  SectionDeclaration
  declare_output(const ValuePatterns<dim> &allow)
  {
    const NumberRange at_least_zero = NumberRange::not_negative();
    return {
      "Output",
      "What is written, and how often.",
      SectionKind::plain,
      {{"Points interval",
        "",
        allow.number(at_least_zero).or_empty(),
        "Simulated time between pictures of the material points [s]; 0: none; empty: a "
        "fiftieth of the simulated time, unless Points every steps is given."},
       {"Points every steps",
        "0",
        allow.whole_number(0),
        "Steps between pictures of the material points [-]; 0: does not count."},
       {"Fields",
        "displacement, velocity, cauchy_stress, pressure, von_mises_stress, det_F, volume, body",
        allow
          .list_of(
            split_list("position, displacement, velocity, acceleration, deformation_gradient, "
                       "det_F, half_lengths, kirchhoff_stress, cauchy_stress, pressure, "
                       "von_mises_stress, strain_energy, kinetic_energy, mass, volume, body, "
                       "id, equivalent_plastic_strain, yield_stress, plastic_volume_strain, "
                       "plastic_shear_strain, undrained_strength, cohesion, stiffness, "
                       "preconsolidation_pressure, opening, plastic_dissipation, pore_pressure, "
                       "porosity, darcy_velocity, total_stress"))
          .or_empty(),
        "What the pictures hold."},
       {"Formats",
        "vtu",
        allow.list_of({"vtu", "hdf5"}).or_empty(),
        "vtu: points.pvd for ParaView. hdf5: HDF5 with XDMF."},
       {"Grid",
        "false",
        allow.truth(),
        "Whether the cells in use are written too, as grid.pvd, with the Fields as means at "
        "the nodes: smooth where those of the points speckle."},
       {"Checkpoint every steps",
        "0",
        allow.whole_number(0),
        "Steps between checkpoints [-]; 0: does not count."},
       {"Checkpoint interval",
        "600",
        allow.number(at_least_zero),
        "Wall time between checkpoints [s]; 0: does not count."},
       {"Progress interval",
        "1",
        allow.number(at_least_zero),
        "Wall time between lines on the screen [s]; 0: a line per step."}}};
  }

  template SectionDeclaration
  declare_output(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_output(const ValuePatterns<3> &);
} // namespace kedge
