// Contract of the laws: derivatives.

#include <Sacado_Fad_SimpleFad.hpp>
#include <cmath>
#include <vector>

#include "law_samples.h"

using namespace Arenite;
using namespace LawSamples;

BOOST_AUTO_TEST_SUITE(law_contract)

// The derivatives of a differentiable number are those of the law.
BOOST_AUTO_TEST_CASE_TEMPLATE(tangent_by_differentiable_numbers, Law, Laws)
{
  using AD = Sacado::Fad::SimpleFad<double>;
  for_each_example<Law>([](const Law &law, const std::string &) {
    unsigned int        kinks = 0, n = 0;
    double              worst = 0., value = 0.;
    const double        h = 1e-8;
    std::vector<double> errors;
    for (const Sample<Law> &sample : samples(law, 400))
      {
        SymTensor<AD>                      stress;
        PointIncrement<AD>                 step;
        typename Law::template History<AD> history;
        for (int k = 0; k < 6; ++k)
          {
            stress[k]      = AD(sample.stress[k]);
            step.strain[k] = AD(6, k, sample.next.strain[k]);
          }
        step.density_old = AD(sample.next.density_old);
        step.density     = AD(sample.next.density);
        step.dt          = sample.next.dt;
        {
          const auto values = numbers(sample.history);
          auto       from   = values.begin();
          history.for_each([&](const char *, AD &x) { x = AD(*from++); });
        }
        const auto ad = law.update(stress, step, history);

        auto       h_0   = sample.history;
        const auto r     = law.update(sample.stress, sample.next, h_0);
        double     error = 0., one_sided = 0.;
        for (int k = 0; k < 6; ++k)
          {
            auto plus = sample.next, minus = sample.next;
            plus.strain[k] += h;
            minus.strain[k] -= h;
            auto       h_plus = sample.history, h_minus = sample.history;
            const auto r_plus  = law.update(sample.stress, plus, h_plus),
                       r_minus = law.update(sample.stress, minus, h_minus);
            for (int i = 0; i < 6; ++i)
              {
                // of a central difference across a kink, half of the jump of the tangent is error
                const double difference = (r_plus.stress[i] - r_minus.stress[i]) / (2. * h),
                             jump       = std::abs(r_plus.stress[i] - 2. * r.stress[i] + r_minus.stress[i]) / h;
                error     = std::max(error, (std::abs(ad.stress[i].dx(k) - difference) - 0.5 * jump) / modulus(law));
                one_sided = std::max(one_sided, jump / modulus(law));
              }
          }
        for (int i = 0; i < 6; ++i)
          value = std::max(value, std::abs(ad.stress[i].val() - r.stress[i]) / scale(law, sample));
        ++n;
        if (one_sided > 1e-4) // a region switch within h
          ++kinks;
        else
          worst = std::max(worst, error);
      }
    BOOST_TEST_MESSAGE(Law::name << ": tangent " << worst << ", value " << value << ", " << kinks << " kinks of " << n);
    BOOST_TEST(worst < 1e-5);
    BOOST_TEST(value < 1e-11);
    BOOST_TEST(kinks < n / 8); // measured up to 43 of 400
  });
}

BOOST_AUTO_TEST_SUITE_END()
