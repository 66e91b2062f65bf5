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
// it sets pending_signal before it reads is_writing, and a writer does it the other way round: one of them sees the
// other.
std::atomic<int> is_writing = 0;
std::atomic<int> pending_signal = 0;
std::atomic<int> has_temporary = 0;
static_assert(std::atomic<int>::is_always_lock_free);
char temporary[PATH_MAX];

void on_signal(int signal) {
  const bool is_first = pending_signal.exchange(signal) == 0;
  if (is_writing && is_first) return;
  if (has_temporary) ::unlink(temporary);
  ::_exit(128 + signal);
}

void end_if_signalled() {
  if (const int signal = pending_signal) ::_exit(128 + signal);
}

/// Holds signals off.
class Writing {
 public:
  Writing() {
    is_writing = 1;
    end_if_signalled();
  }
  ~Writing() {
    is_writing = 0;
    end_if_signalled();
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
};

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
  const Writing writing;
  write();
}

RemovedOnSignal::RemovedOnSignal(const std::filesystem::path& path) {
  if (path.native().size() >= sizeof temporary) throw Error(path.string() + ": the name is too long");
  std::memcpy(temporary, path.c_str(), path.native().size() + 1);
  has_temporary = 1;
}

RemovedOnSignal::~RemovedOnSignal() { has_temporary = 0; }

}  // namespace facemap::program
