#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <dmp/io/detail/crc32.hpp>
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

/// Puts right the CRCs of a checkpoint, as far as its marks and lengths lead through the bytes (format: io/checkpoint.hpp). Without this
/// hardly any change gets past them.
inline void correct_crcs(std::uint8_t* bytes, std::size_t size) {
  std::size_t at = 8;  // after the magic
  const auto has = [&](std::uint64_t more) { return at <= size && more <= size - at; };
  const auto number = [&]<class T>(std::size_t offset, T value) {
    std::memcpy(&value, bytes + at + offset, sizeof value);
    return value;
  };
  const auto close = [&](std::uint64_t length) {  // the CRC of the next `length` bytes behind them; whether there was room
    if (!has(length) || !has(length + 4)) return false;
    const std::uint32_t crc = dmp::io::detail::crc32(bytes + at, static_cast<std::size_t>(length));
    std::memcpy(bytes + at + length, &crc, sizeof crc);
    at += static_cast<std::size_t>(length) + 4;
    return true;
  };
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max() / 4;
  if (!has(16)) return;
  const auto signature = number(8, std::uint64_t{});
  if (signature > most || !close(16 + signature)) return;
  while (has(20)) {
    if (number(0, std::uint32_t{}) != 1) {
      close(20);
      return;
    }
    if (!has(28)) return;
    const auto name = number(4, std::uint64_t{}), element = number(12, std::uint64_t{}), count = number(20, std::uint64_t{});
    if (name > most || !close(28 + name) || (element > 0 && count > most / element) || !close(element * count)) return;
  }
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
