#pragma once
#include <chrono>
#include <cstdio>
#include <unistd.h>

namespace dmp::simulation {

/// A bar on standard error: how far the run is, and how long it will take. Nothing when standard error is not a terminal.
class Progress {
 public:
  Progress(bool wanted, double from, double until)
      : shows_(wanted && isatty(STDERR_FILENO) != 0), from_(from), until_(until), start_(Clock::now()), last_(start_) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (shows_) std::fputs("\r\033[K", stderr);
  }

  void show(double time) {
    if (!shows_) return;
    const auto now = Clock::now();
    if (std::chrono::duration<double>(now - last_).count() < 0.2) return;
    last_ = now;
    const double done = (time - from_) / (until_ - from_), spent = std::chrono::duration<double>(now - start_).count();
    char bar[31];
    for (int k = 0; k < 30; ++k) bar[k] = k < 30.0 * done ? '#' : '.';
    bar[30] = '\0';
    std::fprintf(stderr, "\r\033[K[%s] %5.1f %%  t = %.4g s  %.0f s left", bar, 100.0 * done, time, spent * (1.0 - done) / done);
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool shows_;
  double from_, until_;
  Clock::time_point start_, last_;
};

}  // namespace dmp::simulation
