// CheckpointReader: any bytes are refused with a CheckpointError that names the file, or are sections no longer than the file.
#include <array>
#include <string>
#include <vector>
#include <dmp/io/checkpoint.hpp>
#include "fuzz/fuzz.hpp"
#include "io/temporary_folder.hpp"

namespace {

constexpr const char* signature = "scene";

std::string start() {
  const test::TemporaryFolder folder;
  dmp::io::CheckpointWriter checkpoint(folder / "checkpoint", signature);
  checkpoint.add("density", std::vector<double>{1.0, 2.5});
  checkpoint.add("id", std::array<std::uint16_t, 3>{1, 2, 3});
  checkpoint.add("none", std::vector<double>{});
  checkpoint.commit();
  return test::read_bytes(folder / "checkpoint");
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  static const std::string whole = start();
  return fuzz::mutate(data, size, max_size, seed, whole, fuzz::correct_crcs);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile file;
  file.write(data, size);
  const auto refused = [](const auto& read) {
    try {
      read();
    } catch (const dmp::io::CheckpointError& error) {
      fuzz::require(std::string(error.what()).starts_with("io::checkpoint: '" + file.path() + "': "), "an error must name the file");
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
