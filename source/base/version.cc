#include <arenite/base/version.h>

#include <deal.II/base/config.h>

#ifndef ARENITE_VERSION
#  define ARENITE_VERSION "unknown"
#endif
#ifndef ARENITE_COMMIT
#  define ARENITE_COMMIT "unknown"
#endif

namespace Arenite
{
std::string version() { return ARENITE_VERSION; }

std::string commit() { return ARENITE_COMMIT; }

std::string compiler()
{
#if defined(__clang__)
  return "clang++ " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__) + "." +
         std::to_string(__clang_patchlevel__);
#elif defined(__GNUC__)
  return "g++ " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
         std::to_string(__GNUC_PATCHLEVEL__);
#else
  return "unknown";
#endif
}

std::string dealii_version() { return DEAL_II_PACKAGE_VERSION; }
} // namespace Arenite
