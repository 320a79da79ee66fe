#pragma once

#include <string>

namespace Arenite::Test
{
/// Soil of the reference cases.
inline const std::string reference_soil = R"(
subsection Materials
  subsection solid
    set Density       = 2200
    set Young modulus = 200e6
    set Poisson ratio = 0.3
  end
end
)";

/// Pressure step in a cavity of 0.1 m, soil of the reference cases, b = 3a, spectral elements of degree 4.
inline const std::string cavity_scene = reference_soil + R"(
set End time  = 3e-3
set Loads     = cavity pressure, far field
set Receivers = array
subsection Mesh
  set Inner radius = 0.1
  set Outer radius = 0.3
end
subsection Element
  set Type = spectral element
end
subsection Loads
  subsection cavity pressure
    set Boundary  = cavity
    set History   = C3 step
    set Amplitude = 1e6
    set Rise time = 1.5e-4
  end
  subsection far field
    set Type     = absorbing boundary
    set Boundary = outer
  end
end
subsection Receivers
  subsection array
    set Directions = 0.9, 0.35, 0.25; 0.5, 0.3, 0.8; 0.2, 0.75, 0.6
    set Radii      = 0.1, 0.15, 0.2, 0.25
  end
end
subsection Verification
  set Exact solution = spherical cavity
  set Inner radius   = 0.1
end
)";
} // namespace Arenite::Test
