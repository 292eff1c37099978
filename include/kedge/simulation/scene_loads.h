#ifndef kedge_simulation_scene_loads_h
#define kedge_simulation_scene_loads_h

#include <kedge/base/expression.h>
#include <kedge/scene/scene.h>

#include <string>
#include <vector>

namespace kedge
{
  /**
   * Loads, prescribed displacements and pressures of a scene that are functions of time alone,
   * by name.
   */
  class SceneLoads
  {
  public:
    template <int dim>
    explicit SceneLoads(const Scene<dim> &scene);

    /** The names of those that are no finite number at @p t, with the value; else empty. */
    std::string
    not_finite_at(const double t) const;

    /**
     * How large those that change with time are at @p t, as a part of what they are at
     * @p end: "Tractions/lid 0.83, Body force 0.5", with or without displacements of supports.
     * Empty if nothing changes.
     */
    std::string
    factors_at(const double t, const double end, const bool with_supports = true) const;

  private:
    struct Load
    {
      std::string             name;
      std::vector<Expression> components;
      bool                    is_support; ///< a displacement that is given, no load
    };

    void
    add(const std::string                   &name,
        const std::vector<std::string>      &texts,
        const std::map<std::string, double> &constants,
        const bool                           is_support = false);

    std::vector<Load> loads;
  };
} // namespace kedge

#endif
