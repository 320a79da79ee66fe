#pragma once

#include <arenite/base/parameters.h>
#include <arenite/io/output_directory.h>
#include <arenite/materials/linear_elastic.h>
#include <arenite/mechanics/nodal_stress.h>

#include <deal.II/lac/vector.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Arenite
{
class StateArchive;

/// Pictures of the state for ParaView and VisIt: solution/step-NNNNNN.RANK.vtu with their .pvtu, listed with their times in
/// solution.pvd (ParaView) and solution.visit (VisIt). The lists name only pictures that are complete.
///
///   displacement [m], velocity [m/s]                         vectors
///   stress [Pa]                                              3 x 3 tensor, tension positive, see nodal_stress(); directions
///                                                            beyond the mesh come last
///   pressure (compression positive), von_mises_stress [Pa]   of that stress
///   material, refinement_level, subdomain, cell fields       constant in each cell
///
/// The cells are those of the computation: high-order cells are written as Lagrange cells through their own polynomial, so
/// that curved faces stay curved. Every value is a point value in single precision; cells do not share points.
template <int dim>
class VTUOutput
{
public:
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// False if the scene wants no pictures.
  bool enabled() const { return interval > 0.; }

  /// True at the step nearest to a multiple of the interval; @p dt is the step that follows.
  bool is_due(double time, double dt) const;

  /// Write one picture; a second one of the same step replaces the first. OutputError if a file is not complete. Collective.
  ///
  /// @param displacement,velocity  at @p time, ghosts and hanging nodes valid
  /// @param materials    by material id; a single one holds for all cells
  /// @param cell_fields  name without spaces -> one value per active cell; the same names on all processes
  void write(const OutputDirectory &directory, const Discretization<dim> &discretization,
             const VectorType &displacement, const VectorType &velocity, const std::vector<LinearElastic> &materials,
             double time, unsigned int step, const std::map<std::string, dealii::Vector<float>> &cell_fields = {},
             const StoredFields<dim> &stored = {});

  /// Which pictures there are, and when the next is due.
  void exchange(StateArchive &);

  /// Pictures of a run that ends at @p end_time, if its step is shorter than the interval.
  unsigned int expected_pictures(double end_time) const;

  /// Size of one picture of the present mesh before compression [byte].
  double expected_bytes(const Discretization<dim> &) const;

  /// Time of the last picture [s]; -1 before the first.
  double last_time() const { return pictures.empty() ? -1. : pictures.back().time; }

  double       interval     = 0.;
  unsigned int subdivisions = 0;

private:
  struct Picture
  {
    double                   time;
    std::string              record; ///< .pvtu, relative to the output directory
    std::vector<std::string> pieces;
  };

  /// Components of all point fields that every picture has, without positions.
  static constexpr unsigned int n_field_rows = 2 * dim + 9 + 5;

  unsigned int parts(const Discretization<dim> &discretization) const
  {
    return subdivisions > 0 ? subdivisions : discretization.degree();
  }

  double               next_time = 0.;
  std::vector<Picture> pictures;
};
} // namespace Arenite
