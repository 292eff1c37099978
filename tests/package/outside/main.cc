// Uses a header that CMake wrote, one that needs deal.II, and the library itself.
#include <kedge/base/single_process.h>
#include <kedge/base/version.h>
#include <kedge/grid/parameters.h>

#include <iostream>

int
main()
{
  kedge::hasten_single_process_start();
  kedge::GridParameters<3> grid;
  grid.extent[2] = 1;
  std::cout << "kedge " << kedge::version::number << ' ' << kedge::version::revision
            << grid.extent[2] << std::endl;
  return grid.extent.norm() == 1 ? 0 : 1;
}
