#pragma once
#include <dmp/core/threads.hpp>

namespace test {

/// Uses `count` threads as long as it lives.
class Threads {
 public:
  explicit Threads(int count) : before_(dmp::available_threads()) { dmp::use_threads(count); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads() { dmp::use_threads(before_); }

 private:
  int before_;
};

}  // namespace test
