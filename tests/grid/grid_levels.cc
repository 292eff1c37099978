#include <kedge/base/exceptions.h>
#include <kedge/fields/hanging_nodes.h>
#include <kedge/grid/grid_levels.h>
#include <kedge/grid/refinement_rule.h>

#include <gtest/gtest.h>

#include <set>

using namespace kedge;

namespace
{
  template <int dim>
  Lattice<dim>
  lattice_of(const unsigned int n_cells)
  {
    GridParameters<dim> parameters;
    for (int d = 0; d < dim; ++d)
      {
        parameters.origin[d]  = 0.25 * d - 1.;
        parameters.extent[d]  = 0.5 * n_cells * (d + 1);
        parameters.n_cells[d] = n_cells;
      }
    return Lattice<dim>(parameters);
  }

  /** A grid of n^dim cells whose levels an expression says. */
  template <int dim>
  GridLevels<dim>
  levels_of(const unsigned int n_cells, const std::string &refinement)
  {
    const Lattice<dim> lattice = lattice_of<dim>(n_cells);
    GridLevels<dim>    levels(lattice);
    LatticeWindow<dim> all;
    all.n_cells = lattice.n_cells;
    levels.cover(all);
    levels.refine(RefinementRule<dim>(refinement, {}).wanted(lattice, all));
    return levels;
  }

  /** All nodes of all cells of the grid. */
  template <int dim>
  std::vector<unsigned char>
  nodes_of_cells(const GridLevels<dim> &levels)
  {
    const auto                &window = levels.window();
    std::vector<unsigned char> nodes(window.n_nodes_total(), 0);
    for (unsigned int c = 0; c < window.n_cells_total(); ++c)
      if (levels.is_cell(window.cell_index(c)))
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            LatticeIndex<dim> node = window.cell_index(c);
            for (int d = 0; d < dim; ++d)
              node[d] += static_cast<int>((v >> d) & 1u);
            nodes[window.node_number(node)] = 1;
          }
    return nodes;
  }

  template <int dim>
  void
  check_levels(const GridLevels<dim> &levels)
  {
    // the cells fill the box once
    const auto &window = levels.window();
    double      volume = 0.;
    for (unsigned int c = 0; c < window.n_cells_total(); ++c)
      {
        const LatticeIndex<dim> index = window.cell_index(c);
        if (!levels.is_cell(index))
          continue;
        const LevelNode<dim> here = levels.on_level(index);
        const Lattice<dim>  &own  = levels.lattice(here.level);
        volume += own.cell_volume();
        EXPECT_EQ(levels.in_window(here), index);
        EXPECT_EQ(levels.numbering(here.level).cell_number(here.index), c);
        EXPECT_EQ(levels.cell_at(own.node_position(here.index) + 0.3 * own.h), index);
      }
    double whole = 1.;
    for (int d = 0; d < dim; ++d)
      whole *= levels.lattice(0).upper(d) - levels.lattice(0).origin[d];
    EXPECT_NEAR(volume, whole, 1e-12 * whole); // sums of powers of two times one volume: round-off

    // of the nodes at a place one is free, and the others are sums of free ones that give
    // constant and linear fields
    const auto             nodes   = nodes_of_cells(levels);
    const auto             hanging = hanging_nodes(levels, nodes);
    std::set<unsigned int> tied;
    for (const NodeSum &sum : hanging)
      tied.insert(sum.node);
    std::set<LatticeIndex<dim>> free;
    for (unsigned int node = 0; node < nodes.size(); ++node)
      if (nodes[node] && tied.count(node) == 0)
        {
          EXPECT_TRUE(free.insert(levels.finest_index(node)).second);
        }
    for (const NodeSum &sum : hanging)
      {
        double                 weight = 0.;
        dealii::Tensor<1, dim> place;
        for (unsigned int k = 0; k < sum.roots.size(); ++k)
          {
            EXPECT_EQ(tied.count(sum.roots[k]), 0u);
            EXPECT_TRUE(nodes[sum.roots[k]]);
            weight += sum.weights[k];
            place += sum.weights[k] * levels.position(sum.roots[k]);
          }
        EXPECT_EQ(weight, 1.); // powers of two
        EXPECT_LT((place - levels.position(sum.node)).norm(), 1e-13);
      }
  }
} // namespace

TEST(GridLevels, AGridWithoutRefinementIsItsOwnWindow)
{
  const auto levels = levels_of<2>(6, "0");
  EXPECT_EQ(levels.size(), 1u);
  EXPECT_EQ(levels.window().n_cells, levels.coarsest_cells().n_cells);
  check_levels(levels);
}

TEST(GridLevels, CellsFillTheBoxAndHangingNodesInterpolate)
{
  check_levels(levels_of<2>(6, "if(x < 0, 1, 0)"));
  check_levels(levels_of<2>(9, "if(x < 0 && y < 2, 3, 0)"));
  check_levels(levels_of<2>(8, "if((x - 1)^2 + (y - 3)^2 < 1, 2, 0)"));
  check_levels(levels_of<3>(5, "if(x < 0 && y < 1 && z < 2, 2, 0)"));
}

TEST(GridLevels, NeighboursDifferByOneAtMost)
{
  const auto  levels = levels_of<2>(9, "if(x < -0.6 && y < 0, 4, 0)"); // the cell at the corner
  const auto &cells  = levels.coarsest_cells();
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j)
      {
        const int far = std::max(i, j);
        EXPECT_EQ(levels.level_of_cell({{i, j}}), static_cast<unsigned int>(std::max(0, 4 - far)))
          << i << " " << j;
      }
  EXPECT_EQ(levels.size(), 5u);
  EXPECT_EQ(levels.level_of_cell({{-1, 0}}), 0u);
  EXPECT_FALSE(cells.contains_cell({{9, 0}}));
}

TEST(GridLevels, APointHasTheFinestLevelThatItsDomainTouches)
{
  const auto             levels = levels_of<2>(8, "if(x < 1, 1, 0)"); // cells of 0.5 m: to x = 1
  dealii::Tensor<1, 2>   half;
  const dealii::Point<2> x(1.2, 2.3);
  half[0] = half[1] = 0.1;
  EXPECT_EQ(levels.level_at(x, half, 1e-6), 0u);
  half[0] = 0.21;
  EXPECT_EQ(levels.level_at(x, half, 1e-6), 1u);
  half[0] = 0.2 + 1e-7; // less than the slack of a millionth of a cell
  EXPECT_EQ(levels.level_at(x, half, 1e-6), 0u);
}

TEST(RefinementRule, RefusesWhatIsNoNumberOfRefinements)
{
  const Lattice<2> lattice = lattice_of<2>(4);
  LatticeWindow<2> all;
  all.n_cells = lattice.n_cells;
  for (const std::string wrong : {"0.5", "-1", "7", "sqrt(-1)"})
    EXPECT_THROW(RefinementRule<2>(wrong, {}).wanted(lattice, all), UserError) << wrong;
}

TEST(RefinementRule, KnowsWhatItsExpressionAsksFor)
{
  const RefinementRule<2> of_place("if(x > 1, 1, 0)", {}), of_time("if(x > t, 1, 0)", {}),
    of_strain("if(plastic_strain > a, 1, 0)", {{"a", 0.1}}),
    of_distance("if(distance < 1, 2, 0)", {});
  EXPECT_FALSE(of_place.may_change());
  EXPECT_TRUE(of_time.may_change());
  EXPECT_TRUE(of_strain.may_change() && of_strain.asks_plastic_strain());
  EXPECT_FALSE(of_strain.asks_distance());
  EXPECT_TRUE(of_distance.may_change() && of_distance.asks_distance());
  EXPECT_FALSE(RefinementRule<2>("", {}).any());

  const Lattice<2> lattice = lattice_of<2>(2);
  LatticeWindow<2> all;
  all.n_cells = lattice.n_cells;
  RefinementState state;
  state.plastic_strain = {0., 0.05, 0.1, 0.2};
  state.distance       = {3., 0.5, 0.99, 1.};
  EXPECT_EQ(of_strain.wanted(lattice, all, state), (std::vector<unsigned char>{0, 0, 0, 1}));
  EXPECT_EQ(of_distance.wanted(lattice, all, state), (std::vector<unsigned char>{0, 2, 2, 0}));
  EXPECT_EQ(of_distance.wanted(lattice, all), (std::vector<unsigned char>{0, 0, 0, 0}));
}
