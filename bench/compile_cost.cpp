// What including dmp costs a build: seconds and peak memory of the compiler for one law header, for the umbrella, and for the examples, at
// -O2. Compiler, include paths and project folder come from the build system (bench/CMakeLists.txt).
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

struct Cost {
  double seconds = 0.0, mebibytes = 0.0;
  bool compiled = false;
};

/// Runs a shell command; the better of two in seconds, the largest resident size of the compiler in MiB.
Cost measure(const std::string& command) {
  Cost cost{.seconds = 1e30};
  for (int repeat = 0; repeat < 2; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child == 0) {
      execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    cost.seconds = std::min(cost.seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    cost.mebibytes = static_cast<double>(usage.ru_maxrss) / 1024.0;  // of the largest process, the compiler proper
    cost.compiled = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return cost;
}

}  // namespace

int main() {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // it takes minutes: show each line as it is known
  const std::string compile = std::string(DMP_COMPILER) + " -std=c++20 -O2 -march=native -I" + DMP_SOURCE + "/include -I" + DMP_SOURCE +
                              "/examples -isystem " + DMP_EIGEN;
  char folder[] = "/tmp/dmp-compile-cost-XXXXXX";
  if (mkdtemp(folder) == nullptr) return EXIT_FAILURE;
  const std::string temporary = folder, source = temporary + "/unit.cpp", object = temporary + "/unit.o";
  bool all_compiled = true;
  const auto report = [&](const std::string& what, const std::string& file) {
    const Cost cost = measure(compile + " -c " + file + " -o " + object);
    std::printf("%-36s %6.2f s  %6.0f MiB\n", what.c_str(), cost.seconds, cost.mebibytes);
    all_compiled = all_compiled && cost.compiled;
  };
  for (const char* header : {"dmp/kernel/lucy.hpp", "dmp/bond/harmonic.hpp", "dmp/dmp.hpp"}) {
    std::ofstream(source) << "#include <" << header << ">\n";
    report(header, source);
  }
  for (const char* example : {"oscillator_chain", "poiseuille", "taylor_green", "membrane", "dam_break"})
    report(std::string("examples/") + example + ".cpp", std::string(DMP_SOURCE) + "/examples/" + example + ".cpp");
  std::remove(source.c_str());
  std::remove(object.c_str());
  rmdir(folder);
  return all_compiled ? EXIT_SUCCESS : EXIT_FAILURE;
}
