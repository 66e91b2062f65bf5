#include "interrupt.h"

#include <facemap/error.h>
#include <unistd.h>

#include <climits>
#include <csignal>
#include <cstring>

namespace facemap::program {
namespace {

// A signal handler can reach nothing else than globals of these types.
volatile std::sig_atomic_t is_writing = 0;
volatile std::sig_atomic_t pending_signal = 0;
volatile std::sig_atomic_t has_temporary = 0;
char temporary[PATH_MAX];

void on_signal(int signal) {
  if (is_writing && !pending_signal) {
    pending_signal = signal;
    return;
  }
  if (has_temporary) ::unlink(temporary);
  ::_exit(128 + signal);
}

}  // namespace

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    ::sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // nohup stays in force
  }
  ::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow further is then an error of write()
}

void write_whole(const std::function<void()>& write) {
  is_writing = 1;
  try {
    write();
  } catch (...) {
    is_writing = 0;
    throw;
  }
  is_writing = 0;
  if (pending_signal) throw Interrupted{pending_signal};
}

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path) {
  if (path.native().size() >= sizeof temporary) throw Error(path.string() + ": the name is too long");
  std::memcpy(temporary, path.c_str(), path.native().size() + 1);
  has_temporary = 1;
}

RemovedOnSignal::~RemovedOnSignal() { has_temporary = 0; }

}  // namespace facemap::program
