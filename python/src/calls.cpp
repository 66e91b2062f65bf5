#include "calls.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace facemap::python {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};  ///< a person does not notice

/// Shared by the thread that works and the one that waits.
class Work {
 public:
  explicit Work(const std::function<void(const Report&)>& work) : thread_([this, &work] { run(work); }) {}
  ~Work() { thread_.join(); }

  /// Waits a little; whether all is done.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, kBetweenLooks, [this] { return has_ended_; });
  }

  void stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }

  struct State {
    double fraction = 0;
    const char* phase = "";
  };
  State state() {
    const std::lock_guard lock(mutex_);
    return state_;
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void run(const std::function<void(const Report&)>& work) {
    try {
      work([this](double fraction, const char* phase) { return report({fraction, phase}); });
    } catch (...) {
      failure_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    ended_.notify_one();
  }

  bool report(State state) {
    const std::lock_guard lock(mutex_);
    state_ = state;
    return !is_stopped_;
  }

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false, is_stopped_ = false;
  State state_;
  std::exception_ptr failure_;  ///< written before has_ended_
  std::thread thread_;          ///< last: it uses the others
};

/// Throws what a signal's handler or the progress function raises.
void look_at_signals(const py::object& progress, const Work::State& state) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!progress.is_none()) progress(state.fraction, state.phase);
}

}  // namespace

void call(const std::function<void()>& work) {
  const py::gil_scoped_release unlocked;
  work();
}

void call_interruptibly(const std::function<void(const Report&)>& work, const py::object& progress) {
  std::exception_ptr raised;
  {
    const py::gil_scoped_release unlocked;
    Work working(work);
    while (!working.wait()) {
      if (raised) continue;
      const py::gil_scoped_acquire locked;
      try {
        look_at_signals(progress, working.state());
      } catch (const py::error_already_set&) {
        raised = std::current_exception();
        working.stop();
      }
    }
    if (!raised) working.rethrow();
  }
  if (raised) std::rethrow_exception(raised);
  if (!progress.is_none()) progress(1.0, "done");
}

}  // namespace facemap::python
