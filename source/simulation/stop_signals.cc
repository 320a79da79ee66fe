#include <arenite/simulation/stop_signals.h>

#include <csignal>
#include <initializer_list>

namespace Arenite
{
namespace
{
volatile std::sig_atomic_t wanted = static_cast<int>(Wish::nothing);

extern "C" void note_signal(const int number)
{
  const int wish = static_cast<int>(number == SIGUSR1 ? Wish::checkpoint : Wish::stop);
  if (wish > wanted)
    wanted = wish;
  if (number == SIGTERM || number == SIGINT)
    std::signal(number, SIG_DFL);
}
} // namespace

void catch_signals()
{
  struct sigaction action = {};
  action.sa_handler       = note_signal;
  action.sa_flags         = SA_RESTART; // writing goes on
  for (const int number : {SIGUSR1, SIGUSR2, SIGTERM, SIGINT})
    sigaction(number, &action, nullptr);
}

Wish wish_of_signals() { return static_cast<Wish>(int(wanted)); }

void forget_signals() { wanted = static_cast<int>(Wish::nothing); }
} // namespace Arenite
