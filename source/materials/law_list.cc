#include <arenite/materials/law_list.h>
#include <arenite/materials/law_types.h>

#include <stdexcept>
#include <string>
#include <tuple>

namespace Arenite
{
namespace
{
template <int W, typename... Laws>
Registry<BatchLaw> make_registry(const std::tuple<Laws...> *)
{
  Registry<BatchLaw> registry("material law");
  (registry.add<BatchLawFor<Laws, W>>(Laws::name, Laws::description), ...);
  return registry;
}

template <int W>
const Registry<BatchLaw> &registry()
{
  static const Registry<BatchLaw> registry = make_registry<W>(static_cast<const LawTypes *>(nullptr));
  return registry;
}
} // namespace

const Registry<BatchLaw> &material_laws(const int lanes)
{
  if (lanes == 1)
    return registry<1>();
  if (lanes == native_lanes)
    return registry<native_lanes>();
  throw std::logic_error("Laws are compiled for 1 and " + std::to_string(native_lanes) + " lanes.");
}
} // namespace Arenite
