#include <kedge/scene/material_declarations.h>

namespace kedge
{
  namespace
  {
    /** A range with both ends excluded, or the upper one included. */
    NumberRange
    range(const double lower, const double upper, const bool includes_upper)
    {
      NumberRange result;
      result.lower          = lower;
      result.upper          = upper;
      result.includes_lower = false;
      result.includes_upper = includes_upper;
      return result;
    }

    /** Two moduli, in one of two ways, and the porosity. */
    template <int dim>
    std::vector<EntryDeclaration>
    elasticity(const ValuePatterns<dim> &allow)
    {
      const auto positive = allow.number(NumberRange::positive()).or_empty();
      return {{"Young's modulus",
               "",
               positive,
               "Stiffness in tension, E [Pa]. With Poisson's ratio; or Bulk and Shear modulus."},
              {"Poisson's ratio",
               "",
               allow.number(range(-1, 0.5, false)).or_empty(),
               "Lateral contraction over extension, nu [-]."},
              {"Bulk modulus",
               "",
               positive,
               "K of the undeformed material [Pa]; of improved_hencky it is K~/n_0."},
              {"Shear modulus", "", positive, "G [Pa]."},
              {"Initial porosity",
               "",
               allow.number(range(0, 1, false)).or_empty(),
               "n_0, volume of the pores over that of the undeformed body, of soils [-]."}};
    }

    template <int dim>
    std::vector<EntryDeclaration>
    plasticity(const ValuePatterns<dim> &allow)
    {
      const auto of_place = allow.expression({"x", "y", "z"}, "x, y, z").or_empty();
      return {
        {"Yield radius rho_y",
         "",
         of_place,
         "von_mises: ||s|| at which the material yields, of the place where a point is at the "
         "start [Pa]. Either this or the next."},
        {"Uniaxial yield stress sigma_y",
         "",
         of_place,
         "von_mises: stress at which a bar in tension yields, sqrt(3/2) rho_y [Pa]."},
        {"Hardening modulus",
         "0",
         allow.number(NumberRange::not_negative()),
         "von_mises: growth of sigma_y with the equivalent plastic strain, H [Pa]; 0 is "
         "perfect plasticity."}};
    }

    template <int dim>
    std::vector<EntryDeclaration>
    critical_state(const ValuePatterns<dim> &allow)
    {
      const auto positive = allow.number(NumberRange::positive()).or_empty();
      const auto part     = allow.number(range(0, 1, true)).or_empty();
      return {{"Elasticity",
               "improved_hencky",
               allow.one_of({"improved_hencky", "hencky"}),
               "critical_state: its elastic law."},
              {"Preconsolidation pressure",
               "",
               positive,
               "critical_state: p_c, up to which pressure is elastic; does not harden [Pa]."},
              {"Critical state slope",
               "",
               positive,
               "critical_state: M, ||s|| over the effective pressure where the material flows at "
               "constant volume; q/p' there is sqrt(3/2) M [-]."},
              {"Surface alpha", "", part, "critical_state: alpha; 1 is Modified Cam Clay [-]."},
              {"Surface gamma",
               "",
               part,
               "critical_state: gamma; 1 puts the critical state at p_c/2 [-]."},
              {"Frozen energy",
               "centred",
               allow.one_of({"centred", "none"}),
               "critical_state: stored by plastic changes of volume. centred: what puts the "
               "critical state under pressure; none: as printed in the thesis."}};
    }
  } // namespace



  template <int dim>
  SectionDeclaration
  declare_materials(const ValuePatterns<dim> &allow)
  {
    SectionDeclaration section = {
      "Materials",
      "Constitutive laws; bodies name the one that they are made of. Of saturated soils they give "
      "the effective stress.",
      SectionKind::named,
      {{"Model",
        "hencky",
        allow.one_of({"hencky", "von_mises", "improved_hencky", "critical_state"}),
        "hencky: Kirchhoff stress linear in the logarithmic strain. von_mises: that, with "
        "associated plastic flow at a yield stress that hardens linearly. improved_hencky: soil "
        "that stiffens as its pores close and never closes them. critical_state: soil that yields "
        "by the family of Collins and Hilder."},
       {"Density",
        std::nullopt,
        allow.number(NumberRange::positive()),
        "Mass per volume of the undeformed body [kg/m^3]."},
       {"Volume change",
        "pointwise",
        allow.one_of({"pointwise", "cell mean"}),
        "Whose gives the pressure: a point's own, or the mean in a cell: does not lock. hencky and "
        "von_mises."}}};
    for (const auto &entries : {elasticity(allow), plasticity(allow), critical_state(allow)})
      section.entries.insert(section.entries.end(), entries.begin(), entries.end());
    return section;
  }

  template SectionDeclaration
  declare_materials(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_materials(const ValuePatterns<3> &);
} // namespace kedge
