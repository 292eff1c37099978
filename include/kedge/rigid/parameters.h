#ifndef kedge_rigid_parameters_h
#define kedge_rigid_parameters_h

#include <kedge/grid/parameters.h>
#include <kedge/points/geometry.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kedge
{
  /** What one of the six degrees of freedom of a rigid body may do. */
  struct RigidFreedom
  {
    ComponentCondition motion; ///< free, or what moves it: expressions of t [m, m/s; rad, rad/s]
    std::string        force;  ///< that acts along a free one, expression of t [N; N m]; or empty
  };

  /** A section of Rigid bodies. In 2D vectors have z = 0, and bodies turn about z. */
  template <int dim>
  struct RigidBodyParameters
  {
    std::string                    name;
    std::shared_ptr<Geometry<dim>> geometry;         ///< may be none
    double                         spacing = 0.;     ///< of the facets' corners [m]; 0: by its size
    double                         density = 0.;     ///< [kg/m^3]
    std::optional<double>          mass;             ///< [kg], in place of the geometry's
    std::vector<double>            centre;           ///< likewise [m]
    std::vector<double>            inertia;          ///< likewise, about the centre [kg m^2]
    std::vector<double>            velocity;         ///< of the centre at the start [m/s]
    std::vector<double>            angular_velocity; ///< at the start, x, y, z; in 2D one [rad/s]
    std::array<RigidFreedom, 6>    freedoms;         ///< along x, y, z, and about them
    bool                           body_force = true;
  };

  /** A section of Lines: it pulls at a body, from another one or from a place. */
  struct LineParameters
  {
    std::string              name;
    unsigned int             body = 0;
    std::optional<unsigned>  other;            ///< body at its other end
    std::vector<double>      attachment;       ///< to the body at the start [m]
    std::vector<double>      other_attachment; ///< to the other body at the start [m]
    std::vector<std::string> anchor;           ///< its other end, expressions of t [m]
    std::string              length;         ///< without load, expression of t [m]; empty: as given
    std::optional<double>    stiffness;      ///< [N/m]; none: it does not stretch
    bool                     pushes = false; ///< a rod
  };

  /** A section of Joints: what it lets its two bodies do against each other. */
  struct JointParameters
  {
    std::string             name;
    unsigned int            body = 0;
    std::optional<unsigned> other;               ///< none: space
    bool                    turns = true;        ///< a hinge; else it holds all
    std::vector<double>     place;               ///< at the start [m]
    std::vector<double>     axis = {0., 0., 1.}; ///< of a hinge, at the start
    std::optional<double>   lowest, highest;     ///< angle since the start [rad]
    double                  stop_stiffness = 0.; ///< [N m]
    double                  friction       = 0.; ///< largest moment about the axis [N m]
  };
} // namespace kedge

#endif
