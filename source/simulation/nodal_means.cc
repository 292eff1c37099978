#include <kedge/io/point_fields.h>
#include <kedge/simulation/nodal_means.h>
#include <kedge/transfer/node_sums.h>

#include <unordered_map>

namespace kedge
{
  namespace
  {
    /** The fields that have a mean. */
    template <int dim>
    std::vector<const PointField<dim> *>
    fields_with_mean(const std::vector<std::string> &names)
    {
      std::vector<const PointField<dim> *> fields;
      for (const std::string &name : names)
        if (!point_field<dim>(name).integer)
          fields.push_back(&point_field<dim>(name));
      return fields;
    }

    /** Volume, and volume times all values of the fields, of each slot. */
    template <int dim>
    std::vector<double>
    weighted_values(const StepPoints<dim>                      &points,
                    const std::vector<PointRecord<dim>>        &records,
                    const std::vector<const PointField<dim> *> &fields,
                    const unsigned int                          width)
    {
      std::unordered_map<std::uint64_t, unsigned int> slot_of;
      for (unsigned int slot = 0; slot < points.size(); ++slot)
        slot_of.emplace(points.id[slot], slot);
      std::vector<double> values(std::size_t(points.size()) * width, 0.);
      for (const PointRecord<dim> &record : records)
        {
          const auto found = slot_of.find(record.id);
          if (found == slot_of.end()) // of another field
            continue;
          double *next = &values[std::size_t(found->second) * width], volume = 0.;
          point_field<dim>("volume").evaluate(record, &volume);
          *next++ = volume;
          for (const auto *field : fields)
            {
              field->evaluate(record, next);
              for (unsigned int k = 0; k < n_values(field->shape); ++k)
                *next++ *= volume;
            }
        }
      return values;
    }
  } // namespace



  template <int dim>
  void
  add_nodal_means(const Patch<dim>                    &patch,
                  const std::vector<PointRecord<dim>> &records,
                  const std::vector<std::string>      &names,
                  GridSnapshot<dim>                   &snapshot)
  {
    const auto   fields = fields_with_mean<dim>(names);
    unsigned int width  = 1;
    for (const auto *field : fields)
      width += n_values(field->shape);
    std::vector<double> sums(std::size_t(patch.nodes.n_local()) * width, 0.);
    add_scalars_to_nodes(patch, weighted_values(patch.points, records, fields, width), width, sums);
    patch.nodes.add_to_owners(sums, width);
    patch.nodes.update_ghosts(sums, width);

    for (unsigned int node = 0; node < patch.nodes.n_local(); ++node)
      {
        const double *sum     = &sums[std::size_t(node) * width];
        const double  inverse = *sum > 0. ? 1. / *sum : 0.;
        ++sum;
        for (const auto *field : fields)
          {
            if (field->shape == FieldShape::vector)
              {
                dealii::Tensor<1, dim> mean;
                for (int d = 0; d < dim; ++d)
                  mean[d] = inverse * sum[d];
                snapshot.nodal_vectors[field->name].push_back(mean);
              }
            else
              for (const auto &component : field->components())
                snapshot.nodal_scalars[field->component_name(component)].push_back(
                  inverse * sum[component.index]);
            sum += n_values(field->shape);
          }
      }
  }

  template void
  add_nodal_means(const Patch<2> &,
                  const std::vector<PointRecord<2>> &,
                  const std::vector<std::string> &,
                  GridSnapshot<2> &);
  template void
  add_nodal_means(const Patch<3> &,
                  const std::vector<PointRecord<3>> &,
                  const std::vector<std::string> &,
                  GridSnapshot<3> &);
} // namespace kedge
