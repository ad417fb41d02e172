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
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>
#include <dmp/io/checkpoint.hpp>
#include <dmp/io/csv.hpp>
#include <dmp/io/output_folder.hpp>
#include <dmp/io/plot.hpp>
#include <dmp/io/vtk.hpp>
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

/// Writes a file on disks that are any number of bytes too small: `complaint` must be said, and what was there must stay. Then on one that
/// is just large enough.
template <class Error, class Write>
void check_whole_or_former(const std::filesystem::path& path, const Write& write, const std::string& complaint) {
  write(path);
  const std::string whole = test::read_bytes(path), former = "former";
  REQUIRE(whole.size() > 100);
  const auto error_on_disk_of = [&](std::size_t bytes) {
    const test::SmallDisk disk(bytes);
    return test::error_of<Error>([&] { write(path); });
  };
  test::write_bytes(path, former);
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += bytes < 100 || bytes + 100 > whole.size() ? 1 : 97) {
    CAPTURE(bytes);
    CHECK(error_on_disk_of(bytes) == complaint);
    CHECK(test::read_bytes(path) == former);
    CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  }
  CHECK(error_on_disk_of(whole.size()).empty());
  CHECK(test::read_bytes(path) == whole);
}

/// Where no file can be made, even by root, and the system's reason.
struct ImpossiblePlace {
  std::filesystem::path path;
  std::string reason;
};
std::vector<ImpossiblePlace> impossible_places(const test::TemporaryFolder& folder) {
  test::write_bytes(folder / "file", "");
  std::vector<ImpossiblePlace> places{{folder / "file/result", "Not a directory"},
                                      {folder / "missing/result", "No such file or directory"},
                                      {folder / std::string(300, 'x'), "File name too long"}};
  if (std::filesystem::is_directory("/proc/self/fd")) places.push_back({"/proc/self/fd/result", "No such file or directory"});
  return places;
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

TEST_CASE("full disk: by however many bytes it is too small for a checkpoint, a .vtp or a .pvd, it is an error, and the former one stays") {
  const test::TemporaryFolder folder;
  const auto too_large = [](const std::filesystem::path& path) { return "io: cannot write '" + path.string() + ".part': File too large"; };
  const auto checkpoint = folder / "checkpoint", cloud = folder / "water.vtp", index = folder / "run.pvd";
  check_whole_or_former<dmp::io::CheckpointError>(
      checkpoint,
      [](const auto& path) {
        CheckpointWriter writer(path, scene);
        writer.add("density", std::vector<double>(1000, 1.0));  // more than is buffered
        writer.commit();
      },
      "io::checkpoint: '" + checkpoint.string() + "': " + too_large(checkpoint));
  const std::vector<dmp::Vector<2>> x(300, dmp::Vector<2>{1, 2});
  check_whole_or_former<dmp::io::WriteError>(
      cloud, [&](const auto& path) { write_vtp(path, dmp::io::PointCloud<2>{.positions = x}); }, too_large(cloud));
  check_whole_or_former<dmp::io::WriteError>(index, [](const auto& path) { const dmp::io::TimeSeries series(path); }, too_large(index));
}

TEST_CASE("full disk: a table keeps the rows it has, the row that does not fit is an error with file and reason, and again the next time") {
  const test::TemporaryFolder folder;
  const auto path = folder / "table.csv";
  const std::string head = "time [s],front [m]\n", rows = "0.1,1\n0.2,2\n";
  const std::string complaint = "io: cannot write '" + path.string() + "': File too large";
  for (std::size_t bytes = 0; bytes < (head + rows).size(); ++bytes) {
    CAPTURE(bytes);
    int rows_written = -1;
    std::string before;
    const std::string error = [&] {
      const test::SmallDisk disk(bytes);
      return test::error_of<dmp::io::WriteError>([&] {
        dmp::io::CsvTable table(path, {{"time", "s"}, {"front", "m"}});
        ++rows_written;
        table.row({0.1, 1.0});
        ++rows_written;
        before = test::error_of<dmp::io::WriteError>([&] { table.row({0.2, 2.0}); });
        table.row({0.3, 3.0});
      });
    }();
    CHECK(error == complaint);
    CHECK(before == (rows_written == 1 ? complaint : ""));
    CHECK(rows_written == (bytes < head.size() ? -1 : bytes < (head + "0.1,1\n").size() ? 0 : 1));
    CHECK(test::read_bytes(path) == (head + rows).substr(0, bytes));
  }
}

TEST_CASE("full disk: an output folder into which nothing fits is refused before anything is computed, and so is the script of a plot") {
  const test::TemporaryFolder folder;
  const auto results = folder / "results";
  const dmp::io::OutputFolder output(results);
  std::string of_folder, of_plot;
  {
    const test::SmallDisk disk(5);
    of_folder = test::error_of<dmp::ParameterError>([&] { const dmp::io::OutputFolder again(results); });
    of_plot = test::error_of<dmp::io::WriteError>([&] { dmp::io::plot(output, "front", "plot 'front.csv' using 1:2"); });
  }
  CHECK(test::contains(of_folder, "io::OutputFolder: cannot write into '" + results.string() + "': "));
  CHECK(test::contains(of_folder, "File too large"));
  CHECK(of_plot == "io: cannot write '" + (results / "front.gp.part").string() + "': File too large");
  CHECK(std::filesystem::is_empty(results));
}

TEST_CASE("a place where no file can be made is refused by every writer, with the file and the system's reason") {
  const test::TemporaryFolder folder;
  const std::vector<dmp::Vector<2>> x(3, dmp::Vector<2>{1, 2});
  for (const ImpossiblePlace& place : impossible_places(folder)) {
    const std::filesystem::path& path = place.path;
    const std::string direct = "io: cannot write '" + path.string() + "': " + place.reason,
                      part = "io: cannot write '" + path.string() + ".part': " + place.reason;
    const auto error = [](const auto& write) { return test::error_of<std::runtime_error>(write); };
    CHECK(error([&] { const dmp::io::CsvTable table(path, {{"time", "s"}}); }) == direct);
    CHECK(error([&] { const CheckpointWriter checkpoint(path, scene); }) == "io::checkpoint: '" + path.string() + "': " + part);
    CHECK(error([&] { write_vtp(path, dmp::io::PointCloud<2>{.positions = x}); }) == part);
    CHECK(error([&] { const dmp::io::TimeSeries series(path); }) == part);
  }
}
