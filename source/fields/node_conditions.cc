#include <kedge/fields/node_conditions.h>
#include <kedge/fields/prescribed_motion.h>
#include <kedge/points/node_region.h>

namespace kedge
{
  namespace
  {
    const std::vector<std::string> place_and_time = {"x", "y", "z", "t"};
  } // namespace



  template <int dim>
  NodeConditions<dim>::NodeConditions(const std::vector<NodeConditionParameters<dim>> &parameters,
                                      const std::map<std::string, double>             &constants,
                                      const LoadProgram                               &program)
    : program(program)
  {
    for (const auto &p : parameters)
      {
        Condition condition;
        condition.on_side = p.on_side;
        condition.side    = p.side;
        if (!p.on_side)
          {
            condition.where = Expression(p.where, place_and_time, constants);
            follows_time_   = follows_time_ || depends_on_time(p.where, constants);
          }
        for (int d = 0; d < dim; ++d)
          {
            Motion &motion = condition.motions[d];
            motion.kind    = p.components[d].kind;
            if (motion.kind == ConditionKind::free || motion.kind == ConditionKind::fixed)
              continue;
            const bool at_place = motion.kind == ConditionKind::motion;
            motion.expression =
              Expression(p.components[d].expression,
                         at_place ? motion_variables() : std::vector<std::string>{"t"},
                         constants);
            any_moving_ = true;
            needs_place = needs_place || at_place;
          }
        if (!p.pore_pressure.empty())
          {
            condition.pressure = Expression(p.pore_pressure, {"x", "y", "z", "t"}, constants);
            any_pressure = needs_place = true;
          }
        conditions.push_back(std::move(condition));
      }
  }



  template <int dim>
  bool
  NodeConditions<dim>::applies(const Condition         &condition,
                               const Lattice<dim>      &lattice,
                               const LatticeIndex<dim> &node) const
  {
    if (condition.on_side)
      {
        const int direction = condition.side / 2;
        return node[direction] == (condition.side % 2 == 0 ? 0 : lattice.n_cells[direction]);
      }
    const auto x    = lattice.node_position(node);
    double     v[4] = {0, 0, 0, time};
    for (int d = 0; d < dim; ++d)
      v[d] = x[d];
    return is_true((*condition.where)(v));
  }



  template <int dim>
  bool
  NodeConditions<dim>::set_time(const double t)
  {
    const double before = time;
    time                = just_after(program.time(t));
    return follows_time_ && time != before;
  }



  template <int dim>
  bool
  NodeConditions<dim>::reinit(const BackgroundGrid<dim> &grid, const ActiveNodes<dim> &nodes)
  {
    const std::vector<short> before = condition_of, pressure_before = pressure_condition_of;
    condition_of.assign(std::size_t(nodes.n_local()) * dim, -1);
    pressure_condition_of.assign(any_pressure ? nodes.n_local() : 0, -1);
    for (unsigned int c = 0; c < conditions.size(); ++c)
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        {
          const LevelNode<dim> node = grid.levels().node(nodes.window_node(i));
          if (!applies(conditions[c], grid.levels().lattice(node.level), node.index))
            continue;

          for (int d = 0; d < dim; ++d)
            if (conditions[c].motions[d].kind != ConditionKind::free)
              condition_of[std::size_t(i) * dim + d] = c;
          if (conditions[c].pressure)
            pressure_condition_of[i] = c;
        }
    if (needs_place)
      {
        place.resize(nodes.n_local());
        for (unsigned int i = 0; i < nodes.n_local(); ++i)
          place[i] = grid.node_position(nodes.window_node(i));
      }
    return condition_of != before || pressure_condition_of != pressure_before;
  }



  template <int dim>
  double
  NodeConditions<dim>::increment(const unsigned int node,
                                 const int          d,
                                 const double       t0,
                                 const double       t1) const
  {
    const Motion &motion = conditions[condition_of[std::size_t(node) * dim + d]].motions[d];
    if (!motion.expression)
      return 0.;
    double x[3] = {0, 0, 0};
    for (int e = 0; e < dim && motion.kind == ConditionKind::motion; ++e)
      x[e] = place[node][e];
    return prescribed_increment(motion.kind, *motion.expression, x, t0, t1);
  }



  template <int dim>
  double
  NodeConditions<dim>::velocity(const unsigned int node,
                                const int          d,
                                const double       t,
                                const double       dt) const
  {
    const Motion &motion = conditions[condition_of[std::size_t(node) * dim + d]].motions[d];
    if (!motion.expression)
      return 0.;
    double x[3] = {0, 0, 0};
    for (int e = 0; e < dim && motion.kind == ConditionKind::motion; ++e)
      x[e] = place[node][e];
    return prescribed_velocity(motion.kind, *motion.expression, x, t, dt);
  }



  template <int dim>
  double
  NodeConditions<dim>::pressure(const unsigned int node, const double t) const
  {
    double x[4] = {0, 0, 0, program.time(t)};
    for (int d = 0; d < dim; ++d)
      x[d] = place[node][d];
    return (*conditions[pressure_condition_of[node]].pressure)({x[0], x[1], x[2], x[3]});
  }

  template class NodeConditions<2>;
  template class NodeConditions<3>;
} // namespace kedge
