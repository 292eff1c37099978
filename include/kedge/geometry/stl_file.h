#ifndef kedge_geometry_stl_file_h
#define kedge_geometry_stl_file_h

#include <kedge/geometry/triangle_surface.h>

#include <filesystem>

namespace kedge
{
  /**
   * The triangles of an STL file, binary or ASCII, in its own units. Normals in the file
   * are not used: the order of the corners says where outside is.
   *
   * @throws UserError that names the file and, of a wrong facet, its number from 1.
   */
  std::vector<Triangle>
  read_stl(const std::filesystem::path &file);
} // namespace kedge

#endif
