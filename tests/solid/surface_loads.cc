// What acts on a face goes to the nodes with force and moment, and balances a uniform stress.
#include "../transfer/cloud.h"

#include <kedge/points/generation.h>
#include <kedge/solid/internal_force.h>
#include <kedge/solid/surface_loads.h>

#include <gtest/gtest.h>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class SolidSurfaceLoads : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  /** A box of points that do not keep to the grid's lines, 2 x 3 (x 2) of them, each its own box.
   */
  template <int dim>
  struct Block
  {
    explicit Block(const BasisKind basis, const double shift, const double size)
      : grid(some_grid<dim>(cells()), MPI_COMM_SELF)
      , patch(grid, parameters(basis), {{}, {}})
    {
      std::array<int, 3>            n{{2, 3, dim == 2 ? 1 : 2}};
      std::vector<PointRecord<dim>> records;
      for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
            {
              const int        index[3] = {i, j, k};
              PointRecord<dim> record{};
              record.id                     = records.size();
              record.state.reference_volume = 1.;
              for (int d = 0; d < dim; ++d)
                {
                  const double half  = size * grid.lattice().h[d];
                  record.location[d] = grid.lattice().origin[d] +
                                       (3. + shift) * grid.lattice().h[d] +
                                       (2 * index[d] + 1) * half;
                  record.state.half_lengths[d] = record.state.reference_half_lengths[d] = half;
                  record.state.reference_volume *= 2. * half;
                  record.state.deformation_gradient[d][d] = record.state.elastic_frame[d][d] = 1.;
                }
              record.state.out_of_plane_elastic_stretch = 1.;
              record.state.mass                         = record.state.reference_volume;
              GeneratedPoint<dim> point;
              point.exposed_sides = 0;
              for (int d = 0; d < dim; ++d)
                point.exposed_sides |= (index[d] == 0) << (2 * d) | (index[d] == n[d] - 1)
                                                                      << (2 * d + 1);
              point.record = record;
              generated.push_back(point);
              records.push_back(record);
            }
      LatticeWindow<dim> block;
      for (int d = 0; d < dim; ++d)
        {
          block.low[d]     = 2;
          block.n_cells[d] = 5;
        }
      grid.cover(block, std::vector<unsigned int>(block.n_cells_total(), 1));
      cloud.distribute(grid, records);
      patch.reinit(cloud, [](std::vector<unsigned char> &) {});
    }

    static PatchParameters
    parameters(const BasisKind basis)
    {
      PatchParameters result;
      result.basis_of_body = {basis};
      result.n_components  = dim;
      return result;
    }

    static std::array<unsigned int, dim>
    cells()
    {
      std::array<unsigned int, dim> n_cells;
      n_cells.fill(8);
      return n_cells;
    }

    /** Nodal forces of the traction sigma n on all sides. */
    std::vector<double>
    surface_forces(const dealii::SymmetricTensor<2, dim> &sigma)
    {
      std::vector<TractionParameters<dim>> tractions;
      for (unsigned int side = 0; side < 2 * dim; ++side)
        {
          TractionParameters<dim> traction;
          traction.name = "side";
          traction.body = "block";
          traction.side = side;
          for (int d = 0; d < dim; ++d)
            traction.traction[d] = std::to_string((side % 2 == 0 ? -1. : 1.) * sigma[d][side / 2]);
          tractions.push_back(traction);
        }
      SurfaceTractions<dim> loads(tractions, {});
      loads.attach(generated, {"block"});
      cloud.update_each([&](const unsigned int, dealii::Point<dim> &, PointState<dim> &state) {
        state.loaded = 1.;
      });
      loads.reinit(cloud, patch);
      std::vector<double> sums(std::size_t(patch.nodes.n_local()) * dim, 0.);
      add_face_forces(patch, loads.points(), loads.forces(0.), sums);
      return sums;
    }

    BackgroundGrid<dim>              grid;
    MaterialPoints<dim>              cloud;
    Patch<dim>                       patch;
    std::vector<GeneratedPoint<dim>> generated;
  };

  /** sum_p V sigma grad N_A, in the units of surface_forces(). */
  template <int dim>
  std::vector<double>
  internal_forces(const Patch<dim> &patch, const dealii::SymmetricTensor<2, dim> &sigma)
  {
    std::vector<double>                 force(std::size_t(patch.nodes.n_local()) * dim, 0.);
    std::vector<dealii::Tensor<2, dim>> gradients;
    for (std::size_t k = 0; k < force.size(); ++k)
      {
        // by virtual work: the displacement of one node's component
        std::vector<double> virtual_displacement(force.size(), 0.);
        virtual_displacement[k] = 1.;
        gradients_at_points(patch, virtual_displacement, gradients);
        for (unsigned int slot = 0; slot < patch.points.size(); ++slot)
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              force[k] += patch.points.volume[slot] * sigma[i][j] * gradients[slot][i][j];
      }
    return force;
  }
} // namespace

TYPED_TEST_SUITE(SolidSurfaceLoads, Dimensions);

// GIMP domains tile the block: the mean slopes of the functions over them add up to the functions'
// integrals over its surface (divergence theorem), node by node, wherever the block lies and
// however it cuts the cells. Points of the linear basis are exact while each lies with its whole
// box within one cell.
TYPED_TEST(SolidSurfaceLoads, BalanceAUniformStress)
{
  constexpr int                   dim = TypeParam::value;
  dealii::SymmetricTensor<2, dim> sigma;
  for (int i = 0; i < dim; ++i)
    for (int j = i; j < dim; ++j)
      sigma[i][j] = 1. + 0.5 * i - 0.25 * j;
  struct Case
  {
    BasisKind basis;
    double    shift, size; // in cells
  };
  for (const Case &c : {Case{BasisKind::gimp, 0., 0.25},
                        Case{BasisKind::gimp, 0.3, 0.25},
                        Case{BasisKind::gimp, 0.77, 0.31},
                        Case{BasisKind::gimp, 0.51, 0.5},
                        Case{BasisKind::linear, 0., 0.25},
                        Case{BasisKind::linear, 0.5, 0.25}})
    {
      Block<dim> block(c.basis, c.shift, c.size);
      const auto outer = block.surface_forces(sigma);
      const auto inner = internal_forces(block.patch, sigma);
      for (std::size_t k = 0; k < outer.size(); ++k)
        EXPECT_NEAR(outer[k], inner[k], 1e-14) << "node component " << k << " shift " << c.shift;
    }
}

// A load on part of a face keeps its force and its moment: partition of unity, linear fields exact.
TYPED_TEST(SolidSurfaceLoads, KeepForceAndMoment)
{
  constexpr int dim = TypeParam::value;
  for (const BasisKind basis : {BasisKind::linear, BasisKind::gimp, BasisKind::spline})
    {
      Block<dim>              block(basis, 0.3, 0.25);
      TractionParameters<dim> traction;
      traction.name     = "part";
      traction.body     = "block";
      traction.side     = 3;          // up, of the box x = x_0 .. x_0 + h_x
      traction.where    = "x < 2.13"; // x_0 = 2.01, h_x = 0.7
      traction.traction = {};
      for (int d = 0; d < dim; ++d)
        traction.traction[d] = std::to_string(d + 1);
      SurfaceTractions<dim> loads({traction}, {});
      loads.attach(block.generated, {"block"});
      block.cloud.update_each(
        [&](const unsigned int, dealii::Point<dim> &, PointState<dim> &state) {
          state.loaded = 1.;
        });
      loads.reinit(block.cloud, block.patch);
      const auto          forces = loads.forces(0.);
      const auto         &nodes  = block.patch.nodes;
      std::vector<double> sums(std::size_t(nodes.n_local()) * dim, 0.);
      add_face_forces(block.patch, loads.points(), forces, sums);
      const double area       = 0.12 * (dim == 2 ? 1. : 0.6); // of four half cells of 0.6 in z: h_z
      double       total[dim] = {}, moment = 0.;
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        {
          for (int d = 0; d < dim; ++d)
            total[d] += sums[i * dim + d];
          const auto x = block.patch.node_position(i);
          moment += x[0] * sums[i * dim + 1] - x[1] * sums[i * dim];
        }
      for (int d = 0; d < dim; ++d)
        EXPECT_NEAR(total[d], area * (d + 1), 1e-13);
      // about z, of the centre of the loaded part: y_0 = 0.2 + 3.3 * 0.5, three boxes of 0.25 high
      const double y = 0.2 + 3.3 * 0.5 + 0.75, x = 2.01 + 0.06;
      EXPECT_NEAR(moment, area * (2. * x - y), 1e-13);
      // and work: a linear displacement works as at the centre of the part
      std::vector<double> displacement(sums.size(), 0.);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        displacement[i * dim] = block.patch.node_position(i)[0];
      EXPECT_NEAR(work_of_face_forces(block.patch, loads.points(), forces, displacement),
                  area * x,
                  1e-13);
    }
}
