#pragma once
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <dmp/io/checkpoint.hpp>
#include <dmp/io/detail/crc32.hpp>
#include "fuzz/fuzz.hpp"
#include "io/temporary_folder.hpp"

/// What fuzz targets share that read checkpoints.
namespace fuzz {

/// Writes the checkpoint from which changes start; each target has its own.
void write_start(const std::string& path);

inline void require_named(const dmp::io::CheckpointError& error, const MemoryFile& file) {
  require(std::string(error.what()).starts_with("io::checkpoint: '" + file.path() + "': "), "an error must name the file");
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

inline std::string start() {
  const test::TemporaryFolder folder;
  const std::string path = (folder / "checkpoint").string();
  write_start(path);
  return test::read_bytes(path);
}

}  // namespace fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  static const std::string whole = fuzz::start();
  return fuzz::mutate(data, size, max_size, seed, whole, fuzz::correct_crcs);
}
