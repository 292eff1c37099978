#include <kedge/base/exceptions.h>
#include <kedge/surfaces/covered_part.h>
#include <kedge/surfaces/face_functions.h>
#include <kedge/surfaces/surface_faces.h>

#include <algorithm>
#include <cmath>

namespace kedge
{
  namespace
  {
    /** Of a face: less is round-off of an edge that lies between two faces. */
    constexpr double smallest_part = 1e-9;

    double
    sign_of(const unsigned int side)
    {
      return side % 2 == 0 ? -1. : 1.;
    }
  } // namespace



  template <int dim>
  SurfaceFaces<dim>::SurfaceFaces(const std::string                           &what,
                                  const std::vector<SurfaceParameters>        &parameters,
                                  const std::map<std::string, double>         &constants,
                                  const std::vector<const SurfaceTerm<dim> *> &surfaces)
    : what(what)
    , parameters(parameters)
    , constants(constants)
    , surfaces(surfaces)
  {}



  template <int dim>
  typename SurfaceFaces<dim>::Face
  SurfaceFaces<dim>::face_of(const GeneratedPoint<dim> &point,
                             const unsigned int         surface,
                             const unsigned int         side,
                             const Expression          &where) const
  {
    const SurfaceParameters &p         = parameters[surface];
    const PointState<dim>   &state     = point.record.state;
    const int                direction = static_cast<int>(side / 2);
    const double             half      = state.reference_half_lengths[direction];
    double                   offset = side % 2 == 0 ? -half : half, share = 1.;
    const Face               none{surface, side, 0., {}, {}};
    if (p.section)
      {
        offset              = *p.section - point.record.location[direction];
        const double excess = std::abs(offset) / half - 1.;
        if (excess > smallest_part)
          return none;
        if (excess > -smallest_part)
          share = 0.5;
      }
    else if (((point.exposed_sides >> side) & 1u) == 0)
      return none;
    dealii::Point<dim> centre = point.record.location;
    centre[direction] += offset;
    CoveredPart<dim> part = covered_part(where, centre, side, state.reference_half_lengths);
    if (part.fraction < smallest_part)
      return none;
    part.offset[direction] = offset;
    return {surface,
            side,
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
    facets = SurfaceFacets<dim>();
    extents.assign(parameters.size(), SurfaceExtent<dim>());
    facets_at_start.assign(parameters.size(), {});
    for (unsigned int s = 0; s < parameters.size(); ++s)
      {
        const auto &p     = parameters[s];
        const auto  where = p.where.empty()
                              ? Expression(1.)
                              : Expression(p.where, {"x", "y", "z", "nx", "ny", "nz"}, constants);
        if (on_facets(s))
          facets_at_start[s] = facets.choose(s, p, where, *on_facets(s));
        else
          for (unsigned int side = 0; side < 2 * dim; ++side)
            if (p.side == side || p.side == 2 * dim)
              attach_to_points(s, side, where, points, body_names);
        if (any(s) || (where.is_constant() && where.value() == 0.)) // Where = 0 switches it off
          continue;
        if (p.section)
          throw UserError(what + " '" + p.name + "' finds no material point of body '" + p.body +
                          "' on its Section, or none where Where is true.");
        throw UserError(what + " '" + p.name +
                        "' finds no exposed face: no material point of body '" + p.body +
                        "' on the given side fulfils Where.");
      }
  }



  /** The surface whose facets it is about; none if the side is along the axes. */
  template <int dim>
  const BodySurface<dim> *
  SurfaceFaces<dim>::on_facets(const unsigned int surface) const
  {
    const auto &p = parameters[surface];
    if (p.section)
      return nullptr;
    for (const SurfaceTerm<dim> *term : surfaces)
      if (term->surface().body_name == p.body && term->has_facets(p.side))
        return &term->surface();
    return nullptr;
  }



  template <int dim>
  void
  SurfaceFaces<dim>::attach_to_points(const unsigned int                surface,
                                      const unsigned int                side,
                                      const Expression                 &where,
                                      std::vector<GeneratedPoint<dim>> &points,
                                      const std::vector<std::string>   &body_names)
  {
    for (auto &point : points)
      {
        PointState<dim> &state = point.record.state;
        if (body_names[static_cast<unsigned int>(state.body)] != parameters[surface].body)
          continue;
        const Face face = face_of(point, surface, side, where);
        if (face.area == 0.)
          continue;
        faces_of[point.record.id].push_back(face);
        extend(extents[surface], face, state);
        state.loaded = 1.;
      }
  }



  template <int dim>
  void
  SurfaceFaces<dim>::add_faces(const std::uint64_t   id,
                               const unsigned int    slot,
                               const PointCore<dim> &state,
                               const Patch<dim>     &patch)
  {
    const auto found = faces_of.find(id);
    if (found == faces_of.end())
      return;
    const dealii::Tensor<2, dim> &F        = state.deformation_gradient;
    const dealii::Tensor<2, dim>  cofactor = determinant(F) * transpose(invert(F));
    for (const Face &face : found->second)
      {
        const int         d = static_cast<int>(face.side / 2);
        SurfacePoint<dim> point{slot, face.surface, {}, {}, face.area, face.place, {}, {}, {}};
        point.reference_normal[d]           = sign_of(face.side);
        const dealii::Tensor<1, dim> offset = F * face.offset;
        for (int i = 0; i < dim; ++i)
          {
            point.offset[i] = offset[i];
            point.area[i]   = cofactor[i][d] * std::copysign(face.area, face.offset[d]);
          }
        point.functions = functions_at_face(patch,
                                            slot,
                                            patch.basis_of(static_cast<unsigned int>(state.body)),
                                            point.offset,
                                            point.area);
        point.gradients = patch.points.stencil[slot];
        faces.push_back(point);
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
    if (!faces_of.empty())
      cloud.for_each_core([&](const unsigned int  number,
                              const std::uint64_t id,
                              const dealii::Point<dim> &,
                              const PointCore<dim> &state) {
        if (state.loaded != 0. && points.slot_of[number] != StepPoints<dim>::no_slot)
          add_faces(id, points.slot_of[number], state, patch);
      });
    facets.add_points(patch, faces);
    for (SurfacePoint<dim> &face : faces)
      for (int d = 0; d < dim; ++d)
        face.place[d] = points.location[face.slot][d] + face.offset[d];
    std::stable_sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
      return a.slot < b.slot;
    });
  }

  template class SurfaceFaces<2>;
  template class SurfaceFaces<3>;
} // namespace kedge
