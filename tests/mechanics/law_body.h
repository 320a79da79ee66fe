#pragma once

#include <arenite/materials/law_list.h>
#include <arenite/materials/material_point.h>
#include <arenite/mechanics/point_motion.h>
#include <arenite/time/dynamics.h>

#include <deal.II/base/quadrature_lib.h>

#include <list>

#include "body.h"

namespace Arenite::Test
{
/// A law of the list with the parameters of one block of tests/data/laws.
inline std::unique_ptr<BatchLaw> example_law(const int lanes, const std::string &name, const std::string &wanted)
{
  std::string file = name;
  std::replace(file.begin(), file.end(), ' ', '_');
  Parameters parameters = Parameters::from_files({ARENITE_SOURCE_DIR "/tests/data/laws/" + file + ".prm"});
  std::list<std::unique_ptr<BatchLaw>> laws; // entries are bound to them until parse()
  std::list<std::string>               texts;
  std::vector<std::string>             blocks = parameters.peek_list("Blocks"), unused;
  parameters.add_list("Blocks", unused, "");
  {
    const auto materials = parameters.section("Materials");
    for (const std::string &block : blocks)
      {
        const auto section = parameters.section(block);
        parameters.add_text("Law", texts.emplace_back(), "");
        laws.push_back(material_laws(lanes).make(name));
        laws.back()->declare_parameters(parameters);
      }
  }
  parameters.parse();
  for (auto &law : laws)
    law->finalize(parameters);
  auto law = laws.begin();
  std::advance(law, std::find(blocks.begin(), blocks.end(), wanted) - blocks.begin());
  return std::move(*law);
}

/// A mesh whose only block has a law of its own, driven by displacements of its nodes.
template <int dim>
struct LawBody : BodyOf<dim>
{
  LawBody(const ElementChoice &choice, const std::string &kinematics, std::unique_ptr<const BatchLaw> law,
          const std::function<void(typename BodyOf<dim>::Triangulation &)> &make_mesh,
          const Symmetry symmetry = cartesian<dim>(), const std::string &rate = "Jaumann")
    : BodyOf<dim>(choice, make_mesh, soil(), symmetry)
  {
    KinematicsChoice motion;
    motion.kinematics = kinematics;
    motion.rate       = rate;
    std::vector<std::unique_ptr<InternalForce<dim>>> blocks;
    blocks.push_back(make_law_force<dim>(choice, motion, std::move(law), numbers::invalid_material_id, symmetry));
    this->dynamics = std::make_unique<Dynamics<dim>>(this->discretization, std::move(blocks),
                                                     std::vector<std::unique_ptr<Load<dim>>>(), this->constraints);
    this->dynamics->reinit(this->state);
    this->dynamics->compute_internal_force(this->state); // at rest
  }

  /// One step of length @p dt to the displacements u(X). The force of the state is that of the end.
  void move(const std::function<Tensor<1, dim>(const Point<dim> &)> &u, const double dt)
  {
    this->set(this->state.displacement, u);
    this->state.time += dt;
    this->state.dt_last = dt;
    ++this->state.step;
    this->state.force = 0.;
    this->dynamics->compute_internal_force(this->state);
  }

  /// [node][quantity] of the first cell, see InternalForce::point_values().
  std::vector<double> values(const unsigned int cell = 0) const
  {
    std::vector<double> result;
    this->dynamics->point_values(this->state, cell, result);
    return result;
  }

  std::size_t n_values() const { return 6 + this->dynamics->names_of_point_values().size(); }
};

/// Every element of a dimension, viscosity off.
inline std::vector<ElementChoice> elements_for_laws()
{
  std::vector<ElementChoice> choices;
  for (const unsigned int degree : all_elements)
    choices.push_back(element(degree));
  choices.push_back(element(1));
  choices.back().volumetric_strain = "mean dilatation";
  for (ElementChoice &choice : choices)
    choice.linear_viscosity = choice.quadratic_viscosity = 0.;
  return choices;
}
} // namespace Arenite::Test
