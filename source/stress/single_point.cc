#include <kedge/base/exceptions.h>
#include <kedge/materials/initial_strain.h>
#include <kedge/stress/single_point.h>

namespace kedge
{
  namespace
  {
    /** How far F(0) may be from the identity. */
    constexpr double start_tolerance = 1e-12;
  } // namespace



  dealii::SymmetricTensor<2, 3>
  SinglePoint::State::cauchy_stress() const
  {
    return kirchhoff_stress / determinant(deformation_gradient);
  }



  SinglePoint::SinglePoint(const Material &material, const std::vector<double> &history)
    : material(material)
  {
    AssertDimension(history.size(), columns_of(material).size());
    present.history              = history;
    present.deformation_gradient = dealii::unit_symmetric_tensor<3>();
    present.elastic_frame        = dealii::unit_symmetric_tensor<3>();
  }



  SinglePoint::SinglePoint(const MaterialParameters &parameters, const double pressure)
    : SinglePoint(make_material(parameters), start_history(make_material(parameters), parameters))
  {
    const double borne = pressure > 0. ? pressure : parameters.reference_pressure;
    if (!(borne > 0.))
      return;
    const auto start = initial_state(material, {{-borne, -borne, -borne}}, present.history);
    if (start.returned > 0.)
      throw UserError("it lies beyond the yield surface");
    const auto &strain = start.strain;
    present.history    = start.history;
    for (int i = 0; i < 3; ++i)
      {
        present.elastic_frame[i][i]    = std::exp(strain[i]);
        present.kirchhoff_stress[i][i] = -borne;
      }
    const double values[3] = {strain[0], strain[1], strain[2]};
    std::visit(
      [&](const auto &law) {
        using Law             = std::decay_t<decltype(law)>;
        const auto history    = read_history<Law>(present.history.data());
        present.strain_energy = law.energy(values, history);
        if constexpr (Law::yields)
          present.hardening_energy = law.hardening_energy(history);
      },
      material);
  }



  double
  SinglePoint::column(const std::string &name) const
  {
    const std::vector<Column> columns = columns_of(material);
    for (unsigned int c = 0; c < columns.size(); ++c)
      if (columns[c].name == name)
        return present.history[c];
    return 0.;
  }



  bool
  SinglePoint::evaluate(const dealii::Tensor<2, 3> &F, PointUpdate<3> &update) const
  {
    // A = dF - I without cancellation
    const dealii::Tensor<2, 3> gradient =
      (F - present.deformation_gradient) * invert(present.deformation_gradient);
    double A[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        A[i][j] = gradient[i][j];

    const StressState<3> stress_state =
      make_stress_state<3>(present.elastic_frame, 1., present.kirchhoff_stress);
    std::vector<double> history = present.history;
    const auto          columns = columns_of(material);
    for (unsigned int c = 0; c < columns.size(); ++c)
      if (columns[c].kind == ColumnKind::volume_strain)
        history[c] = std::log(determinant(present.deformation_gradient));
      else if (columns[c].kind == ColumnKind::time_step)
        history[c] = time_step;
    return std::visit(
      [&](const auto &law) {
        using Law = std::decay_t<decltype(law)>;
        return update_point<3>(law, stress_state, read_history<Law>(history.data()), A, update);
      },
      material);
  }



  void
  SinglePoint::accept(const PointUpdate<3> &update)
  {
    dealii::Tensor<2, 3> dF;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          dF[i][j]                    = (i == j ? 1. : 0.) + update.relative_gradient[i][j];
          present.elastic_frame[i][j] = update.elastic_frame[i][j];
          if (i <= j)
            present.kirchhoff_stress[i][j] = update.kirchhoff_stress[symmetric_index<3>(i, j)];
        }
    present.deformation_gradient = dF * present.deformation_gradient;
    present.strain_energy        = update.strain_energy;
    present.hardening_energy     = update.hardening_energy;
    present.plastic_dissipation += update.dissipation;
    std::copy_n(update.history, present.history.size(), present.history.begin());
  }



  bool
  SinglePoint::deform_to(const dealii::Tensor<2, 3> &F)
  {
    PointUpdate<3> update;
    if (!evaluate(F, update))
      return false;
    accept(update);
    return true;
  }



  StrainPath::StrainPath(const PathParameters                &parameters,
                         const std::map<std::string, double> &constants)
    : by_strain(parameters.kind == PathParameters::Kind::logarithmic_strain)
  {
    const auto read = [&](const auto &texts) {
      for (const std::string &text : texts)
        expressions.emplace_back(text, std::vector<std::string>{"t"}, constants);
    };
    if (by_strain)
      read(parameters.logarithmic_strain);
    else
      read(parameters.deformation_gradient);

    const dealii::Tensor<2, 3> off_identity =
      deformation_gradient(0.) - dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    if (!(off_identity.norm() <= start_tolerance))
      throw UserError("A path begins undeformed: at t = 0 " +
                      std::string(by_strain ? "the strains must be 0."
                                            : "the deformation gradient must be 1, 0, 0; 0, 1, 0; "
                                              "0, 0, 1."));
  }



  dealii::Tensor<2, 3>
  StrainPath::deformation_gradient(const double t) const
  {
    dealii::Tensor<2, 3> F;
    for (int i = 0; i < 3; ++i)
      if (by_strain)
        F[i][i] = std::exp(expressions[i]({t}));
      else
        for (int j = 0; j < 3; ++j)
          F[i][j] = expressions[3 * i + j]({t});
    return F;
  }
} // namespace kedge
