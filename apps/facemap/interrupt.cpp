#include "interrupt.h"

#include <facemap/error.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>

namespace facemap::program {
namespace {

// A signal handler can reach nothing else than globals, and of these only lock-free ones. It runs on any thread, so
// it sets pending_signal before it reads is_holding, and who holds does it the other way round: one of them sees the
// other.
std::atomic<int> is_holding = 0;
std::atomic<int> pending_signal = 0;
static_assert(std::atomic<int>::is_always_lock_free);

/// A file to be removed.
struct Temporary {
  std::atomic<int> is_taken = 0, is_there = 0;
  char path[PATH_MAX] = {};
};
constexpr int kMostTemporaries = 32;  // a picture has a file for each plane
Temporary temporaries[kMostTemporaries];

[[noreturn]] void end(int signal) {
  for (Temporary& temporary : temporaries) {
    if (temporary.is_there) ::unlink(temporary.path);
  }
  ::_exit(128 + signal);
}

void on_signal(int signal) {
  pending_signal = signal;
  if (!is_holding) end(signal);
}

void end_if_signalled() {
  if (const int signal = pending_signal) end(signal);
}

/// Holds signals off.
class Holding {
 public:
  Holding() {
    is_holding = 1;
    end_if_signalled();
  }
  ~Holding() {
    is_holding = 0;
    end_if_signalled();
  }
  Holding(const Holding&) = delete;
  Holding& operator=(const Holding&) = delete;
};

int free_slot() {
  for (int slot = 0; slot < kMostTemporaries; ++slot) {
    if (temporaries[slot].is_taken.exchange(1) == 0) return slot;
  }
  throw Error("too many files are being written");
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    struct sigaction old {};
    ::sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // nohup stays in force
  }
  ::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow further is then an error of write()
}

void hold_signals(const std::function<void()>& work) {
  const Holding holding;
  work();
}

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path) : slot_(free_slot()) {
  Temporary& temporary = temporaries[slot_];
  if (path.native().size() >= sizeof temporary.path) {
    temporary.is_taken = 0;
    throw Error(path.string() + ": the name is too long");
  }
  std::memcpy(temporary.path, path.c_str(), path.native().size() + 1);
  temporary.is_there = 1;
}

RemovedOnSignal::~RemovedOnSignal() {
  temporaries[slot_].is_there = 0;
  temporaries[slot_].is_taken = 0;
}

}  // namespace facemap::program
