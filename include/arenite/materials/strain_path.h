#pragma once

#include <arenite/base/tensor_tools.h>

#include <string>
#include <vector>

namespace Arenite
{
/// Strain of a point in time, linear between the rows.
struct StrainPath
{
  struct Row
  {
    double            time = 0.; ///< [s]
    SymTensor<double> strain;    ///< total logarithmic strain, tension positive, tensor components
    unsigned int      line = 0;  ///< in the file
  };
  std::vector<Row> rows;
};

/// Columns time, eps11, eps22, eps33, eps23, eps13, eps12 in any order, found by their names in the first line that is neither
/// empty nor a comment (#); units in brackets and other columns are ignored, so that a result of the bench is a path. InputError
/// with file:line for a missing file or column, a cell that is not a number, times that do not ascend, or a first strain that is
/// not zero.
StrainPath read_strain_path(const std::string &file);
} // namespace Arenite
