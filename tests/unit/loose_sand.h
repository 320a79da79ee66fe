#pragma once

#include <arenite/materials/cap_surface.h>

/// Surface of a loose sand, of the order of size of Roger (2015), with the cap at @p position [Pa]; not finalized.
inline Arenite::CapSurface loose_sand(const double position = 1e6)
{
  Arenite::CapSurface s;
  s.alpha            = 64200.;
  s.gamma            = 5890.;
  s.beta             = 3.4283e-7;
  s.theta            = 0.18257;
  s.axis_ratio       = 5.;
  s.initial_position = position;
  s.hardening_rate   = 9.52e-9;
  s.hardening_limit  = 0.2142;
  s.tension_limit    = 5000.;
  return s;
}
