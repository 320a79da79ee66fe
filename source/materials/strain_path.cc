#include <arenite/base/names.h>
#include <arenite/base/parameters.h>
#include <arenite/base/prescan.h>
#include <arenite/base/values.h>
#include <arenite/materials/strain_path.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Arenite
{
StrainPath read_strain_path(const std::string &file)
{
  const std::vector<std::string> names   = {"time", "eps11", "eps22", "eps33", "eps23", "eps13", "eps12"};
  constexpr int                  index[] = {-1, 0, 1, 2, 5, 4, 3}; // in a SymTensor
  std::istringstream             stream(read_text_file(file));
  std::vector<std::size_t>       columns;
  StrainPath                     path;
  std::string                    line;
  for (unsigned int number = 1; std::getline(stream, line); ++number)
    {
      line = dealii::Utilities::trim(line);
      if (line.empty() || line.front() == '#')
        continue;
      const auto refuse = [&](const std::string &reason) {
        throw InputError(file + ":" + std::to_string(number) + ": " + reason);
      };
      const std::vector<std::string> cells = split_list(line, ',');
      if (columns.empty())
        {
          std::vector<std::string> titles;
          for (const std::string &cell : cells)
            titles.push_back(dealii::Utilities::trim(cell.substr(0, cell.find('['))));
          for (const std::string &name : names)
            {
              const auto found = std::find(titles.begin(), titles.end(), name);
              if (found == titles.end())
                refuse("the header has no column '" + name + "'. A strain path needs: " + join(names) + ".");
              columns.push_back(found - titles.begin());
            }
          continue;
        }
      StrainPath::Row row;
      row.line = number;
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          if (columns[i] >= cells.size())
            refuse("the row ends before column '" + names[i] + "'.");
          const std::string complaint = complaint_about_number(cells[columns[i]], i == 0 ? "s" : "");
          if (!complaint.empty())
            refuse(names[i] + " = " + cells[columns[i]] + ": " + complaint);
          const double value                         = dealii::Utilities::string_to_double(cells[columns[i]]);
          (i == 0 ? row.time : row.strain[index[i]]) = value;
        }
      if (!path.rows.empty() && !(row.time > path.rows.back().time))
        refuse("time = " + to_text(row.time) + " s: times must ascend; the row before has " +
               to_text(path.rows.back().time) + " s.");
      for (int k = 0; k < 6; ++k)
        if (path.rows.empty() && row.strain[k] != 0.)
          refuse("a strain path begins at rest: the first strain must be zero.");
      path.rows.push_back(row);
    }
  if (path.rows.size() < 2)
    throw InputError(file + ": a strain path needs a header and at least two rows.");
  return path;
}
} // namespace Arenite
