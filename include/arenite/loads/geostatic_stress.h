#pragma once

#include <arenite/base/tensor_tools.h>
#include <arenite/loads/nodal_force.h>

#include <map>

namespace Arenite
{
/// What the soil of a block was before: coefficient of earth pressure at rest, and the largest past stress over the present one.
struct GeostaticPast
{
  double K0 = 0.5, overconsolidation = 1.;
};

/// Stress of horizontal layers at rest under gravity, below the highest point of the body:
///
///   sigma = -s_v [K0 I + (1 - K0) d d^T],     s_v = surcharge + integral of rho |g| over the depth,
///
/// with the direction d of gravity and one earth pressure coefficient K0 per layer, a material block. It is in equilibrium
/// whatever the blocks' stiffness: K0 does not depend on the place along a layer.
template <int dim>
class GeostaticStress
{
public:
  /// In the open section of initial conditions and in that of a block.
  void declare_parameters(Parameters &);
  void declare_block(Parameters &, GeostaticPast &) const;
  /// @p past by material id; one entry under any id if there is a single block.
  void finalize(const Parameters &, const Geometry<dim> &, const std::vector<std::unique_ptr<Load<dim>>> &,
                const std::map<unsigned int, GeostaticPast> &past);

  bool is_wanted() const { return kind == "geostatic"; }

  /// Find the layers. InputError if the blocks are not horizontal layers. Collective.
  void reinit(const Discretization<dim> &, const MaterialOfBlock &);

  /// Vertical stress [Pa], compression positive, and the stress tensor.
  double            vertical(const dealii::Point<dim> &) const;
  SymTensor<double> at(const dealii::Point<dim> &, dealii::types::material_id) const;

  /// |g| [m/s^2]
  double acceleration() const { return gravity.norm(); }

  const GeostaticPast &past_of(dealii::types::material_id) const;

  /// Boundaries that push back with this stress for good.
  const std::vector<dealii::types::boundary_id> &held() const { return held_ids; }
  const std::vector<std::string>                &held_names() const { return held_boundaries; }

  /// One line for the log.
  std::string description() const;

private:
  struct Layer
  {
    double                     top, bottom; ///< depths [m]
    double                     density;
    dealii::types::material_id id;
  };

  std::string                             kind            = "none", path;
  double                                  surcharge       = 0.;
  std::vector<std::string>                held_boundaries = {"auto"};
  std::vector<dealii::types::boundary_id> held_ids;
  dealii::Tensor<1, dim>                  gravity, down;
  std::map<unsigned int, GeostaticPast>   past;
  double                                  top_level = 0.; ///< coordinate along -down of the highest point [m]
  std::vector<Layer>                      layers;
};

/// The far field and the ground around hold the body at rest: t = sigma n of the geostatic stress on named boundaries, constant in time.
/// Dashpots carry no static load.
template <int dim>
class HeldStress : public Load<dim>
{
public:
  explicit HeldStress(GeostaticStress<dim> &stress, const bool one_point)
    : stress(stress)
    , one_point(one_point)
  {
    this->name = "stress at rest";
  }

  void        declare_parameters(Parameters &) override {}
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void        add(VectorType &force, const State<dim> &) override;
  double      power(const VectorType &half_velocity) const override;
  void        add_resultants(Resultants<dim> &) const override;
  std::string description() const override;

private:
  GeostaticStress<dim> &stress;
  const bool            one_point; ///< cells have one stress: on each face that of its middle acts
  NodalForces<dim>      traction;
  Resultants<dim>       whole;
};
} // namespace Arenite
