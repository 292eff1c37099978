#include <kedge/scene/cross_checks.h>
#include <kedge/scene/read_materials.h>

#include <cmath>

namespace kedge
{
  namespace
  {
    void
    read_plasticity(const SectionReader &section, MaterialParameters &material)
    {
      const std::string radius = "Yield radius rho_y", uniaxial = "Uniaxial yield stress sigma_y";
      if (section.text("Model") == "hencky")
        {
          for (const auto &entry : {radius, uniaxial})
            if (!section.is_empty(entry))
              throw section.error(entry, "Model hencky does not yield; did you mean von_mises?");
          if (section.number("Hardening modulus") != 0.)
            throw section.error("Hardening modulus",
                                "Model hencky does not harden; did you mean von_mises?");
          return;
        }
      material.kind              = MaterialKind::von_mises;
      material.yield_stress      = first_is_given(section, radius, uniaxial)
                                     ? std::sqrt(1.5) * section.number(radius)
                                     : section.number(uniaxial);
      material.hardening_modulus = section.number("Hardening modulus");
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
        material.name          = section.name();
        material.density       = section.number("Density");
        material.young_modulus = section.number("Young's modulus");
        material.poisson_ratio = section.number("Poisson's ratio");
        if (section.text("Volume change") == "cell mean")
          material.volume_change = VolumeChange::cell_mean;
        read_plasticity(section, material);
        materials.push_back(material);
      }
    return materials;
  }
} // namespace kedge
