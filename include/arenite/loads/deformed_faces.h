#pragma once

#include <arenite/loads/resultant.h>
#include <arenite/mechanics/discretization.h>

#include <array>
#include <vector>

namespace Arenite
{
/// Area vectors of boundaries on the deformed body x = X + u, for forces that follow the surface.
///
/// The rule is that of for_each_face_point(). With the tangents t_k = sum_a x_a dN_a/dxi_k of the face's own nodes
///
///   n dA = t_1 x t_2 dxi_1 dxi_2,     (t_y, -t_x) dxi in two dimensions,     1 in one,
///
/// with the sign that points out of the cell, times the measure of kinematics.h at the deformed radius.
template <int dim>
class DeformedFaces
{
public:
  /// Faces of the owned cells. @p discretization must outlive this.
  void reinit(const Discretization<dim> &discretization, const std::vector<dealii::types::boundary_id> &ids);

  /// integral of N_i n dA [m^2] per entry of owned nodes; hanging nodes gave to their masters, ghosts to their owners. Needs the
  /// displacement with valid ghosts and hanging nodes, allocates nothing. Only entries at nodes() are of interest. Collective.
  const VectorType &areas(const VectorType &displacement);

  /// integral of n dA and of dA over the faces of this process at the last areas(), one entry per boundary: forces under a pull of 1 Pa.
  const std::vector<Resultant<dim>> &sums() const { return sum; }

  /// Owned nodes with an area of any displacement, ascending.
  const std::vector<unsigned int> &nodes() const { return owned_nodes; }

private:
  static constexpr unsigned int n_tangents = dim == 1 ? 1 : dim - 1; ///< unused in one dimension

  /// What a node of a face has to do with a point of the rule. Where nodes are points most pairs have nothing in common.
  struct Share
  {
    unsigned int                   node; ///< of the face
    double                         value;
    std::array<double, n_tangents> slope;
  };

  void make_shares();
  void find_nodes();

  const Discretization<dim> *discretization = nullptr;
  unsigned int               n              = 0; ///< nodes per face
  std::vector<double>        weight;             ///< of each point
  std::vector<unsigned int>  start;              ///< of each point in shares
  std::vector<Share>         shares;             ///< the same for all faces
  std::vector<unsigned int>  face_nodes;         ///< n local nodes per face
  std::vector<double>        sign;               ///< per face
  std::vector<unsigned int>  boundary;           ///< per face, position in the list of ids
  std::vector<unsigned int>  owned_nodes, touched_nodes;
  VectorType                 area;

  std::vector<Resultant<dim>> sum;

  std::vector<dealii::Point<dim>>     position; ///< nodes of the present face
  std::vector<dealii::Tensor<1, dim>> part;     ///< their areas
};
} // namespace Arenite
