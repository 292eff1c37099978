#include <kedge/base/expression.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_materials.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace kedge
{
  namespace
  {
    void
    require(const SectionReader &section, const std::string &entry, const std::string &model)
    {
      if (section.is_empty(entry))
        throw section.error(entry, "Model " + model + " needs it.");
    }

    /** @p factor times a constant that may depend on the place; positive, or 0 if it @p
     * may_be_zero. */
    SpatialConstant
    read_spatial(const SectionReader &section,
                 const std::string   &entry,
                 const double         factor      = 1.,
                 const bool           may_be_zero = false)
    {
      const Expression expression(section.text(entry), spatial_variables(), section.constants());
      SpatialConstant  constant(factor * expression({0., 0., 0., 0.}));
      constant.entry       = entry;
      constant.may_be_zero = may_be_zero;
      if (!expression.is_constant())
        {
          constant.expression = section.text(entry);
          constant.factor     = factor;
        }
      else if (!(constant.value > 0. || (may_be_zero && constant.value == 0.)))
        throw section.error(entry,
                            may_be_zero ? "It must not be less than 0."
                                        : "It must be greater than 0.");
      return constant;
    }

    void
    read_elasticity(const SectionReader &section, MaterialParameters &material)
    {
      const std::string young = "Young's modulus", poisson = "Poisson's ratio",
                        bulk = "Bulk modulus", shear = "Shear modulus";
      if (first_is_given(section, young, bulk))
        {
          if (!section.is_empty(shear))
            throw section.error(shear, "It stands with " + bulk + ", not with " + young + ".");
          if (section.is_empty(poisson))
            throw section.error(poisson, "It must be given with " + young + ".");
          material.young_modulus = section.number(young);
          material.poisson_ratio = section.number(poisson);
        }
      else
        {
          if (!section.is_empty(poisson))
            throw section.error(poisson, "It stands with " + young + ", not with " + bulk + ".");
          if (section.is_empty(shear))
            throw section.error(shear, "It must be given with " + bulk + ".");
          const double K = section.number(bulk), G = section.number(shear);
          material.young_modulus = 9. * K * G / (3. * K + G);
          material.poisson_ratio = (3. * K - 2. * G) / (2. * (3. * K + G));
        }
      if (!section.is_empty("Initial porosity"))
        material.initial_porosity = section.number("Initial porosity");
    }

    /** Refuses entries of other models. */
    void
    refuse(const SectionReader            &section,
           const std::vector<std::string> &entries,
           const std::string              &models)
    {
      for (const std::string &entry : entries)
        if (!section.is_empty(entry))
          throw section.error(entry, "It belongs to " + models + ".");
    }

    /** Tresca's and von Mises' clays; true if it is one. */
    bool
    read_undrained_strength(const SectionReader &section, MaterialParameters &material)
    {
      const std::string strength = "Undrained strength", model = section.text("Model");
      const bool        is_tresca = model == "tresca";
      if (is_tresca)
        require(section, strength, model);
      if (!is_tresca && (model != "von_mises" || section.is_empty(strength)))
        {
          refuse(section,
                 {strength, "Softening cell size", "Reference shear rate"},
                 "models tresca and von_mises, with Undrained strength");
          if (section.number("Rate coefficient") != 0.)
            throw section.error("Rate coefficient", "It belongs to Undrained strength.");
          if (section.number("Remoulded strength ratio") != 1.)
            throw section.error("Remoulded strength ratio", "It belongs to Undrained strength.");
          return false;
        }
      for (const std::string entry : {"Yield radius rho_y", "Uniaxial yield stress sigma_y"})
        if (!section.is_empty(entry))
          throw section.error(entry, "Only one of it and Undrained strength may be given.");
      if (section.number("Hardening modulus") != 0.)
        throw section.error("Hardening modulus",
                            "With Undrained strength the material may soften, not harden.");
      material.kind = is_tresca ? MaterialKind::tresca : MaterialKind::undrained_von_mises;
      material.undrained_strength = read_spatial(section, strength);
      material.remoulded_strength = section.number("Remoulded strength ratio");
      material.softening_strain   = section.number("Softening shear strain");
      if (!section.is_empty("Softening cell size"))
        material.softening_cell_size = section.number("Softening cell size");
      material.rate_coefficient = section.number("Rate coefficient");
      if (material.rate_coefficient > 0.)
        require(section, "Reference shear rate", "with a Rate coefficient");
      else
        refuse(section, {"Reference shear rate"}, "a Rate coefficient");
      if (material.rate_coefficient > 0.)
        material.reference_rate = section.number("Reference shear rate");
      return true;
    }

    void
    read_von_mises(const SectionReader &section, MaterialParameters &material)
    {
      if (read_undrained_strength(section, material))
        return;
      const std::string radius = "Yield radius rho_y", uniaxial = "Uniaxial yield stress sigma_y";
      if (section.text("Model") != "von_mises")
        {
          for (const auto &entry : {radius, uniaxial})
            if (!section.is_empty(entry))
              throw section.error(entry,
                                  "Model " + section.text("Model") +
                                    " does not yield so; did you mean von_mises?");
          if (section.number("Hardening modulus") != 0.)
            throw section.error("Hardening modulus",
                                "Model " + section.text("Model") +
                                  " does not harden; did you mean von_mises?");
          return;
        }
      material.kind              = MaterialKind::von_mises;
      material.yield_stress      = first_is_given(section, radius, uniaxial)
                                     ? read_spatial(section, radius, std::sqrt(1.5))
                                     : read_spatial(section, uniaxial);
      material.hardening_modulus = section.number("Hardening modulus");
    }

    void
    read_friction(const SectionReader &section, MaterialParameters &material)
    {
      const std::string cohesion = "Cohesion", friction = "Friction angle",
                        dilation = "Dilation angle", cut_off = "Tension cut-off",
                        stiffness = "Stiffness factor", model = section.text("Model");
      if (model != "drucker_prager" && model != "mohr_coulomb")
        {
          refuse(section,
                 {cohesion, friction, cut_off, stiffness},
                 "models drucker_prager and mohr_coulomb");
          if (section.number(dilation) != 0.)
            throw section.error(dilation, "It belongs to models drucker_prager and mohr_coulomb.");
          return;
        }
      static const std::map<std::string, ConeMatch> matches = {
        {"plane strain", ConeMatch::plane_strain},
        {"compression", ConeMatch::compression},
        {"extension", ConeMatch::extension}};
      const bool is_cone = model == "drucker_prager";
      require(section, cohesion, model);
      require(section, friction, model);
      material.kind     = is_cone ? MaterialKind::drucker_prager : MaterialKind::mohr_coulomb;
      material.cohesion = read_spatial(section, cohesion, 1., true);
      if (!section.is_empty(stiffness))
        material.stiffness_factor = read_spatial(section, stiffness);
      material.friction_angle = section.number(friction);
      material.dilation_angle = section.number(dilation);
      material.cone_match     = matches.at(section.text("Cone match"));
      if (is_cone)
        material.apex_rounding = section.number("Apex rounding");
      material.tension_cut_off = !section.is_empty(cut_off) ? section.number(cut_off)
                                 : is_cone                  ? 0.8
                                                            : 1.;
      if (material.dilation_angle > material.friction_angle)
        throw section.error(dilation,
                            "It must not be larger than the angle of friction, " +
                              section.text(friction) +
                              ": such a soil would make energy as it flows.");
    }

    /** Moduli and slopes of modified_cam_clay; true if it is one. */
    bool
    read_cam_clay(const SectionReader &section, MaterialParameters &material)
    {
      const std::string swelling = "Swelling slope", compression = "Compression slope",
                        void_ratio = "Initial void ratio", pressure = "Preconsolidation pressure",
                        slope = "Critical state slope", shear = "Shear modulus",
                        ratio = "Overconsolidation ratio", model = "modified_cam_clay";
      if (section.text("Model") != model)
        {
          refuse(section, {swelling, compression, void_ratio, ratio}, "model " + model);
          return false;
        }
      for (const std::string &entry : {swelling, compression, void_ratio, slope, shear})
        require(section, entry, model);
      material.preconsolidation_by_ratio = !first_is_given(section, pressure, ratio);
      refuse(section,
             {"Young's modulus", "Poisson's ratio", "Bulk modulus"},
             "models of a constant bulk modulus; that of " + model + " is p'/kappa");
      refuse(section, {"Surface alpha", "Surface gamma"}, "model critical_state");
      constexpr double some_ratio   = 0.3; // of Poisson: the pair stands for the shear modulus
      material.kind                 = MaterialKind::modified_cam_clay;
      material.poisson_ratio        = some_ratio;
      material.young_modulus        = 2. * (1. + some_ratio) * section.number(shear);
      material.swelling_slope       = section.number(swelling);
      material.compression_slope    = section.number(compression);
      material.initial_void_ratio   = section.number(void_ratio);
      material.critical_state_ratio = section.number(slope);
      material.reference_pressure   = section.number("Reference pressure");
      material.start_preconsolidation_pressure =
        read_spatial(section, material.preconsolidation_by_ratio ? ratio : pressure);
      if (!(material.compression_slope > material.swelling_slope))
        throw section.error(compression, "It must be larger than Swelling slope.");
      const double porosity = material.initial_void_ratio / (1. + material.initial_void_ratio);
      material.initial_porosity =
        section.is_empty("Initial porosity") ? porosity : section.number("Initial porosity");
      if (std::abs(material.initial_porosity - porosity) > 1e-3)
        throw section.error("Initial porosity",
                            "It is not e_0/(1 + e_0) of Initial void ratio; leave it out.");
      return true;
    }

    void
    read_critical_state(const SectionReader &section, MaterialParameters &material)
    {
      if (material.kind == MaterialKind::modified_cam_clay)
        return;
      const std::string pressure = "Preconsolidation pressure", slope = "Critical state slope",
                        alpha = "Surface alpha", gamma = "Surface gamma";
      if (section.text("Model") != "critical_state")
        {
          for (const auto &entry : {pressure, slope, alpha, gamma})
            if (!section.is_empty(entry))
              throw section.error(entry, "It belongs to model critical_state.");
          return;
        }
      for (const auto &entry : {pressure, slope, alpha, gamma})
        require(section, entry, "critical_state");
      const bool improved = section.text("Elasticity") == "improved_hencky";
      material.kind =
        improved ? MaterialKind::critical_state_improved : MaterialKind::critical_state;
      const SpatialConstant p_c = read_spatial(section, pressure);
      if (!p_c.expression.empty())
        throw section.error(pressure, "Of critical_state it is the same everywhere.");
      material.preconsolidation_pressure = p_c.value;
      material.critical_state_slope      = section.number(slope);
      material.surface_alpha             = section.number(alpha);
      material.surface_gamma             = section.number(gamma);
      if (section.text("Frozen energy") == "none")
        material.frozen_energy = FrozenEnergy::none;
    }

    /** What holds for all models whose stress depends on their pores. */
    void
    check_soil(const SectionReader &section, const MaterialParameters &material)
    {
      if (material.kind == MaterialKind::improved_hencky ||
          material.kind == MaterialKind::critical_state_improved)
        require(section, "Initial porosity", "improved_hencky");
      if (material.volume_change == VolumeChange::cell_mean &&
          material.kind != MaterialKind::hencky && material.kind != MaterialKind::von_mises &&
          material.kind != MaterialKind::tresca &&
          material.kind != MaterialKind::undrained_von_mises)
        throw section.error("Volume change",
                            "Soils know but pointwise changes of volume; their pressure depends on "
                            "more than the mean one.");
    }
  } // namespace



  std::vector<MaterialParameters>
  read_materials(const ParameterReader &reader)
  {
    std::vector<MaterialParameters> materials;
    for (const std::string &name : reader.names("Materials"))
      {
        const SectionReader section(reader, {"Materials", name});
        MaterialParameters  material;
        material.name      = section.name();
        material.density   = section.number("Density");
        material.viscosity = section.number("Viscosity");
        if (section.text("Volume change") == "cell mean")
          material.volume_change = VolumeChange::cell_mean;
        if (section.text("Model") == "improved_hencky")
          material.kind = MaterialKind::improved_hencky;
        if (!read_cam_clay(section, material))
          read_elasticity(section, material);
        read_von_mises(section, material);
        read_friction(section, material);
        read_critical_state(section, material);
        check_soil(section, material);
        materials.push_back(material);
      }
    return materials;
  }



  namespace
  {
    constexpr double radians_per_degree = 3.14159265358979323846 / 180.;

    void
    divide(SpatialConstant &constant, const double by)
    {
      constant.value /= by;
      constant.factor /= by;
    }
  } // namespace



  void
  reduce_strength(const ParameterReader &reader, std::vector<MaterialParameters> &materials)
  {
    const SectionReader section(reader, {});
    const double        F = section.number("Strength reduction");
    if (F == 1.)
      return;
    for (MaterialParameters &material : materials)
      switch (material.kind)
        {
          case MaterialKind::hencky:
          case MaterialKind::improved_hencky:
            break;
          case MaterialKind::von_mises:
            divide(material.yield_stress, F);
            material.hardening_modulus /= F;
            break;
          case MaterialKind::tresca:
          case MaterialKind::undrained_von_mises:
            divide(material.undrained_strength, F);
            break;
          case MaterialKind::drucker_prager:
          case MaterialKind::mohr_coulomb:
            divide(material.cohesion, F);
            material.friction_angle =
              std::atan(std::tan(material.friction_angle * radians_per_degree) / F) /
              radians_per_degree;
            material.dilation_angle = std::min(material.dilation_angle, material.friction_angle);
            break;
          default:
            throw section.error("Strength reduction",
                                "The strength of Materials/" + material.name +
                                  " follows from its pressure and its past; only cohesion, angles "
                                  "of friction, undrained strengths and yield stresses can be "
                                  "reduced.");
        }
  }



  void
  scale_softening(const double cell_size, std::vector<MaterialParameters> &materials)
  {
    for (MaterialParameters &material : materials)
      if (material.softening_cell_size > 0.)
        material.softening_strain *= material.softening_cell_size / cell_size;
  }
} // namespace kedge
