// Ghost stabilisation: faces, face matrices and what they do to a mass matrix,
// on one rank and on two.
#include "cloud.h"

#include <kedge/transfer/ghost_penalty.h>
#include <kedge/transfer/parameters.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

#include <map>

using namespace kedge;
using namespace kedge::test;

namespace
{
  template <typename Dimension>
  class TransferGhostMpi : public testing::Test
  {};
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

  const std::vector<double> moduli = {2.6, 5.};

  /** A cloud with its ghost faces; its points fill about a fifth of their cells. */
  template <int dim>
  struct GhostCloud : Cloud<dim>
  {
    explicit GhostCloud(const std::vector<BasisKind> &basis)
      : Cloud<dim>(basis, 2, 17, 3)
      , basis(basis)
    {
      auto reached = this->step.reached_nodes(this->grid.window());
      ghosts.find(this->patch, moduli, reached);
      this->nodes.reinit(this->grid, reached);
      jumps.reinit(this->nodes.n_local(), 1, 3);
      jumps.set_zero();
      ghosts.add_mass(this->patch, 1., jumps);
    }

    /** M_G x, whole at all local nodes. */
    std::vector<double>
    product(const std::vector<double> &x) const
    {
      std::vector<double> y(x.size());
      multiply(jumps, this->patch, dim, x, y);
      this->nodes.add_to_owners(y, dim);
      return y;
    }

    /** x . y over the nodes of all ranks. */
    double
    dot(const std::vector<double> &x, const std::vector<double> &y) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < this->nodes.n_owned() * dim; ++i)
        sum += x[i] * y[i];
      return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    }

    const std::vector<BasisKind> basis;
    GhostPenalty<dim>            ghosts;
    NodeMatrix<dim>              jumps; ///< M_G with factor 1
  };

  template <int dim, typename Check>
  void
  for_all_bases(const Check &check)
  {
    check(GhostCloud<dim>({BasisKind::linear}));
    check(GhostCloud<dim>({BasisKind::gimp}));
    check(GhostCloud<dim>({BasisKind::gimp, BasisKind::linear}));
    check(GhostCloud<dim>({BasisKind::spline}));
  }

  /** Offsets of a face's nodes: 3 along the normal by 2, x fastest. */
  template <int dim>
  std::vector<LatticeIndex<dim>>
  nodes_of_face(const unsigned int normal)
  {
    const auto width = [&](const unsigned int d) {
      return d >= dim ? 1 : (d == normal ? 3 : 2);
    };
    std::vector<LatticeIndex<dim>> nodes;
    for (int k = 0; k < width(2); ++k)
      for (int j = 0; j < width(1); ++j)
        for (int i = 0; i < width(0); ++i)
          {
            const int         all[3] = {i, j, k};
            LatticeIndex<dim> node;
            std::copy_n(all, dim, node.begin());
            nodes.push_back(node);
          }
    return nodes;
  }

  /** N_A at x, in cells from node A. */
  template <int dim>
  double
  hat(const std::array<double, dim> &x, const LatticeIndex<dim> &node)
  {
    double value = 1.;
    for (int d = 0; d < dim; ++d)
      value *= std::max(0., 1. - std::abs(x[d] - node[d]));
    return value;
  }

  /** Share of a point's domain that lies in a cell; a linear point lies in one cell. */
  template <int dim>
  double
  share(const Lattice<dim>      &lattice,
        const PointRecord<dim>  &record,
        const BasisKind          basis,
        const LatticeIndex<dim> &cell)
  {
    if (basis == BasisKind::linear)
      return lattice.cell_of(record.location) == cell ? 1. : 0.;
    double part = 1.;
    for (int d = 0; d < dim; ++d)
      {
        const double s    = lattice.scaled(record.location[d], d);
        const double half = record.state.half_lengths[d] / lattice.h[d];
        const double both = std::min(s + half, cell[d] + 1.) - std::max(s - half, double(cell[d]));
        part *= std::max(0., both) / (2. * half);
      }
    return part;
  }

  /** Faces by lower cell and direction, with density and modulus, directly from the records. */
  template <int dim>
  std::map<std::pair<unsigned int, unsigned int>, std::pair<double, double>>
  expected_faces(const GhostCloud<dim> &cloud)
  {
    struct Content
    {
      double present = 0., volume = 0., mass = 0., modulus = 0.;
    };
    const auto                     &lattice = cloud.grid.lattice();
    std::map<unsigned int, Content> cells;
    for (unsigned int c = 0; c < cloud.window().n_cells_total(); ++c)
      for (const auto &record : cloud.records)
        {
          const auto   body = static_cast<unsigned int>(record.state.body);
          const double part =
            share<dim>(lattice, record, cloud.basis[body], cloud.window().cell_index(c));
          if (part == 0.)
            continue;
          const double volume = part * record.state.reference_volume;
          cells[c].present += volume * determinant(record.state.deformation_gradient);
          cells[c].volume += volume;
          cells[c].mass += part * record.state.mass;
          cells[c].modulus += volume * moduli[body];
        }
    double full = full_cell;
    for (int d = 0; d < dim; ++d)
      full *= lattice.h[d];
    std::map<std::pair<unsigned int, unsigned int>, std::pair<double, double>> faces;
    for (const auto &[c, content] : cells)
      for (unsigned int d = 0; d < dim; ++d)
        {
          auto index = cloud.window().cell_index(c);
          ++index[d];
          const auto other = cells.find(cloud.window().cell_number(index));
          if (other == cells.end() || (content.present >= full && other->second.present >= full))
            continue;
          const double volume = content.volume + other->second.volume;
          faces[{c, d}]       = {(content.mass + other->second.mass) / volume,
                                 (content.modulus + other->second.modulus) / volume};
        }
    return faces;
  }

  /** A block of 3^dim cells, two points per direction in each, moved by @p shift cells. */
  template <int dim>
  struct ShiftedBlock
  {
    explicit ShiftedBlock(const double shift)
      : grid(some_grid<dim>(box()), MPI_COMM_WORLD)
      , patch(grid, parameters(), {{}, {}})
      , nodes(patch.nodes)
    {
      LatticeWindow<dim> block;
      for (int d = 0; d < dim; ++d)
        {
          block.low[d]     = 3;
          block.n_cells[d] = 4;
        }
      std::vector<PointRecord<dim>> records;
      const auto                    n_points = static_cast<unsigned int>(std::pow(6, dim) + 0.5);
      for (unsigned int k = 0; k < n_points; ++k)
        {
          unsigned int     rest = k;
          PointRecord<dim> record;
          std::fill_n(reinterpret_cast<double *>(&record.state), n_state_values<dim>, 0.);
          record.id                     = k;
          record.state.reference_volume = 1.;
          for (int d = 0; d < dim; ++d)
            {
              const double h     = grid.lattice().h[d];
              const int    place = rest % 6;
              rest /= 6;
              record.location[d] = grid.lattice().origin[d] + (3.25 + 0.5 * place + shift) * h;
              record.state.reference_volume *= 0.5 * h;
              record.state.deformation_gradient[d][d] = record.state.elastic_frame[d][d] = 1.;
            }
          record.state.out_of_plane_elastic_stretch = 1.;
          record.state.mass                         = record.state.reference_volume;
          records.push_back(record);
        }
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
        records.clear();
      grid.cover(block, std::vector<unsigned int>(block.n_cells_total(), 1));
      points.distribute(grid, records);
      patch.reinit(points, [&](std::vector<unsigned char> &reached) {
        ghosts.find(patch, {1.}, reached);
      });
      mass.reinit(nodes.n_local(), 1, 3);
      assemble_mass(patch, mass);
    }

    static PatchParameters
    parameters()
    {
      PatchParameters result;
      result.basis_of_body = {BasisKind::linear};
      result.n_components  = dim;
      return result;
    }

    static std::array<unsigned int, dim>
    box()
    {
      std::array<unsigned int, dim> n_cells;
      n_cells.fill(9);
      return n_cells;
    }

    /** Largest over smallest eigenvalue of a matrix. */
    double
    condition(const NodeMatrix<dim> &matrix) const
    {
      const auto       n_window = grid.window().n_nodes_total();
      std::vector<int> number(n_window, 0), dense_number(n_window, -1);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        number[nodes.window_node(i)] = 1;
      dealii::Utilities::MPI::sum(number, MPI_COMM_WORLD, number);
      int n = 0;
      for (unsigned int w = 0; w < n_window; ++w)
        if (number[w] > 0)
          dense_number[w] = n++;
      std::vector<double> entries(std::size_t(n) * n, 0.);
      const auto          strides = matrix.slot_strides(grid.window());
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        for (unsigned int s = 0; s < matrix.n_slots(); ++s)
          if (matrix.row(i, 0)[s] != 0.)
            {
              const int w = static_cast<int>(nodes.window_node(i));
              entries[dense_number[w] * n + dense_number[w + strides[s]]] += matrix.row(i, 0)[s];
            }
      dealii::Utilities::MPI::sum(entries, MPI_COMM_WORLD, entries);
      dealii::LAPACKFullMatrix<double> dense(n);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          dense(i, j) = entries[i * n + j];
      dealii::Vector<double>     values;
      dealii::FullMatrix<double> vectors;
      dense.compute_eigenvalues_symmetric(-1e30, 1e30, 0., values, vectors);
      return values[n - 1] / std::abs(values[0]);
    }

    BackgroundGrid<dim> grid;
    MaterialPoints<dim> points;
    Patch<dim>          patch;
    ActiveNodes<dim>   &nodes;
    GhostPenalty<dim>   ghosts;
    NodeMatrix<dim>     mass;
  };
} // namespace

TYPED_TEST_SUITE(TransferGhostMpi, Dimensions);

TYPED_TEST(TransferGhostMpi, FaceMatrixIsTheIntegralOfJumps)
{
  constexpr int          dim = TypeParam::value;
  dealii::Tensor<1, dim> h;
  for (int d = 0; d < dim; ++d)
    h[d] = 0.7 - 0.2 * d;
  const double gauss[2] = {0.5 - std::sqrt(1. / 12.), 0.5 + std::sqrt(1. / 12.)};
  for (unsigned int normal = 0; normal < dim; ++normal)
    {
      const auto nodes  = nodes_of_face<dim>(normal);
      const auto matrix = ghost_face_matrix<dim>(h, normal);
      ASSERT_EQ(matrix.size(), nodes.size() * nodes.size());
      double area = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        area *= d == normal ? 1. : h[d];
      // two Gauss points per direction integrate the quadratic products exactly;
      // the functions are linear along the normal, so differences are exact slopes
      std::vector<double> expected(matrix.size(), 0.);
      for (unsigned int q = 0; q < (1u << (dim - 1)); ++q)
        {
          std::array<double, dim> x;
          unsigned int            bit = 0;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = d == normal ? 1. : gauss[(q >> bit++) & 1u];
          auto above = x, below = x;
          above[normal] += 0.5;
          below[normal] -= 0.5;
          std::vector<double> jump;
          for (const auto &A : nodes)
            jump.push_back((hat<dim>(above, A) + hat<dim>(below, A) - 2. * hat<dim>(x, A)) /
                           (0.5 * h[normal]));
          for (std::size_t A = 0; A < nodes.size(); ++A)
            for (std::size_t B = 0; B < nodes.size(); ++B)
              expected[A * nodes.size() + B] += std::pow(h[normal], 3) / 3. * jump[A] * jump[B] *
                                                area / static_cast<double>(1u << (dim - 1));
        }
      for (std::size_t k = 0; k < matrix.size(); ++k)
        EXPECT_NEAR(matrix[k], expected[k], 1e-15);
    }
}

TYPED_TEST(TransferGhostMpi, FacesBorderPartlyFilledCells)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const GhostCloud<dim> &cloud) {
    std::vector<double> mine;
    for (const GhostFace &face : cloud.ghosts.faces())
      mine.insert(mine.end(),
                  {double(face.lower_cell), double(face.direction), face.density, face.modulus});
    const auto   expected = expected_faces<dim>(cloud);
    unsigned int n        = 0;
    for (const auto &all : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      for (std::size_t k = 0; k < all.size(); k += 4, ++n)
        {
          const auto face = expected.find(
            {static_cast<unsigned int>(all[k]), static_cast<unsigned int>(all[k + 1])});
          ASSERT_TRUE(face != expected.end()) << "cell " << all[k] << ", direction " << all[k + 1];
          EXPECT_NEAR(all[k + 2], face->second.first, 1e-11 * all[k + 2]);
          EXPECT_NEAR(all[k + 3], face->second.second, 1e-12 * all[k + 3]);
        }
    EXPECT_EQ(n, expected.size());
    EXPECT_GT(n, 5u);
  });
}

TYPED_TEST(TransferGhostMpi, SymmetricPositiveAndBlindToLinearFields)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const GhostCloud<dim> &cloud) {
    const auto   x = cloud.random_nodal(1., 1), y = cloud.random_nodal(1., 2);
    const auto   Jx = cloud.product(x), Jy = cloud.product(y);
    const double energy = cloud.dot(x, Jx);
    EXPECT_GT(energy, 0.);
    EXPECT_GT(cloud.dot(y, Jy), 0.);
    EXPECT_NEAR(cloud.dot(x, Jy), cloud.dot(y, Jx), 1e-13 * energy);

    std::vector<double> linear(x.size()), ones(x.size(), 1.);
    for (unsigned int i = 0; i < cloud.nodes.n_local(); ++i)
      for (int c = 0; c < dim; ++c)
        {
          linear[i * dim + c] = 0.3 - c;
          for (int d = 0; d < dim; ++d)
            linear[i * dim + c] += (1.7 * d - 0.4 * c + 0.9) * cloud.node_position(i)[d];
        }
    // entries of J_G are of the order of those of J_G x; positions are below 10
    const double scale = std::sqrt(cloud.dot(Jx, Jx));
    EXPECT_LT(std::sqrt(std::abs(cloud.dot(cloud.product(linear), cloud.product(linear)))),
              1e-13 * scale);
    EXPECT_NEAR(cloud.dot(ones, Jx), 0., 1e-13 * scale); // momentum
  });
}

TYPED_TEST(TransferGhostMpi, StiffnessIsModulusOverSquareOfTheCellSize)
{
  constexpr int dim = TypeParam::value;
  for_all_bases<dim>([](const GhostCloud<dim> &cloud) {
    NodeMatrix<dim> stiffness;
    stiffness.reinit(cloud.nodes.n_local(), 1, 3);
    stiffness.set_zero();
    cloud.ghosts.add_stiffness(cloud.patch, 3., stiffness);
    const auto          x = cloud.random_nodal(1., 1, 1);
    std::vector<double> Kx(x.size());
    multiply(stiffness, cloud.patch, 1, x, Kx);
    double energy = 0., expected = 0.;
    for (unsigned int i = 0; i < x.size(); ++i)
      energy += x[i] * Kx[i];
    const auto &h = cloud.grid.lattice().h;
    for (const GhostFace &face : cloud.ghosts.faces())
      {
        const auto          matrix = ghost_face_matrix<dim>(h, face.direction);
        const auto          cell   = cloud.window().cell_index(face.lower_cell);
        std::vector<double> values;
        for (auto node : nodes_of_face<dim>(face.direction))
          {
            for (int d = 0; d < dim; ++d)
              node[d] += cell[d];
            values.push_back(x[cloud.nodes.local(cloud.window().node_number(node))]);
          }
        for (std::size_t A = 0; A < values.size(); ++A)
          for (std::size_t B = 0; B < values.size(); ++B)
            expected += 3. * face.modulus / (h[face.direction] * h[face.direction]) * values[A] *
                        matrix[A * values.size() + B] * values[B];
      }
    EXPECT_NEAR(energy, expected, 1e-12 * expected);
  });
}

TYPED_TEST(TransferGhostMpi, FullCellsHaveNone)
{
  constexpr int dim     = TypeParam::value;
  const auto    n_faces = [](const double shift) {
    return dealii::Utilities::MPI::sum(ShiftedBlock<dim>(shift).ghosts.faces().size(),
                                       MPI_COMM_WORLD);
  };
  EXPECT_EQ(n_faces(0.), 0u);
  // 4^dim cells, of which the 2^dim in the middle are full: all faces but those between these
  EXPECT_EQ(n_faces(0.3), dim == 2 ? 24u - 4u : 144u - 12u);
}

TYPED_TEST(TransferGhostMpi, BoundTheConditionOfTheMass)
{
  constexpr int dim = TypeParam::value;
  for (const double xi : {1e-2, 1e-3}) // how far points reach into the next cells
    {
      const ShiftedBlock<dim> block(0.25 + xi);
      NodeMatrix<dim>         ghosted = block.mass;
      block.ghosts.add_mass(block.patch, StabilisationParameters().ghost_mass_factor, ghosted);
      const double none = block.condition(block.mass), ghost = block.condition(ghosted);
      // corner nodes have m N^2 with N = xi^dim; the penalty, 1e-6 of a full
      // cell's mass, does not know xi: 1e8 leaves a factor of 100 to its eigenvalues
      EXPECT_GT(none, 1. / (xi * xi * xi * xi));
      EXPECT_LT(ghost, 1e8);
      EXPECT_LT(ghost, none / 100.);
      EXPECT_LT(lumped_mass_ratio(block.patch, block.mass), badly_conditioned_mass);
    }
  // well-filled cells: points in the middle of their halves
  const ShiftedBlock<dim> aligned(0.);
  EXPECT_GT(lumped_mass_ratio(aligned.patch, aligned.mass), badly_conditioned_mass);
}
