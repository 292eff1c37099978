// The start of kedge_unit_tests: MPI around GoogleTest. Under mpirun every
// rank runs the same tests; a failure on any rank fails the run.
#include <kedge/base/single_process.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

int
main(int argc, char **argv)
{
  kedge::hasten_single_process_start();
  testing::InitGoogleTest(&argc, argv);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return RUN_ALL_TESTS();
}
