#include <kedge/base/exceptions.h>
#include <kedge/surfaces/covered_part.h>
#include <kedge/surfaces/surface_faces.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Of a face: less is round-off of an edge that lies between two faces. */
    constexpr double smallest_part = 1e-9;
  } // namespace



  template <int dim>
  SurfaceFaces<dim>::SurfaceFaces(const std::string                    &what,
                                  const std::vector<SurfaceParameters> &parameters,
                                  const std::map<std::string, double>  &constants)
    : what(what)
    , parameters(parameters)
    , constants(constants)
  {}



  template <int dim>
  typename SurfaceFaces<dim>::Face
  SurfaceFaces<dim>::face_of(const GeneratedPoint<dim> &point,
                             const unsigned int         surface,
                             const Expression          &where) const
  {
    const SurfaceParameters &p         = parameters[surface];
    const PointState<dim>   &state     = point.record.state;
    const int                direction = static_cast<int>(p.side / 2);
    const double             half      = state.reference_half_lengths[direction];
    double                   offset = p.side % 2 == 0 ? -half : half, share = 1.;
    const Face               none{surface, 0., {}, {}};
    if (p.section)
      {
        offset              = *p.section - point.record.location[direction];
        const double excess = std::abs(offset) / half - 1.;
        if (excess > smallest_part)
          return none;
        if (excess > -smallest_part)
          share = 0.5;
      }
    else if (((point.exposed_sides >> p.side) & 1u) == 0)
      return none;
    dealii::Point<dim> centre = point.record.location;
    centre[direction] += offset;
    CoveredPart<dim> part = covered_part(where, centre, direction, state.reference_half_lengths);
    if (part.fraction < smallest_part)
      return none;
    part.offset[direction] = offset;
    return {surface,
            share * part.fraction * state.reference_volume / (2. * half),
            point.record.location + part.offset,
            part.offset};
  }



  template <int dim>
  void
  SurfaceFaces<dim>::extend(SurfaceExtent<dim>    &extent,
                            const Face            &face,
                            const PointState<dim> &state) const
  {
    const bool is_first = extent.n_faces++ == 0;
    for (int d = 0; d < dim; ++d)
      {
        extent.low[d]          = is_first ? face.place[d] : std::min(extent.low[d], face.place[d]);
        extent.high[d]         = is_first ? face.place[d] : std::max(extent.high[d], face.place[d]);
        extent.half_lengths[d] = std::max(extent.half_lengths[d], state.reference_half_lengths[d]);
      }
  }



  template <int dim>
  void
  SurfaceFaces<dim>::attach(std::vector<GeneratedPoint<dim>> &points,
                            const std::vector<std::string>   &body_names)
  {
    faces_of.clear();
    extents.assign(parameters.size(), SurfaceExtent<dim>());
    for (unsigned int s = 0; s < parameters.size(); ++s)
      {
        const auto &p = parameters[s];
        const auto  where =
          p.where.empty() ? Expression(1.) : Expression(p.where, {"x", "y", "z"}, constants);
        for (auto &point : points)
          {
            PointState<dim> &state = point.record.state;
            if (body_names[static_cast<unsigned int>(state.body)] != p.body)
              continue;
            const Face face = face_of(point, s, where);
            if (face.area == 0.)
              continue;
            faces_of[point.record.id].push_back(face);
            extend(extents[s], face, state);
            state.loaded = 1.;
          }
        if (extents[s].n_faces > 0 ||
            (where.is_constant() && where.value() == 0.)) // Where = 0 switches it off
          continue;
        if (p.section)
          throw UserError(what + " '" + p.name + "' finds no material point of body '" + p.body +
                          "' on its Section, or none where Where is true.");
        throw UserError(what + " '" + p.name +
                        "' finds no exposed face: no material point of body '" + p.body +
                        "' on the given side fulfils Where.");
      }
  }



  template <int dim>
  void
  SurfaceFaces<dim>::reinit(const MaterialPoints<dim> &cloud, const Patch<dim> &patch)
  {
    const StepPoints<dim> &points = patch.points;
    faces.clear();
    if (empty())
      return;
    cloud.for_each([&](const unsigned int  number,
                       const std::uint64_t id,
                       const dealii::Point<dim> &,
                       const PointState<dim> &state) {
      if (state.loaded == 0. || points.slot_of[number] == StepPoints<dim>::no_slot)
        return;
      const auto found = faces_of.find(id);
      if (found == faces_of.end())
        return;
      const dealii::Tensor<2, dim> &F        = state.deformation_gradient;
      const dealii::Tensor<2, dim>  cofactor = determinant(F) * transpose(invert(F));
      for (const Face &face : found->second)
        {
          const int d = static_cast<int>(parameters[face.surface].side / 2);
          SurfacePoint<dim>
            point{points.slot_of[number], face.surface, {}, {}, face.area, face.place, {}};
          const dealii::Tensor<1, dim> offset = F * face.offset;
          for (int i = 0; i < dim; ++i)
            {
              point.offset[i] = offset[i];
              point.area[i]   = cofactor[i][d] * std::copysign(face.area, face.offset[d]);
            }
          point.functions = functions_at_face(patch,
                                              point.slot,
                                              patch.basis_of(static_cast<unsigned int>(state.body)),
                                              point.offset,
                                              point.area);
          faces.push_back(point);
        }
    });
    std::stable_sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
      return a.slot < b.slot;
    });
  }

  template class SurfaceFaces<2>;
  template class SurfaceFaces<3>;
} // namespace kedge
