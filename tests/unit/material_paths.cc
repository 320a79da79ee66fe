#include <arenite/base/prescan.h>
#include <arenite/materials/law_list.h>
#include <arenite/materials/material_point.h>
#include <arenite/materials/strain_path.h>

#include <deal.II/base/utilities.h>

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace Arenite;

namespace
{
const std::string folder = ARENITE_SOURCE_DIR "/tests/data/material_paths/";

std::unique_ptr<BatchLaw> law_of_file(const std::string &file)
{
  Parameters parameters = Parameters::from_files({file});
  auto       law        = material_laws(1).make(parameters.peek("Materials/solid/Law", ""));
  {
    const auto  materials = parameters.section("Materials");
    const auto  solid     = parameters.section("solid");
    std::string name;
    parameters.add_text("Law", name, "");
    law->declare_parameters(parameters);
  }
  parameters.parse();
  law->finalize(parameters);
  return law;
}

struct Reference
{
  StrainPath                     path;
  std::vector<SymTensor<double>> stress;
  std::vector<double>            X;
  std::vector<unsigned int>      steps;
  double                         largest_stress = 0.;
};

Reference read_reference(const std::string &file)
{
  Reference reference;
  reference.path = read_strain_path(file);
  std::istringstream stream(read_text_file(file));
  std::string        line;
  std::getline(stream, line);
  reference.largest_stress = std::stod(line.substr(line.find(':') + 1));
  std::getline(stream, line); // header
  while (std::getline(stream, line))
    {
      const auto        cells   = dealii::Utilities::split_string_list(line, ',');
      constexpr int     order[] = {0, 1, 2, 5, 4, 3};
      SymTensor<double> stress;
      for (int k = 0; k < 6; ++k)
        stress[order[k]] = std::stod(cells[7 + k]);
      reference.stress.push_back(stress);
      reference.X.push_back(std::stod(cells[13]));
      reference.steps.push_back(std::stoi(cells[14]));
    }
  BOOST_REQUIRE(reference.stress.size() == reference.path.rows.size());
  return reference;
}

/// Largest stress error over rows and components with m steps per row of the full reference, relative to its largest stress;
/// and by how much work and energies disagree, relative to the largest of them.
struct Errors
{
  double stress = 0., energy = 0.;
};
Errors errors(const std::string &name, const unsigned int m)
{
  const auto      law       = law_of_file(folder + name + ".prm");
  const Reference reference = read_reference(folder + name + ".csv");
  const auto     &rows      = reference.path.rows;
  MaterialPoint   point(*law);
  Errors          errors;
  double          energy = 0.;
  for (std::size_t i = 1; i < rows.size(); ++i)
    {
      const unsigned int n = reference.steps[i] * m;
      for (unsigned int step = 0; step < n; ++step)
        point.advance((rows[i].strain - rows[i - 1].strain) * (1. / n), (rows[i].time - rows[i - 1].time) / n);
      for (int k = 0; k < 6; ++k)
        errors.stress = std::max(errors.stress, std::abs(point.state.stress[k] - reference.stress[i][k]));
      const PointState &s = point.state;
      energy              = std::max({energy, std::abs(s.work), std::abs(s.dissipated), std::abs(s.stored)});
      errors.energy       = std::max(errors.energy, std::abs(s.work - s.stored - s.dissipated + s.stored_by_volume));
    }
  errors.stress /= reference.largest_stress;
  errors.energy /= energy;
  return errors;
}
} // namespace

BOOST_AUTO_TEST_SUITE(material_paths)

// Backward Euler follows the rate equations with the errors that two independent programs measured, and work is stored and
// dissipated energy. 5 % above the measured errors, for other compilers.
BOOST_AUTO_TEST_CASE(errors_against_the_rate_equations)
{
  struct Case
  {
    const char *name;
    double      error_1, error_16, error_64;
    bool        first_order =
      true; // not while the step is long against the relaxation (p10, p02, p11), and not along a junction (p08)
  };
  for (const Case &path :
       {Case{"p01_iso_compression_1e0", 8.2e-4, 5.6e-5, 1.4e-5},
        Case{"p02_iso_tension_1e2", 5.4e-3, 3.5e-4, 1.5e-4, false}, Case{"p03_simple_shear_1e1", 0.14, 1.1e-2, 2.8e-3},
        Case{"p04_oedometer_1e3", 2.6e-3, 1.7e-4, 4.2e-5}, Case{"p05_oedometer_smallcap_1em2", 1.1e-3, 8.9e-5, 2.3e-5},
        Case{"p06_triaxial_like_1e0", 4.9e-3, 3.4e-4, 8.4e-5}, Case{"p07_nonproportional_1e2", 7.4e-3, 4.9e-4, 1.2e-4},
        Case{"p08_interface_sliding_1e1", 3.8e-4, 8.4e-5, 2.5e-5, false},
        Case{"p09_oedometer_highpressure_1e4", 1.0e-3, 4.3e-5, 9.2e-6},
        Case{"p10_iso_highpressure_1em2", 7.8e-7, 4.7e-7, 4.7e-7, false},
        Case{"p11_relaxation_1e4", 6.5e-2, 1.8e-3, 6.0e-4, false},
        Case{"p12_tension_shear_smallcap_1e3", 2.3e-3, 1.5e-4, 4.0e-5}})
    {
      const double allowed[] = {path.error_1, path.error_16, path.error_64};
      double       measured[3];
      for (int i = 0; i < 3; ++i)
        {
          const unsigned int m = i == 0 ? 1 : (i == 1 ? 16 : 64);
          const Errors       e = errors(path.name, m);
          measured[i]          = e.stress;
          BOOST_TEST_MESSAGE(path.name << ", m = " << m << ": stress " << e.stress << ", energy " << e.energy);
          BOOST_TEST_CONTEXT(path.name << ", " << m << " steps per row")
          {
            BOOST_TEST(e.stress <= 1.05 * allowed[i]);
            BOOST_TEST(e.energy <= 1e-10);
          }
        }
      const double order = std::log(measured[1] / measured[2]) / std::log(4.);
      BOOST_TEST_MESSAGE("  order from 16 to 64 steps: " << order);
      if (path.first_order)
        BOOST_TEST(std::abs(order - 1.) < 0.15); // measured 0.98 to 1.00; 1.12 on p09, beside a change of surface
    }
}

BOOST_AUTO_TEST_SUITE_END()
