#pragma once

#include <arenite/base/parameters.h>
#include <arenite/mechanics/cell_fields.h>

#include <string>
#include <vector>

namespace Arenite
{
/// Words of `Type` of a set of receivers, those of points first; and its sentence in the manual.
const std::vector<std::string> &receiver_types();
extern const char *const        receiver_type_sentence;

/// Names and places of one set of receivers, as a scene gives them.
///
/// Points and directions may be given in three dimensions in every scene, see reduce().
///
///   Type = points   Points = x,y,z; ...                        p1, p2, ...
///                   or Directions = x,y,z; ... and Radii = r, ...   d1r1, d1r2, ...: every radius in every direction
///   Type = line     Start, End, Number                         p1 ... pN
///   Type = plane    Corner, First edge, Second edge, First number, Second number; the second edge runs fastest
template <int dim>
class ReceiverPoints
{
public:
  /// Entries of the current section.
  void declare_parameters(Parameters &);
  void finalize(const Parameters &);

  /// Lines and planes go to HDF5, points to CSV.
  bool in_table() const { return type == "points"; }

  std::vector<std::string>        names;
  std::vector<dealii::Point<dim>> positions;

private:
  std::string                     path, type = "points";
  std::vector<dealii::Point<dim>> points, directions;
  std::vector<std::string>        radii;
  dealii::Tensor<1, dim>          start, end, corner, first_edge, second_edge;
  unsigned int                    number = 101, first_number = 51, second_number = 51;
};

/// Places of points in the mesh. A point touches every cell that contains it within 1e-9 of the cell's size, on whatever process;
/// the mean over all of them does not depend on the partition.
template <int dim>
class PointLocation
{
public:
  /// A cell of this process and a point that it touches.
  struct Contact
  {
    unsigned int           point, cell;
    double                 weight; ///< 1 / number of cells that the point touches
    ShapeFactors<dim>      factors;
    dealii::Tensor<2, dim> inverse_jacobian;
  };

  /// Locate @p points. A point outside moves to the nearest boundary point if that is within 5 % of the size of the cell there
  /// (curved boundaries are approximated); one that is farther away raises InputError with its name and the extent of the mesh.
  /// Collective. @p label stands in front of messages.
  void reinit(const CellFields<dim> &fields, const std::vector<dealii::Point<dim>> &points,
              const std::vector<std::string> &names, const std::string &label);

  std::vector<Contact>            contacts;
  std::vector<dealii::Point<dim>> positions; ///< where the points are now: inside, or on the boundary

private:
  void project(const CellFields<dim> &fields, const std::vector<unsigned int> &outside,
               const std::vector<std::string> &names, const std::string &label);
};
} // namespace Arenite
