#include <kedge/base/exceptions.h>
#include <kedge/base/nearest_name.h>
#include <kedge/io/point_fields.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    template <int dim>
    double
    det_F(const PointRecord<dim> &point)
    {
      return determinant(point.state.deformation_gradient);
    }

    template <int dim>
    void
    put_vector(const dealii::Tensor<1, dim> &vector, double *values)
    {
      for (unsigned int d = 0; d < 3; ++d)
        values[d] = d < dim ? vector[d] : 0.;
    }

    /** tau / @p divisor, in the order xx, yy, zz, xy, yz, xz. */
    template <int dim>
    void
    put_stress(const PointState<dim> &state, const double divisor, double *values)
    {
      const auto &tau = state.kirchhoff_stress;
      values[0]       = tau[0][0] / divisor;
      values[1]       = tau[1][1] / divisor;
      values[2]       = state.out_of_plane_kirchhoff_stress / divisor;
      values[3]       = tau[0][1] / divisor;
      values[4]       = 0;
      values[5]       = 0;
      if constexpr (dim == 3)
        {
          values[2] = tau[2][2] / divisor;
          values[4] = tau[1][2] / divisor;
          values[5] = tau[0][2] / divisor;
        }
    }

    /** sqrt(3/2 s:s) with the deviator s. */
    double
    von_mises(const double *stress)
    {
      const double xy = stress[0] - stress[1], yz = stress[1] - stress[2],
                   zx    = stress[2] - stress[0];
      const double shear = stress[3] * stress[3] + stress[4] * stress[4] + stress[5] * stress[5];
      return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3. * shear);
    }

    template <int dim>
    std::vector<PointField<dim>>
    kinematic_fields()
    {
      using P = const PointRecord<dim> &;
      using F = PointField<dim>;
      return {F{"position",
                "m",
                "place x",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.location, v);
                }},
              F{"displacement",
                "m",
                "x - X",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.state.displacement, v);
                }},
              F{"velocity",
                "m/s",
                "velocity",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.state.velocity, v);
                }},
              F{"acceleration",
                "m/s^2",
                "acceleration",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.state.acceleration, v);
                }},
              F{"deformation_gradient",
                "-",
                "F = dx/dX",
                FieldShape::tensor,
                false,
                [](P p, double *v) {
                  for (unsigned int i = 0; i < 3; ++i)
                    for (unsigned int j = 0; j < 3; ++j)
                      v[3 * i + j] = i < dim && j < dim ? p.state.deformation_gradient[i][j]
                                     : i == j           ? 1.
                                                        : 0.;
                }},
              F{"det_F",
                "-",
                "volume over initial volume",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = det_F(p);
                }},
              F{"half_lengths",
                "m",
                "half the edge lengths of the GIMP domain",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.state.half_lengths, v);
                }}};
    }

    template <int dim>
    std::vector<PointField<dim>>
    stress_fields()
    {
      using P = const PointRecord<dim> &;
      using F = PointField<dim>;
      return {F{"kirchhoff_stress",
                "Pa",
                "det F times the Cauchy stress",
                FieldShape::symmetric_tensor,
                false,
                [](P p, double *v) {
                  put_stress(p.state, 1., v);
                }},
              F{"cauchy_stress",
                "Pa",
                "Cauchy stress, tension positive",
                FieldShape::symmetric_tensor,
                false,
                [](P p, double *v) {
                  put_stress(p.state, det_F(p), v);
                }},
              F{"pressure",
                "Pa",
                "- tr(Cauchy stress) / 3",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  double stress[6];
                  put_stress(p.state, det_F(p), stress);
                  *v = -(stress[0] + stress[1] + stress[2]) / 3.;
                }},
              F{"von_mises_stress",
                "Pa",
                "sqrt(3/2 s:s), s the deviator of the Cauchy stress",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  double stress[6];
                  put_stress(p.state, det_F(p), stress);
                  *v = von_mises(stress);
                }}};
    }

    template <int dim>
    std::vector<PointField<dim>>
    other_fields()
    {
      using P = const PointRecord<dim> &;
      using F = PointField<dim>;
      return {F{"strain_energy",
                "J/m^3",
                "elastic energy per initial volume",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.strain_energy;
                }},
              F{"kinetic_energy",
                "J/m^3",
                "kinetic energy per initial volume",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v =
                    0.5 * p.state.mass * p.state.velocity.norm_square() / p.state.reference_volume;
                }},
              F{"mass",
                "kg (kg/m in 2D)",
                "mass",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.mass;
                }},
              F{"volume",
                "m^3 (m^2 in 2D)",
                "volume now",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.reference_volume * det_F(p);
                }},
              F{"body",
                "-",
                "index of its body",
                FieldShape::scalar,
                true,
                [](P p, double *v) {
                  *v = p.state.body;
                }},
              F{"id",
                "-",
                "unique in the run, never changes",
                FieldShape::scalar,
                true,
                [](P p, double *v) {
                  *v = static_cast<double>(p.id);
                }},
              F{"equivalent_plastic_strain",
                "-",
                "accumulated",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.equivalent_plastic_strain;
                }},
              F{"plastic_dissipation",
                "J/m^3",
                "accumulated, per initial volume",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.plastic_dissipation;
                }}};
    }

    template <int dim>
    std::vector<PointField<dim>>
    pore_fields()
    {
      using P = const PointRecord<dim> &;
      using F = PointField<dim>;
      return {F{"pore_pressure",
                "Pa",
                "pressure of the pore fluid, positive in compression",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.pore_pressure;
                }},
              F{"porosity",
                "-",
                "pores over volume now",
                FieldShape::scalar,
                false,
                [](P p, double *v) {
                  *v = p.state.porosity;
                }},
              F{"darcy_velocity",
                "m/s",
                "volume of fluid per area and time, through the skeleton",
                FieldShape::vector,
                false,
                [](P p, double *v) {
                  put_vector<dim>(p.state.darcy_velocity, v);
                }},
              F{"total_stress",
                "Pa",
                "Cauchy stress less the pore pressure, tension positive",
                FieldShape::symmetric_tensor,
                false,
                [](P p, double *v) {
                  put_stress(p.state, det_F(p), v);
                  for (int i = 0; i < 3; ++i)
                    v[i] -= p.state.pore_pressure;
                }}};
    }

    [[noreturn]] void
    unknown(const std::string &name, const std::vector<std::string> &valid)
    {
      std::string list;
      for (const std::string &candidate : valid)
        list += (list.empty() ? "" : ", ") + candidate;
      throw UserError("There is no point field '" + name + "'. Did you mean '" +
                      nearest_name(name, valid) + "'? Valid are: " + list + ".");
    }
  } // namespace



  const std::vector<std::string> &
  value_names(const FieldShape shape)
  {
    static const std::vector<std::string> scalar = {""}, vector = {"x", "y", "z"},
                                          symmetric = {"xx", "yy", "zz", "xy", "yz", "xz"},
                                          tensor =
                                            {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"};
    switch (shape)
      {
        case FieldShape::vector:
          return vector;
        case FieldShape::symmetric_tensor:
          return symmetric;
        case FieldShape::tensor:
          return tensor;
        default:
          return scalar;
      }
  }



  unsigned int
  n_values(const FieldShape shape)
  {
    return value_names(shape).size();
  }



  template <int dim>
  std::vector<typename PointField<dim>::Component>
  PointField<dim>::components() const
  {
    std::vector<Component> result;
    for (unsigned int i = 0; i < n_values(shape); ++i)
      {
        const std::string &suffix = value_names(shape)[i];
        const bool         stress = shape == FieldShape::symmetric_tensor && suffix == "zz";
        if (dim == 3 || suffix.find('z') == std::string::npos || stress)
          result.push_back({suffix, i});
      }
    return result;
  }



  template <int dim>
  std::string
  PointField<dim>::component_name(const Component &component) const
  {
    return component.suffix.empty() ? name : name + '_' + component.suffix;
  }



  template <int dim>
  const std::vector<PointField<dim>> &
  point_fields()
  {
    static const std::vector<PointField<dim>> fields = []() {
      std::vector<PointField<dim>> all;
      for (const auto &group :
           {kinematic_fields<dim>(), stress_fields<dim>(), other_fields<dim>(), pore_fields<dim>()})
        all.insert(all.end(), group.begin(), group.end());
      return all;
    }();
    return fields;
  }



  template <int dim>
  const PointField<dim> &
  point_field(const std::string &name)
  {
    std::vector<std::string> valid;
    for (const PointField<dim> &field : point_fields<dim>())
      {
        if (field.name == name)
          return field;
        valid.push_back(field.name);
      }
    unknown(name, valid);
  }



  template <int dim>
  double
  PointQuantity<dim>::operator()(const PointRecord<dim> &point) const
  {
    double values[9];
    field->evaluate(point, values);
    return values[index];
  }



  template <int dim>
  PointQuantity<dim>
  point_quantity(const std::string &name)
  {
    std::vector<std::string> valid;
    for (const PointField<dim> &field : point_fields<dim>())
      for (const auto &component : field.components())
        {
          valid.push_back(field.component_name(component));
          if (valid.back() == name)
            return {&field, component.index};
        }
    unknown(name, valid);
  }



  template struct PointField<2>;
  template struct PointField<3>;
  template struct PointQuantity<2>;
  template struct PointQuantity<3>;
  template const std::vector<PointField<2>> &
  point_fields<2>();
  template const std::vector<PointField<3>> &
  point_fields<3>();
  template const PointField<2> &
  point_field<2>(const std::string &);
  template const PointField<3> &
  point_field<3>(const std::string &);
  template PointQuantity<2>
  point_quantity<2>(const std::string &);
  template PointQuantity<3>
  point_quantity<3>(const std::string &);
} // namespace kedge
