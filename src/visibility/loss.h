#pragma once

#include <algorithm>
#include <mutex>

namespace facemap {

/// When to make what would have saved time before: once as much is lost as making it takes. So at most twice the time
/// is spent that had to be.
class Loss {
 public:
  /// Adds what a question loses; true if it is time.
  bool add(double lost, double making) {
    const std::scoped_lock lock(adding_);
    lost_ += std::max(lost, 0.0);
    return lost_ >= making;
  }

 private:
  std::mutex adding_;
  double lost_ = 0;
};

}  // namespace facemap
