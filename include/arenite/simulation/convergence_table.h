#pragma once

#include <arenite/io/run_record.h>

#include <string>
#include <vector>

namespace Arenite
{
/// What a sequence of runs on meshes of half the cell size each says about accuracy, as text for the log.
///
/// Errors against an exact solution get their observed order log2(e_coarse/e_fine). Values without one (norms of receiver
/// signals) are extrapolated from the last three meshes after Richardson (1911):
///
///   q = log2((f1 - f2)/(f2 - f3)),   f* = f3 + (f3 - f2)/(2^q - 1),
///
/// with the error bar 1.25 |f* - f3| where 0.5 < q < 2 p + 2, and 3 |f3 - f2| where the sequence is not in its asymptotic range
/// (Roache's grid convergence index, J. Fluids Eng. 116 (1994) 405-413).
std::string convergence_table(const std::vector<RunRecord> &);
} // namespace Arenite
