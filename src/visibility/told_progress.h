#pragma once

#include <facemap/error.h>
#include <facemap/viewpoint.h>

#include <cstddef>
#include <mutex>

namespace facemap {

/// Tells whoever asked how much is done, one thread at a time.
class ToldProgress {
 public:
  ToldProgress(const Viewpoint::Progress& progress, std::size_t total) : progress_(progress), total_(total) {}

  /// So many more are done. Throws Error if told to stop, or what the caller's function throws: in one thread alone, so
  /// that it is this that arrives.
  void add(std::size_t count) {
    if (!progress_) return;
    const std::scoped_lock lock(telling_);
    if (is_stopped_) return;
    done_ += count;
    is_stopped_ = true;  // if what follows throws
    if (!progress_(static_cast<double>(done_) / static_cast<double>(total_))) throw Error("stopped");
    is_stopped_ = false;
  }

 private:
  const Viewpoint::Progress& progress_;
  const std::size_t total_;
  std::mutex telling_;
  std::size_t done_ = 0;
  bool is_stopped_ = false;
};

}  // namespace facemap
