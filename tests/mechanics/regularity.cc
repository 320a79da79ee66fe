#include "convergence_tools.h"
#include "scene_run.h"

using namespace Arenite;
using namespace Arenite::Test;

namespace
{
/// The reference cavities P1 to P5 of benchmarks/spherical_cavity on the radius.
RunRecord radius(const std::string &pulse, const unsigned int degree, const unsigned int refinement)
{
  // error in time below that in space: the step falls with h^((p+1)/2) where the load is smooth
  const bool   smooth  = pulse != "P4" && pulse != "P5";
  const double courant = smooth && degree > 1 ? 0.6 / std::pow(2., 0.5 * (degree - 1.) * (refinement - 3.)) : 0.6;
  const std::vector<std::string> overrides = {"Dimension=1",
                                              "Symmetry=spherical",
                                              "Element/Type=spectral element",
                                              "Element/Degree=" + std::to_string(degree),
                                              "Mesh/Refinement=" + std::to_string(refinement),
                                              "Time stepping/Courant number=" + std::to_string(courant),
                                              "Receivers/generic/Directions=0.9, 0.35, 0.25",
                                              "Receivers/generic/Radii=0.117, 0.15, 0.2, 0.25"};
  return run_scene(
    Parameters::from_files({ARENITE_SOURCE_DIR "/benchmarks/spherical_cavity/" + pulse + ".prm"}, overrides));
}
} // namespace

BOOST_AUTO_TEST_SUITE(regularity)

// The smoothness of the load decides the order (theory.md, section 12): p(t) in C^k gives min(p + 1, (k + 5/2) 2p/(2p+1)) in the
// displacement and min(p, (k + 3/2) 2p/(2p+1)) in the stress, for degrees 1 to 4 and k = 3, 3, 5, -1, -1.
BOOST_AUTO_TEST_CASE(orders_of_the_reference_cavities)
{
  const std::pair<std::string, int> pulses[] = {{"P1", 3}, {"P2", 3}, {"P3", 5}, {"P4", -1}, {"P5", -1}};
  for (const auto &[pulse, k] : pulses)
    for (unsigned int p = 1; p <= 4; ++p)
      {
        // meshes of about the same number of unknowns: the range between pre-asymptotic and round-off is narrow for high degrees
        const unsigned int first  = k < 0 ? 8 - (p + 1) / 2 : (p == 1 ? 7 : 7 - p);
        const RunRecord    coarse = radius(pulse, p, first), fine = radius(pulse, p, first + 1);
        const auto         check = [&](const std::string &quantity, const double law) {
          const std::string key  = "generic." + quantity + ".E_t";
          const double      q    = order(coarse.errors.at(key), fine.errors.at(key));
          const std::string what = pulse + " degree " + std::to_string(p) + " " + quantity + ": order " +
                                   std::to_string(q) + " law " + std::to_string(law);
          BOOST_TEST_MESSAGE(what << " errors " << coarse.errors.at(key) << " " << fine.errors.at(key)
                                          << " core seconds " << fine.core_seconds);
          BOOST_TEST(q > law - 0.3, what);
          if (k < 0 &&
              quantity == "displacement") // a jump converges no faster, whatever the degree; the order of the stress at
            BOOST_TEST(q < law + 0.3, what); // four points depends on where they lie in their cells, 0.43 to 0.95
        };
        check("displacement", std::min(p + 1., (k + 2.5) * 2. * p / (2. * p + 1.)));
        check("stress", std::min(1. * p, (k + 1.5) * 2. * p / (2. * p + 1.)));
      }
}

BOOST_AUTO_TEST_SUITE_END()
