#pragma once

#include <arenite/base/formula.h>
#include <arenite/mesh/geometry.h>

#include <string>
#include <vector>

namespace Arenite
{
/// Box with its sides along the axes, in layers of material along x, and what a map of its coarse vertices makes of it.
template <int dim>
class Box : public Geometry<dim>
{
public:
  Box();
  void declare_parameters(Parameters &) override;
  void finalize(const Parameters &) override;
  void create(dealii::Triangulation<dim> &) const override;
  bool admits(Reduction &, const Parameters &) const override;

private:
  dealii::Tensor<1, dim>    lower, upper;
  std::vector<std::string>  cells, layer_words;
  std::vector<unsigned int> repetitions;
  std::vector<double>       layers; ///< first coordinate of the borders between materials, ascending
  double                    distortion = 0.;
  std::string               map_text, path;
  PlaceFormulas<dim>        map;

  void read_layers(const Parameters &);
  void read_map(const Parameters &);
  void distort(dealii::Triangulation<dim> &) const;
};
} // namespace Arenite
