#include <kedge/materials/parameters.h>
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

    /** A part of 1, 0 included. */
    NumberRange
    part(const bool includes_one)
    {
      NumberRange result    = range(0, 1, includes_one);
      result.includes_lower = true;
      return result;
    }

    /** Two moduli, in one of two ways, and the pores. */
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
               "n_0, volume of the pores over that of the undeformed body, of soils [-]."},
              {"Hydraulic conductivity",
               "",
               positive,
               "Of saturated soil at the initial porosity, kappa_0; nothing: that of the Pore "
               "fluid [m/s]."},
              {"Conductivity law",
               "",
               allow.one_of({"constant", "kozeny-carman"}).or_empty(),
               "Of saturated soil; nothing: that of the Pore fluid."}};
    }

    template <int dim>
    std::vector<EntryDeclaration>
    plasticity(const ValuePatterns<dim> &allow)
    {
      const auto of_place = allow.expression(spatial_variables(), "x, y, z, depth").or_empty();
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
    undrained_strength(const ValuePatterns<dim> &allow)
    {
      return {
        {"Undrained strength",
         "",
         allow.expression(spatial_variables(), "x, y, z, depth").or_empty(),
         "tresca, von_mises: s_u, half the largest difference of principal stresses, in "
         "simple shear and plane strain, of the place where a point is at the start [Pa]."},
        {"Remoulded strength ratio",
         "1",
         allow.number(range(0, 1, true)),
         "With Undrained strength: what softening leaves of it, 1/sensitivity; 1: no "
         "softening [-]."},
        {"Softening shear strain",
         "10",
         allow.number(NumberRange::positive()),
         "With Undrained strength: xi_95, plastic shear strain at which 95 % of the loss "
         "is reached [-]."},
        {"Softening cell size",
         "",
         allow.number(NumberRange::positive()).or_empty(),
         "With Undrained strength: the grid's cell size in x for which Softening shear strain "
         "holds; on another it is scaled by the inverse of the sizes, for a shear band is as "
         "wide as some cells [m]. Nothing: no scaling."},
        {"Rate coefficient",
         "0",
         allow.number(NumberRange::not_negative()),
         "With Undrained strength: mu, by which part of it s_u grows with each decade of the rate "
         "of plastic shear strain above the next entry, 0.05 to 0.2 of clay [-]; 0: none."},
        {"Reference shear rate",
         "",
         allow.number(NumberRange::positive()).or_empty(),
         "With a Rate coefficient: the rate of plastic shear strain, in simple shear that of gamma, "
         "up to which s_u is that given [1/s]."}};
    }

    template <int dim>
    std::vector<EntryDeclaration>
    friction(const ValuePatterns<dim> &allow)
    {
      return {{"Cohesion",
               "",
               allow.expression(spatial_variables(), "x, y, z, depth").or_empty(),
               "drucker_prager, mohr_coulomb: c, of the place where a point is at the start [Pa]."},
              {"Stiffness factor",
               "",
               allow.expression(spatial_variables(), "x, y, z, depth").or_empty(),
               "drucker_prager, mohr_coulomb: by which both moduli are multiplied, of the place "
               "where a point is at the start, such as sqrt(depth/10) [-]; nothing: 1."},
              {"Friction angle",
               "",
               allow.number(range(0, 90, false)).or_empty(),
               "drucker_prager, mohr_coulomb: phi [deg]."},
              {"Dilation angle",
               "0",
               allow.number(NumberRange::not_negative()),
               "drucker_prager, mohr_coulomb: psi, at most phi [deg]."},
              {"Cone match",
               "plane strain",
               allow.one_of({"plane strain", "compression", "extension"}),
               "drucker_prager: where its cone bears what Mohr and Coulomb's law does: in plane "
               "strain, triaxial compression or extension."},
              {"Apex rounding",
               "0.1",
               allow.number(part(false)),
               "drucker_prager: e/k, by which its apex is rounded [-]."},
              {"Tension cut-off",
               "",
               allow.number(part(true)).or_empty(),
               "drucker_prager, mohr_coulomb: largest tension, mean or principal, over that of the "
               "apex [-]; nothing: 0.8, or 1 of mohr_coulomb."}};
    }

    template <int dim>
    std::vector<EntryDeclaration>
    cam_clay(const ValuePatterns<dim> &allow)
    {
      const auto positive = allow.number(NumberRange::positive()).or_empty();
      return {
        {"Swelling slope",
         "",
         positive,
         "modified_cam_clay: kappa, fall of the void ratio with ln p' in swelling [-]."},
        {"Compression slope",
         "",
         positive,
         "modified_cam_clay: lambda, the same in virgin compression [-]."},
        {"Initial void ratio", "", positive, "modified_cam_clay: e_0 of the undeformed soil [-]."},
        {"Overconsolidation ratio",
         "",
         allow.expression(spatial_variables(), "x, y, z, depth").or_empty(),
         "modified_cam_clay, instead of Preconsolidation pressure: p_c over that of the yield "
         "surface through the Initial stress, which is 1 of a normally consolidated soil; of the "
         "place [-]."},
        {"Reference pressure",
         "1e3",
         allow.number(NumberRange::positive()),
         "modified_cam_clay: p', Kirchhoff's, at which its elastic strain counts as 0 [Pa]."}};
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
               allow.expression(spatial_variables(), "x, y, z, depth").or_empty(),
               "critical_state, modified_cam_clay: p_c, up to which pressure is elastic [Pa]. Of "
               "critical_state a number, which does not harden; of modified_cam_clay that at the "
               "start, of the place."},
              {"Critical state slope",
               "",
               positive,
               "Where the material flows at constant volume: of critical_state M = ||s||/p', so "
               "that q/p' is sqrt(3/2) M; of modified_cam_clay M = q/p' [-]."},
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
        allow.one_of({"hencky",
                      "von_mises",
                      "improved_hencky",
                      "critical_state",
                      "tresca",
                      "drucker_prager",
                      "mohr_coulomb",
                      "modified_cam_clay"}),
        "hencky: Kirchhoff stress linear in the logarithmic strain. von_mises: that, with "
        "associated plastic flow at a yield stress that hardens linearly. improved_hencky: soil "
        "that stiffens as its pores close and never closes them. critical_state: soil that yields "
        "by the family of Collins and Hilder. tresca: clay sheared undrained. drucker_prager, "
        "mohr_coulomb: soil with friction. modified_cam_clay: clay that hardens as it is "
        "compressed."},
       {"Density",
        std::nullopt,
        allow.number(NumberRange::positive()),
        "Mass per volume of the undeformed body [kg/m^3]."},
       {"Volume change",
        "pointwise",
        allow.one_of({"pointwise", "cell mean"}),
        "Whose gives the pressure: a point's own, or the mean in a cell: does not lock. hencky, "
        "von_mises and tresca."},
       {"Viscosity",
        "0",
        allow.number(NumberRange::not_negative()),
        "eta of a dashpot beside the material, which damps: its stress is 2 eta times the rate of "
        "strain [Pa s]; of dry bodies. Its work is booked as viscous_dissipation."}}};
    for (const auto &entries : {elasticity(allow),
                                plasticity(allow),
                                undrained_strength(allow),
                                friction(allow),
                                critical_state(allow),
                                cam_clay(allow)})
      section.entries.insert(section.entries.end(), entries.begin(), entries.end());
    return section;
  }

  template SectionDeclaration
  declare_materials(const ValuePatterns<2> &);
  template SectionDeclaration
  declare_materials(const ValuePatterns<3> &);
} // namespace kedge
