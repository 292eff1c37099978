#include <kedge/base/exceptions.h>
#include <kedge/base/nearest_name.h>
#include <kedge/io/point_fields.h>
#include <kedge/materials/material.h>

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

    template <int dim, auto member>
    void
    scalar_of_state(const PointRecord<dim> &point, double *values)
    {
      *values = point.state.*member;
    }

    template <int dim, auto member>
    void
    vector_of_state(const PointRecord<dim> &point, double *values)
    {
      put_vector<dim>(point.state.*member, values);
    }

    template <int dim>
    void
    deformation_gradient(const PointRecord<dim> &point, double *values)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          values[3 * i + j] = i < dim && j < dim ? point.state.deformation_gradient[i][j]
                              : i == j           ? 1.
                                                 : 0.;
    }

    template <int dim>
    void
    cauchy_stress(const PointRecord<dim> &point, double *values)
    {
      put_stress(point.state, det_F(point), values);
    }

    template <int dim>
    void
    total_stress(const PointRecord<dim> &point, double *values)
    {
      cauchy_stress(point, values);
      for (int i = 0; i < 3; ++i)
        values[i] -= point.state.pore_pressure;
    }

    template <int dim>
    void
    kinetic_energy(const PointRecord<dim> &point, double *value)
    {
      const auto &state = point.state;
      *value            = 0.5 * state.mass * state.velocity.norm_square() / state.reference_volume;
    }

    template <int dim>
    void
    mean_pressure(const PointRecord<dim> &point, double *value)
    {
      double stress[6];
      cauchy_stress(point, stress);
      *value = -(stress[0] + stress[1] + stress[2]) / 3.;
    }

    template <int dim>
    void
    von_mises_stress(const PointRecord<dim> &point, double *value)
    {
      double stress[6];
      cauchy_stress(point, stress);
      *value = von_mises(stress);
    }

    template <int dim>
    struct FieldList
    {
      using Evaluate = std::function<void(const PointRecord<dim> &, double *)>;

      void
      add(const char     *name,
          const char     *unit,
          const char     *meaning,
          const Evaluate &evaluate,
          FieldShape      shape   = FieldShape::scalar,
          bool            integer = false)
      {
        fields.push_back({name, unit, meaning, shape, integer, evaluate});
      }

      std::vector<PointField<dim>> fields;
    };

    template <int dim>
    void
    add_kinematic_fields(FieldList<dim> &list)
    {
      using P           = const PointRecord<dim> &;
      using S           = PointState<dim>;
      const auto vector = FieldShape::vector;
      const auto place  = [](P p, double *v) {
        put_vector<dim>(p.location, v);
      };
      const auto volume = [](P p, double *v) {
        *v = det_F(p);
      };
      list.add("position", "m", "place x", place, vector);
      list.add("displacement", "m", "x - X", vector_of_state<dim, &S::displacement>, vector);
      list.add("velocity", "m/s", "velocity", vector_of_state<dim, &S::velocity>, vector);
      list.add("acceleration",
               "m/s^2",
               "acceleration",
               vector_of_state<dim, &S::acceleration>,
               vector);
      list.add("deformation_gradient",
               "-",
               "F = dx/dX",
               deformation_gradient<dim>,
               FieldShape::tensor);
      list.add("det_F", "-", "volume over initial volume", volume);
      list.add("half_lengths",
               "m",
               "half the edge lengths of the GIMP domain",
               vector_of_state<dim, &S::half_lengths>,
               vector);
    }

    template <int dim>
    void
    add_stress_fields(FieldList<dim> &list)
    {
      using P              = const PointRecord<dim> &;
      const auto symmetric = FieldShape::symmetric_tensor;
      const auto kirchhoff = [](P p, double *v) {
        put_stress(p.state, 1., v);
      };
      list.add("kirchhoff_stress", "Pa", "det F times the Cauchy stress", kirchhoff, symmetric);
      list.add("cauchy_stress",
               "Pa",
               "Cauchy stress, tension positive",
               cauchy_stress<dim>,
               symmetric);
      list.add("pressure", "Pa", "- tr(Cauchy stress) / 3", mean_pressure<dim>);
      list.add("von_mises_stress",
               "Pa",
               "sqrt(3/2 s:s), s the deviator of the Cauchy stress",
               von_mises_stress<dim>);
    }

    template <int dim>
    void
    add_other_fields(FieldList<dim> &list)
    {
      using P           = const PointRecord<dim> &;
      using S           = PointState<dim>;
      const auto volume = [](P p, double *v) {
        *v = p.state.reference_volume * det_F(p);
      };
      const auto id = [](P p, double *v) {
        *v = static_cast<double>(p.id);
      };
      const auto scalar = FieldShape::scalar;
      list.add("strain_energy",
               "J/m^3",
               "elastic energy per initial volume",
               scalar_of_state<dim, &S::strain_energy>);
      list.add("kinetic_energy", "J/m^3", "kinetic energy per initial volume", kinetic_energy<dim>);
      list.add("mass", "kg (kg/m in 2D)", "mass", scalar_of_state<dim, &S::mass>);
      list.add("volume", "m^3 (m^2 in 2D)", "volume now", volume);
      list.add("body", "-", "index of its body", scalar_of_state<dim, &S::body>, scalar, true);
      list.add("id", "-", "unique in the run, never changes", id, scalar, true);
      const std::vector<Column> &columns = memory_columns();
      for (unsigned int c = 0; c < columns.size(); ++c)
        list.add(columns[c].name, columns[c].unit, columns[c].meaning, [c](P p, double *v) {
          *v = p.state.memory[c];
        });
      list.add("plastic_dissipation",
               "J/m^3",
               "accumulated, per initial volume",
               scalar_of_state<dim, &S::plastic_dissipation>);
    }

    template <int dim>
    void
    add_pore_fields(FieldList<dim> &list)
    {
      using S = PointState<dim>;
      list.add("pore_pressure",
               "Pa",
               "pressure of the pore fluid, positive in compression",
               scalar_of_state<dim, &S::pore_pressure>);
      list.add("porosity", "-", "pores over volume now", scalar_of_state<dim, &S::porosity>);
      list.add("darcy_velocity",
               "m/s",
               "volume of fluid per area and time, through the skeleton",
               vector_of_state<dim, &S::darcy_velocity>,
               FieldShape::vector);
      list.add("total_stress",
               "Pa",
               "Cauchy stress less the pore pressure, tension positive",
               total_stress<dim>,
               FieldShape::symmetric_tensor);
    }

    [[noreturn]] void
    unknown(const std::string &name, const std::vector<std::string> &valid)
    {
      std::string list;
      for (const std::string &candidate : valid)
        list += (list.empty() ? "" : ", ") + candidate;
      throw UserError("There is no point field '" + name + "'." + did_you_mean(name, valid) +
                      " Valid are: " + list + ".");
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
      FieldList<dim> list;
      add_kinematic_fields(list);
      add_stress_fields(list);
      add_other_fields(list);
      add_pore_fields(list);
      return list.fields;
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
