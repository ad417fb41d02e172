// What is left in the folder when a run is killed, and what is said when the disk is full or the place cannot be written.
#include <doctest/doctest.h>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>
#include <dmp/io/checkpoint.hpp>
#include "io/temporary_folder.hpp"
#include <sys/wait.h>
#include <unistd.h>

using dmp::io::CheckpointReader;
using dmp::io::CheckpointWriter;

namespace {

constexpr const char* scene = "dam break 2D";

/// A checkpoint that tells in every number which one it is; the next one has another size.
void write_numbered(const std::filesystem::path& path, std::uint64_t number) {
  CheckpointWriter checkpoint(path, scene);
  checkpoint.add("step", std::span(&number, 1));
  checkpoint.add("density", std::vector<double>(100000 + number % 7 * 1000, static_cast<double>(number)));
  checkpoint.add("id", std::vector<std::uint64_t>(1000, number));
  checkpoint.commit();
}

/// Its number, if it is whole and all of one write; CheckpointError or a failed check otherwise.
std::uint64_t whole_number(const std::filesystem::path& path) {
  const CheckpointReader checkpoint(path, scene);
  const std::uint64_t number = checkpoint.read<std::uint64_t>("step").at(0);
  CHECK(checkpoint.read<double>("density") == std::vector<double>(100000 + number % 7 * 1000, static_cast<double>(number)));
  CHECK(checkpoint.read<std::uint64_t>("id") == std::vector<std::uint64_t>(1000, number));
  return number;
}

}  // namespace

TEST_CASE("kill -9 at any time while checkpoints are written leaves a whole one, never older than before, and at most one part") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint", part = folder / "checkpoint.part";
  std::mt19937 random(9);
  std::uint64_t newest = 0;
  int cut_short = 0;
  const auto start = std::chrono::steady_clock::now();
  for (; newest < 5; ++newest) write_numbered(path, newest + 1);
  const std::chrono::duration<double> one_write = (std::chrono::steady_clock::now() - start) / 5;
  std::uniform_real_distribution<double> writes(0.0, 3.0);  // until the child is killed
  for (int kill = 0; kill < 40; ++kill) {
    const ::pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0)
      for (std::uint64_t number = newest + 1;; ++number) write_numbered(path, number);
    std::this_thread::sleep_for(writes(random) * one_write);
    REQUIRE(::kill(child, SIGKILL) == 0);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CAPTURE(kill);
    const std::uint64_t found = whole_number(path);
    CHECK(found >= newest);
    newest = found;
    cut_short += std::filesystem::exists(part) ? 1 : 0;
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == (std::filesystem::exists(part) ? 2 : 1));
  }
  CHECK(newest > 5);     // the children got somewhere,
  CHECK(cut_short > 5);  // and kills struck in the middle of writing
  write_numbered(path, newest + 1);
  CHECK(whole_number(path) == newest + 1);
  CHECK_FALSE(std::filesystem::exists(part));  // the next one uses it up
}
