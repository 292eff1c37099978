#include <kedge/base/expression.h>
#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_materials.h>

#include <cmath>

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

    /** @p factor times a constant that may depend on the place; it must be positive. */
    SpatialConstant
    read_spatial(const SectionReader &section, const std::string &entry, const double factor = 1.)
    {
      const Expression expression(section.text(entry), {"x", "y", "z"}, section.constants());
      SpatialConstant  constant(factor * expression({0., 0., 0.}));
      constant.entry = entry;
      if (!expression.is_constant())
        {
          constant.expression = section.text(entry);
          constant.factor     = factor;
        }
      else if (!(constant.value > 0.))
        throw section.error(entry, "It must be greater than 0.");
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

    void
    read_von_mises(const SectionReader &section, MaterialParameters &material)
    {
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
    read_critical_state(const SectionReader &section, MaterialParameters &material)
    {
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
      material.preconsolidation_pressure = section.number(pressure);
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
          material.kind != MaterialKind::hencky && material.kind != MaterialKind::von_mises)
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
        material.name    = section.name();
        material.density = section.number("Density");
        if (section.text("Volume change") == "cell mean")
          material.volume_change = VolumeChange::cell_mean;
        if (section.text("Model") == "improved_hencky")
          material.kind = MaterialKind::improved_hencky;
        read_elasticity(section, material);
        read_von_mises(section, material);
        read_critical_state(section, material);
        check_soil(section, material);
        materials.push_back(material);
      }
    return materials;
  }
} // namespace kedge
