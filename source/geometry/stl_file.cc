#include <kedge/base/exceptions.h>
#include <kedge/geometry/stl_file.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace kedge
{
  namespace
  {
    constexpr std::size_t header_size = 80, facet_size = 50;

    /** The number of facets that a binary file of this content would announce. */
    std::uint32_t
    announced_facets(const std::string &content)
    {
      std::uint32_t number = 0;
      if (content.size() >= header_size + 4)
        std::memcpy(&number, &content[header_size], 4); // little endian, as this machine
      return number;
    }

    std::vector<Triangle>
    read_binary(const std::string &content)
    {
      std::vector<Triangle> triangles(announced_facets(content));
      for (std::size_t i = 0; i < triangles.size(); ++i)
        {
          std::array<float, 12> numbers; // the normal, then the corners
          std::memcpy(numbers.data(), &content[header_size + 4 + i * facet_size], sizeof(numbers));
          for (unsigned int corner = 0; corner < 3; ++corner)
            for (unsigned int d = 0; d < 3; ++d)
              triangles[i][corner][d] = numbers[3 + 3 * corner + d];
        }
      return triangles;
    }

    std::vector<Triangle>
    read_ascii(const std::string &content, const std::string &name)
    {
      std::istringstream    input(content);
      std::string           word;
      std::vector<Triangle> triangles;
      unsigned int          corner = 0;
      bool                  ended  = false;
      while (input >> word)
        {
          ended = ended || word == "endsolid";
          if (word == "facet")
            {
              triangles.emplace_back();
              corner = 0;
              ended  = false;
            }
          if (word == "endfacet" && corner != 3)
            throw UserError("Facet " + std::to_string(triangles.size()) + " of " + name + " has " +
                            std::to_string(corner) + " corners instead of 3.");
          if (word != "vertex")
            continue;
          if (triangles.empty() || corner == 3)
            throw UserError("Facet " + std::to_string(triangles.size()) + " of " + name +
                            " has more than 3 corners.");
          for (unsigned int d = 0; d < 3; ++d)
            if (!(input >> triangles.back()[corner][d]))
              throw UserError("Facet " + std::to_string(triangles.size()) + " of " + name +
                              " has a corner that is not three numbers.");
          ++corner;
        }
      if (!ended && !triangles.empty())
        throw UserError(name + " ends within facet " + std::to_string(triangles.size()) +
                        ": there is no endsolid.");
      return triangles;
    }
  } // namespace



  std::vector<Triangle>
  read_stl(const std::filesystem::path &file)
  {
    const std::string name = "'" + file.string() + "'";
    std::ifstream     input(file, std::ios::binary);
    if (!input || std::filesystem::is_directory(file))
      throw UserError("The STL file " + name +
                      " cannot be read; a relative name is searched beside the scene.");
    std::ostringstream all;
    all << input.rdbuf();
    const std::string content = all.str();

    // a binary file may begin with the word solid too: its size decides
    const std::size_t binary_size =
      header_size + 4 + facet_size * std::size_t(announced_facets(content));
    const bool is_binary = content.size() >= header_size + 4 && content.size() == binary_size;
    const bool is_ascii  = !is_binary && content.rfind("solid", 0) == 0;
    if (!is_binary && !is_ascii)
      throw UserError(name + " is no STL file: it neither begins with the word solid nor has the " +
                      std::to_string(binary_size) + " bytes of the facets that it announces, but " +
                      std::to_string(content.size()) + ".");
    const std::vector<Triangle> triangles =
      is_binary ? read_binary(content) : read_ascii(content, name);
    if (triangles.empty())
      throw UserError(name + " has no facet.");
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const auto &corner : triangles[i])
        if (!std::isfinite(corner.norm_square()))
          throw UserError("Facet " + std::to_string(i + 1) + " of " + name +
                          " has a corner that is not three finite numbers.");
    return triangles;
  }
} // namespace kedge
