#pragma once

#include <arenite/loads/nodal_force.h>

namespace Arenite
{
/// A boundary behind which the solid goes on.
///
/// Lysmer & Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-878: traction t = -rho cp v_n n - rho cs v_t, exact for plane
/// waves at normal incidence.
///
/// Spherical: exact for outgoing spherical P waves on a sphere r = b around `Centre`, whatever their frequency. With
/// w' + (cp/b) w = v_n, w(0) = 0:
///
///   s_rr(b) = -rho cp v_n - (4 G/b) u_n + (rho cp^2/b) w,     s_rt = -rho cs v_t.
///
/// The outgoing potential F(tau)/r gives w = -F'/(cp b); eliminating F'' and F from u, v and s_rr leaves this line. One extra
/// scalar per boundary node. The boundary is passive: its power is rho cp w'^2 + d/dt [2 G u_n^2/b + rho cp^2 w^2/(2 b)].
/// Only the radially symmetric part of a wave passes exactly; other harmonics reflect like at a Lysmer boundary.
template <int dim>
class AbsorbingBoundary : public Load<dim>
{
public:
  AbsorbingBoundary() = default;
  AbsorbingBoundary(const std::vector<dealii::types::boundary_id> &ids, const std::string &condition)
    : ids(ids)
    , condition(condition)
  {}

  void        declare_parameters(Parameters &) override;
  void        finalize(const Parameters &, const Geometry<dim> &) override;
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void        add(VectorType &force, const State<dim> &) override;
  double      power(const VectorType &half_velocity) const override;
  void        add_resultants(Resultants<dim> &) const override;
  void        finish_step(const VectorType &half_velocity, double dt) override;
  bool        admits(Reduction &, const Parameters &) const override;
  std::string description() const override;
  const std::vector<std::string> &boundaries() const { return boundary_names; }
  const DampingBlocks<dim>       *damping() const override { return &dashpots; }
  std::vector<const VectorType *> nodal_states() const override;
  void                            set_nodal_states(const std::vector<VectorType> &) override;

private:
  bool spherical() const { return condition == "spherical"; }

  void make_dashpots(const Discretization<dim> &, const MaterialOfBlock &);
  void make_springs(const Discretization<dim> &, const MaterialOfBlock &);

  struct SphericalNode
  {
    unsigned int           node;
    dealii::Tensor<1, dim> normal;
    double                 spring; ///< A 4 G/b [N/m]
    double                 push;   ///< A rho cp^2/b [N/m]
    double                 rate;   ///< cp/b [1/s]
    double                 force = 0.;
  };

  std::vector<std::string>                boundary_names;
  std::vector<dealii::types::boundary_id> ids;
  std::string                             condition = "Lysmer", path;
  dealii::Tensor<1, dim>                  centre;
  DampingBlocks<dim>                      dashpots;
  std::vector<SphericalNode>              springs;
  VectorType                              memory; ///< w [m], one entry per node
};

/// Layer with damping that grows into it, D = rate(x) m: waves of every kind and angle die out slowly instead of reflecting.
///
///   rate = (n + 1) cp ln(1/R) / L s^n,   n = 2,
///
/// s in [0,1] the depth into the layer of thickness L. A P wave decays like exp(-integral rate/(2 cp) ds) on each way, so that
/// the part R of its amplitude returns from a rigid or free end.
template <int dim>
class Sponge : public Load<dim>
{
public:
  void        declare_parameters(Parameters &) override;
  void        finalize(const Parameters &, const Geometry<dim> &) override;
  void        reinit(const Discretization<dim> &, const NodalMass &mass, const MaterialOfBlock &) override;
  void        add(VectorType &, const State<dim> &) override {}
  double      power(const VectorType &) const override { return 0.; }
  void        add_resultants(Resultants<dim> &) const override {}
  bool        admits(Reduction &, const Parameters &) const override;
  std::string description() const override { return "sponge layer"; }
  const DampingBlocks<dim> *damping() const override { return &dashpots; }

private:
  std::string            shape = "sphere", path;
  dealii::Tensor<1, dim> origin, direction;
  double                 start = 1., end = 2., reflection = 1e-3;
  DampingBlocks<dim>     dashpots;
};

/// Names of all boundaries behind which the solid goes on: dashpots hold nothing at rest, something else has to.
template <int dim>
std::vector<std::string> absorbing_boundaries(const std::vector<std::unique_ptr<Load<dim>>> &loads);
} // namespace Arenite
