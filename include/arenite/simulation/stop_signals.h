#pragma once

namespace Arenite
{
/// What the user asks of a running program.
enum class Wish
{
  nothing,
  checkpoint, ///< and go on
  stop        ///< with a checkpoint
};

/// Turns signals into wishes: SIGUSR1 asks for a checkpoint, SIGUSR2, SIGTERM and SIGINT to stop. The second SIGTERM or SIGINT ends the
/// program at once. Before catch_signals() they do what the system does.
void catch_signals();

/// Of this process since the last forget_signals(), the strongest.
Wish wish_of_signals();
void forget_signals();
} // namespace Arenite
