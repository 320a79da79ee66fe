#pragma once

#include <arenite/materials/material_test.h>

#include <memory>
#include <string>
#include <vector>

namespace Arenite
{
/// `set Law` of the block whose section is open, among the laws of the list; every law is known by name, the caller decides which
/// ones it can run.
std::string declare_law(Parameters &, std::string &name);

/// The file of `arenite material`: one block of `subsection Materials`, as in a scene, and `subsection Test`.
class MaterialBench
{
public:
  /// Declares, parses strictly, derives and checks. A strain path on the command line takes the place of the test.
  MaterialBench(Parameters &, const std::string &strain_path, unsigned int steps_per_row);

  /// Names of the columns with units, and the rows of the test so far.
  struct Table
  {
    std::vector<std::string>         columns;
    std::vector<std::vector<double>> rows;
    double                           last(const std::string &column) const;
    std::vector<double>              values(const std::string &column) const;
    std::size_t                      index(const std::string &column) const;
  };

  /// Run the test. A PhysicsAlarm leaves the rows that were reached in @p table.
  void run(Table &table) const;

  std::string               title, block, law_name;
  std::unique_ptr<BatchLaw> law;
  MaterialTest              test;

private:
  void                     declare_parameters(Parameters &);
  std::vector<std::string> columns() const;
  void                     add_row(Table &, const PointState &ahead, const PointState &) const;

  std::vector<std::string> block_names;
  unsigned int             material_id = 0; ///< a scene's entry, without effect here
};

/// `--sweep "Section/Entry=first:last:count"`.
struct Sweep
{
  explicit Sweep(const std::string &text);
  std::string         path;
  std::vector<double> values;
};
} // namespace Arenite
