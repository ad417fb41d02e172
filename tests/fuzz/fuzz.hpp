#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

/// What the fuzz targets share. Each is a program of libFuzzer (https://llvm.org/docs/LibFuzzer.html): it calls LLVMFuzzerTestOneInput with
/// bytes that it changes so that ever more branches are reached. A crash, a report of a sanitizer, an exception that leaves the target, and
/// more memory than its limits are findings.
namespace fuzz {

/// A file in memory that has a path.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(::memfd_create("fuzz", 0)), path_("/proc/self/fd/" + std::to_string(descriptor_)) {
    if (descriptor_ < 0) throw std::runtime_error("no file in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  void write(const void* data, std::size_t size) const {
    if (::ftruncate(descriptor_, static_cast<::off_t>(size)) != 0 || ::pwrite(descriptor_, data, size, 0) != static_cast<::ssize_t>(size))
      throw std::runtime_error("cannot write to memory");
  }

 private:
  int descriptor_;
  std::string path_;
};

/// What must hold of an input that was accepted.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

}  // namespace fuzz

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace fuzz {

/// Changes an input, or, where it is far too short and now and then, begins again with `start`. `finish(data, size)` may put it right.
template <class Finish>
std::size_t mutate(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed, const std::string& start,
                   const Finish& finish) {
  if ((size < 8 || seed % 61 == 0) && start.size() <= max_size) {
    size = start.size();
    std::memcpy(data, start.data(), size);
  }
  size = LLVMFuzzerMutate(data, size, max_size);
  if (seed % 8 != 0) finish(data, size);
  return size;
}

}  // namespace fuzz
