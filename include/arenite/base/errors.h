#pragma once

#include <arenite/base/parameters.h>

#include <stdexcept>

namespace Arenite
{
// InputError (parameters.h), PhysicsAlarm and OutputError are collective: whoever throws one makes sure that every
// process throws the same, because the program then ends in order through MPI_Finalize with the code below. What only
// one process can see must be agreed upon first (one reduction). main() ends the run also when this is forgotten, but
// after a delay and with the noise of MPI_Abort.

/// The computation left physics: not a number, inverted cell, energy out of balance. Names time and place; exit code 3.
class PhysicsAlarm : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// A result could not be written completely: disk full, directory gone, no permission. Names the file; exit code 4.
class OutputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// No checkpoint, or none that can be used. Names the folder and the reason; exit code 5.
class CheckpointError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
} // namespace Arenite
