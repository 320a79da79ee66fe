#pragma once

#include <string>

namespace Arenite
{
/// Release of this executable, for example "0.1.0".
std::string version();

/// Abbreviated commit that it was built from, or "unknown".
std::string commit();

/// Compiler and its version, for example "g++ 12.2.0".
std::string compiler();

/// Version of the deal.II headers that it was compiled with.
std::string dealii_version();
} // namespace Arenite
