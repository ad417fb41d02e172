// CheckpointReader: any bytes are refused with a CheckpointError that names the file, or are sections no longer than the file.
#include <array>
#include <string>
#include <vector>
#include <dmp/io/checkpoint.hpp>
#include "fuzz/checkpoint.hpp"

namespace {

constexpr const char* signature = "scene";

}  // namespace

void fuzz::write_start(const std::string& path) {
  dmp::io::CheckpointWriter checkpoint(path, signature);
  checkpoint.add("density", std::vector<double>{1.0, 2.5});
  checkpoint.add("id", std::array<std::uint16_t, 3>{1, 2, 3});
  checkpoint.add("none", std::vector<double>{});
  checkpoint.commit();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile file;
  file.write(data, size);
  const auto refused = [](const auto& read) {
    try {
      read();
    } catch (const dmp::io::CheckpointError& error) {
      fuzz::require_named(error, file);
    }
  };
  refused([&] {
    const dmp::io::CheckpointReader checkpoint(file.path(), signature);
    const auto read = [&]<class T>(const char* name, T) {
      refused([&] { fuzz::require(checkpoint.read<T>(name).size() * sizeof(T) <= size, "a section must not be longer than the file"); });
    };
    read("density", double{});
    read("id", std::uint16_t{});
    read("none", double{});
    read("none", char{});
  });
  return 0;
}
