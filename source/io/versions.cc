#include <kedge/base/version.h>
#include <kedge/io/versions.h>

#include <deal.II/base/config.h>

#include <Trilinos_version.h>
#include <p4est_config.h>

#include <dlfcn.h>
#include <filesystem>

extern "C" void
dgemm_();

namespace kedge
{
  namespace
  {
    /** OpenBLAS says who it is; of others the file in use is told. */
    std::string
    blas_version()
    {
      using Configuration = const char *();
      if (void *const symbol = dlsym(RTLD_DEFAULT, "openblas_get_config"))
        {
          const std::string text = reinterpret_cast<Configuration *>(symbol)();
          return text.substr(0, text.find_last_not_of(' ') + 1);
        }
      Dl_info information;
      if (dladdr(reinterpret_cast<void *>(&dgemm_), &information) == 0 ||
          information.dli_fname == nullptr)
        return "unknown";
      std::error_code             none;
      const std::filesystem::path file = std::filesystem::canonical(information.dli_fname, none);
      return none ? information.dli_fname : file.string();
    }
  } // namespace



  std::map<std::string, std::string>
  software_versions()
  {
    const std::string revision = version::revision;
    return {{"kedge", version::number + (revision.empty() ? "" : " (" + revision + ')')},
            {"deal.II", DEAL_II_PACKAGE_VERSION},
            {"Trilinos", TRILINOS_VERSION_STRING},
            {"p4est", P4EST_VERSION},
            {"BLAS", blas_version()},
            {"build_type", version::build_type}};
  }
} // namespace kedge
