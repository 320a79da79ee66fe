#include <arenite/materials/soil_state.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace Arenite;

namespace
{
SoilState from_porosity(const double n, const double saturation)
{
  SoilMeasurements measured;
  measured.porosity   = n;
  measured.saturation = saturation;
  return measured.state();
}

std::string refusal(const SoilMeasurements &measured)
{
  try
    {
      measured.state();
    }
  catch (const InputError &error)
    {
      return error.what();
    }
  return "(accepted)";
}

bool mentions(const std::string &message, const std::string &part)
{
  BOOST_TEST_MESSAGE(message);
  return message.find(part) != std::string::npos;
}
} // namespace

BOOST_AUTO_TEST_SUITE(soil_state)

// Quartz sand with water and air has the densities, the modulus and the wave speeds that follow by hand from the definitions of
// Roger (2015), section 1.1.1, and from Reuss' and Wood's rules. Tolerance: half a unit of the last digit of the table.
BOOST_AUTO_TEST_CASE(phases_by_hand)
{
  struct Row
  {
    double n, saturation, water_content, density, compacted, air, modulus, speed, suspension;
  };
  const Row table[] = {{.40, 0., 0., 1590., 2650., .400, 36.6e9, 3716., 15.},
                       {.40, .50, .126, 1790., 2238., .200, 7.46e9, 1825., 20.},
                       {.40, .80, .201, 1910., 2076., .080, 5.68e9, 1655., 30.},
                       {.40, .99, .249, 1986., 1994., .004, 5.07e9, 1595., 133.},
                       {.40, 1., .252, 1990., 1990., 0., 5.05e9, 1592., 1592.},
                       {.30, 1., .162, 2155., 2155., 0., 6.43e9, 1728., 1728.}};
  for (const Row &row : table)
    {
      const SoilState soil = from_porosity(row.n, row.saturation);
      BOOST_TEST(std::abs(soil.water_content - row.water_content) <= .5e-3);
      BOOST_TEST(std::abs(soil.density() - row.density) <= .5);
      BOOST_TEST(std::abs(soil.compacted_density() - row.compacted) <= .5);
      BOOST_TEST(std::abs(soil.air_fraction() - row.air) <= .5e-3);
      BOOST_TEST(std::abs(soil.compacted_modulus() - row.modulus) <=
                 .5e-2 * std::pow(10., row.modulus > 1e10 ? 10. : 9.));
      BOOST_TEST(std::abs(soil.compacted_speed() - row.speed) <= .5);
      BOOST_TEST(std::abs(soil.suspension_speed() - row.suspension) <= .5);
    }
  BOOST_TEST(from_porosity(.4, .5).locking_strain() == -std::log(.8), boost::test_tools::tolerance(1e-14)); // round-off
  // the log says it
  double logged = 0.;
  from_porosity(.4, .5).for_each_constant([&](const std::string &name, const double value, const std::string &unit) {
    if (name == "Moist density" && unit == "kg/m^3")
      logged = value;
  });
  BOOST_TEST(logged == 1790., boost::test_tools::tolerance(1e-14));
}

// Whichever quantities are measured, the soil is the same. Tolerance: round-off through the chain of relations.
BOOST_AUTO_TEST_CASE(every_sufficient_set)
{
  const SoilState  soil = from_porosity(.37, .43);
  SoilMeasurements all;
  all.smallest_void_ratio = .45;
  all.largest_void_ratio  = .80;
  all.density             = soil.density();
  all.dry_density         = soil.dry_density();
  all.water_content       = soil.water_content;
  all.void_ratio          = soil.void_ratio;
  all.porosity            = soil.porosity();
  all.saturation          = soil.saturation();
  all.relative_density    = (.80 - soil.void_ratio) / (.80 - .45);

  using Member                                 = std::optional<double> SoilMeasurements::*;
  const std::vector<Member>            members = {&SoilMeasurements::density,         &SoilMeasurements::dry_density,
                                                  &SoilMeasurements::water_content,   &SoilMeasurements::saturation,
                                                  &SoilMeasurements::void_ratio,      &SoilMeasurements::porosity,
                                                  &SoilMeasurements::relative_density};
  const auto                           with    = [&](const std::vector<std::size_t> &chosen) {
    SoilMeasurements some = all;
    for (std::size_t k = 0; k < members.size(); ++k)
      some.*members[k] = std::nullopt;
    for (const std::size_t k : chosen)
      some.*members[k] = all.*members[k];
    return some;
  };
  int pairs = 0, triples = 0;
  for (std::size_t a = 0; a < members.size(); ++a)
    for (std::size_t b = a + 1; b < members.size(); ++b)
      {
        const bool two_words_for_pores = a >= 4, no_water = a == 1 && b >= 4; // the dry density is that of the pores
        SoilMeasurements pair = with({a, b});
        pair.specific_gravity = soil.specific_gravity;
        if (two_words_for_pores || no_water)
          {
            BOOST_TEST(mentions(refusal(pair), "not determined"));
            continue;
          }
        const SoilState found = pair.state();
        BOOST_TEST(found.void_ratio == soil.void_ratio, boost::test_tools::tolerance(1e-12));
        BOOST_TEST(found.water_content == soil.water_content, boost::test_tools::tolerance(1e-12));
        ++pairs;

        // a third quantity replaces the specific gravity where it is independent
        for (std::size_t c = b + 1; c < 5; ++c)
          if (!(a == 0 && b == 1 && c == 2))
            {
              SoilMeasurements triple = with({a, b, c});
              triple.specific_gravity.reset();
              const SoilState again = triple.state();
              BOOST_TEST(again.specific_gravity == soil.specific_gravity, boost::test_tools::tolerance(1e-11));
              BOOST_TEST(again.void_ratio == soil.void_ratio, boost::test_tools::tolerance(1e-11));
              ++triples;
            }
      }
  BOOST_TEST(pairs == 15);
  BOOST_TEST(triples == 9);
}

// Redundant values pass when they agree to 0.1 %, and are refused with the numbers when they do not.
BOOST_AUTO_TEST_CASE(contradictions)
{
  SoilMeasurements measured;
  measured.density       = 1790.;
  measured.dry_density   = 1590.;
  measured.porosity      = .40;
  measured.saturation    = .5;
  measured.water_content = .126;                                   // rounded: 1790/1590 - 1 = 0.1258
  BOOST_TEST(std::abs(measured.state().saturation() - .5) < 1e-3); // saturation counts as a part of 1
  measured.specific_gravity = 2.65;
  measured.porosity         = .41;
  BOOST_TEST(mentions(refusal(measured), "contradiction"));
  measured.porosity = .40;
  measured.density  = 1795.;
  BOOST_TEST(mentions(refusal(measured), "contradiction"));

  SoilMeasurements wet;
  wet.porosity      = .4;
  wet.water_content = .30;
  BOOST_TEST(mentions(refusal(wet), "the saturation is 1.19"));
  wet.water_content = .25158; // saturated up to rounding
  BOOST_TEST(wet.state().saturation() == 1., boost::test_tools::tolerance(1e-4));

  SoilMeasurements per_cent;
  per_cent.porosity   = 40.;
  per_cent.saturation = 0.;
  BOOST_TEST(mentions(refusal(per_cent), "per cent"));

  SoilMeasurements heavy;
  heavy.dry_density = 2700.;
  heavy.saturation  = 0.;
  BOOST_TEST(mentions(refusal(heavy), "above that of the grains"));

  SoilMeasurements light;
  light.density     = 1500.;
  light.dry_density = 1590.;
  BOOST_TEST(mentions(refusal(light), "cannot be negative"));

  SoilMeasurements packed;
  packed.relative_density = .5;
  packed.saturation       = 0.;
  BOOST_TEST(mentions(refusal(packed), "e_min < e_max"));
  BOOST_TEST(mentions(refusal(SoilMeasurements()), "not determined"));
}

// In a scene the section gives the same soil, and a refusal names its place.
BOOST_AUTO_TEST_CASE(entries)
{
  const auto read = [](const std::string &lines) {
    Parameters parameters = Parameters::from_text("subsection Materials\nsubsection soil\nsubsection Soil state\n" +
                                                    lines + "end\nend\nend\n",
                                                  "scene.prm");
    SoilStateEntries entries;
    {
      const auto materials = parameters.section("Materials");
      const auto soil      = parameters.section("soil");
      entries.declare_parameters(parameters);
    }
    parameters.parse();
    return entries.is_set(parameters) ? entries.finalize(parameters) : SoilState();
  };
  BOOST_TEST(read("set Porosity = 0.4\nset Saturation = 0.5\n").density() == 1790.,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(read("").void_ratio == 0.); // not described by its phases
  try
    {
      read("set Porosity = 0.4\nset Water content = 0.3\n");
      BOOST_TEST(false);
    }
  catch (const InputError &error)
    {
      BOOST_TEST(mentions(error.what(), "scene.prm:3: [Materials / soil / Soil state]: the saturation is 1.19"));
    }
}

BOOST_AUTO_TEST_SUITE_END()
