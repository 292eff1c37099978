#ifndef kedge_stress_single_point_h
#define kedge_stress_single_point_h

#include <kedge/base/expression.h>
#include <kedge/materials/material.h>
#include <kedge/stress/parameters.h>
#include <kedge/stress/point_update.h>

namespace kedge
{
  /**
   * One material point without a body, a grid or inertia: it follows a given
   * deformation through the same update as the points of a run, so that a
   * material can be studied and tested alone. Use:
   * @code
   *   SinglePoint point(parameters);
   *   for (double t = dt; t < end; t += dt)
   *     if (point.deform_to(F(t)))
   *       std::cout << point.state().kirchhoff_stress << std::endl;
   * @endcode
   */
  class SinglePoint
  {
  public:
    /** The history at the end of the last step; at the start undeformed and free of stress. */
    struct State
    {
      dealii::Tensor<2, 3>          deformation_gradient;    ///< F
      dealii::Tensor<2, 3>          elastic_frame;           ///< B, B B^T = b^e
      dealii::SymmetricTensor<2, 3> kirchhoff_stress;        ///< tau [Pa]
      double                        strain_energy       = 0; ///< per V0 [J/m^3]
      double                        hardening_energy    = 0; ///< per V0 [J/m^3]
      double                        plastic_dissipation = 0; ///< so far, per V0 [J/m^3]
      std::vector<double>           history;                 ///< in the columns of the law

      /** tau / det F [Pa] */
      dealii::SymmetricTensor<2, 3>
      cauchy_stress() const;
    };

    /** @p history in the columns of the law at the start. */
    SinglePoint(const Material &material, const std::vector<double> &history);

    /**
     * A point of a material of these parameters, with the constants of place X = 0,
     * that bears an isotropic @p pressure [Pa] undeformed; 0 is none, or the reference
     * pressure of modified_cam_clay.
     *
     * @throws UserError if it cannot
     */
    explicit SinglePoint(const MaterialParameters &parameters, const double pressure = 0.);

    /**
     * What a step from the present state to the deformation gradient @p F
     * would lead to; nothing is changed. Controls that prescribe stresses
     * iterate on it.
     *
     * @return false if det F or an elastic stretch would not be positive, or
     * the material has no answer
     */
    bool
    evaluate(const dealii::Tensor<2, 3> &F, PointUpdate<3> &update) const;

    /** Makes a result of evaluate() the present state. */
    void
    accept(const PointUpdate<3> &update);

    /** How long the next steps are, for laws that depend on the rate [s]; 0, as at the start: they
     * are slow. */
    void
    set_time_step(const double dt)
    {
      time_step = dt;
    }

    /** evaluate() and, if it can be done, accept(). */
    bool
    deform_to(const dealii::Tensor<2, 3> &F);

    const State &
    state() const
    {
      return present;
    }

    /** A number of the history by the name of its column; 0 if the law has none of that name. */
    double
    column(const std::string &name) const;

  private:
    Material material;
    State    present;
    double   time_step = 0.; ///< [s]
  };

  /** The deformation gradient of a path as a function of time. */
  class StrainPath
  {
  public:
    /** @throws UserError for expressions that cannot be read and for F(0) other than I. */
    StrainPath(const PathParameters &parameters, const std::map<std::string, double> &constants);

    /** F(t), or diag(exp(eps_x), exp(eps_y), exp(eps_z)). */
    dealii::Tensor<2, 3>
    deformation_gradient(const double t) const;

  private:
    bool                    by_strain;
    std::vector<Expression> expressions;
  };
} // namespace kedge

#endif
