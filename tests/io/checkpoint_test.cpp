#include <doctest/doctest.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>
#include <dmp/io/checkpoint.hpp>
#include "io/temporary_folder.hpp"
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using dmp::io::CheckpointError;
using dmp::io::CheckpointReader;
using dmp::io::CheckpointWriter;

static_assert(!std::is_copy_constructible_v<CheckpointWriter>);

namespace {

struct Bond {
  std::uint32_t i, j;
  double rest_length;
  friend bool operator==(const Bond&, const Bond&) = default;
};

constexpr const char* scene = "dam break 2D, 10 particles";

/// A small checkpoint of three sections, as bytes.
std::string small_checkpoint(const std::filesystem::path& path) {
  CheckpointWriter checkpoint(path, scene);
  checkpoint.add("density", std::vector<double>{1.0, 2.5});
  checkpoint.add("id", std::array<std::uint16_t, 3>{1, 2, 3});
  checkpoint.add("none", std::vector<double>{});
  checkpoint.commit();
  return test::read_bytes(path);
}
std::string complaint_about_file(const std::filesystem::path& path, const std::string& signature = scene) {
  return test::error_of<CheckpointError>([&] { const CheckpointReader reader(path, signature); });
}
std::string where(const std::filesystem::path& path) { return "io::checkpoint: '" + path.string() + "': "; }

}  // namespace

TEST_CASE("CRC-32 gives the published check value, and detects each single bit flipped") {
  const std::string digits = "123456789";
  CHECK(dmp::io::detail::crc32(digits.data(), digits.size()) == 0xCBF43926u);
  CHECK(dmp::io::detail::crc32("", 0) == 0u);
  std::string text = "The quick brown fox jumps over the lazy dog";
  const std::uint32_t expected = 0x414FA339u;  // published for this text
  CHECK(dmp::io::detail::crc32(text.data(), text.size()) == expected);
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
    CHECK(dmp::io::detail::crc32(text.data(), text.size()) != expected);
    text[bit / 8] = static_cast<char>(text[bit / 8] ^ (1 << (bit % 8)));
  }
}

TEST_CASE("checkpoint: numbers come back bit for bit: any NaN, denormals, signed zeros, structs, nothing at all") {
  const test::TemporaryFolder folder;
  std::mt19937_64 random(3);
  const double signalling_nan = std::bit_cast<double>(0x7FF0000000000001u), nan_with_payload = std::bit_cast<double>(0xFFF8DEADBEEF1234u);
  std::vector<double> numbers{0.0, -0.0, 5e-324, -5e-324, std::numeric_limits<double>::infinity(), signalling_nan, nan_with_payload};
  while (numbers.size() < 1001) numbers.push_back(std::bit_cast<double>(random()));
  const std::vector<Bond> bonds{{1, 2, 0.5}, {3, 4, -0.0}};
  const std::vector<float> floats{1.5f, -0.0f};
  const std::uint64_t step = 123456789012345;
  {
    CheckpointWriter checkpoint(folder / "checkpoint", scene);
    checkpoint.add("position", numbers);
    checkpoint.add("bonds", bonds);
    checkpoint.add("step", std::span(&step, 1));
    checkpoint.add("", floats);
    checkpoint.add("name with \n anything", std::string("text"));
    checkpoint.add("nothing", std::vector<Bond>{});
    checkpoint.commit();
  }
  const CheckpointReader checkpoint(folder / "checkpoint", scene);
  const auto read = checkpoint.read<double>("position");
  REQUIRE(read.size() == numbers.size());
  CHECK(std::memcmp(read.data(), numbers.data(), numbers.size() * sizeof(double)) == 0);
  CHECK(checkpoint.read<Bond>("bonds") == bonds);
  CHECK(checkpoint.read<std::uint64_t>("step") == std::vector<std::uint64_t>{step});
  CHECK(checkpoint.read<float>("") == floats);
  CHECK(checkpoint.read<char>("name with \n anything") == std::vector<char>{'t', 'e', 'x', 't'});
  CHECK(checkpoint.read<Bond>("nothing").empty());
  CHECK(checkpoint.contains("bonds"));
  CHECK_FALSE(checkpoint.contains("bond"));
}

TEST_CASE("checkpoint: no sections and an empty signature are a checkpoint too") {
  const test::TemporaryFolder folder;
  CheckpointWriter(folder / "checkpoint", "").commit();
  CHECK(complaint_about_file(folder / "checkpoint", "").empty());
}

TEST_CASE("checkpoint: cut off after any byte it is refused") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  const std::string whole = small_checkpoint(path);
  REQUIRE(complaint_about_file(path).empty());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    test::write_bytes(path, whole.substr(0, length));
    const std::string complaint = complaint_about_file(path);
    CAPTURE(length);
    CHECK(complaint == where(path) + "truncated or damaged: ends after " + std::to_string(length) + " bytes");
  }
  test::write_bytes(path, whole + '\0');
  CHECK(test::contains(complaint_about_file(path), "damaged: must have 3 sections and "));
}

TEST_CASE("checkpoint: with any bit flipped it is refused") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  const std::string whole = small_checkpoint(path);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    test::write_bytes(path, damaged);
    const std::string complaint = complaint_about_file(path);
    CAPTURE(bit);
    CHECK(test::contains(complaint, where(path)));
  }
}

TEST_CASE("checkpoint: random bytes in place of any eight, be they a length of up to 2^64, are refused without harm") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  const std::string whole = small_checkpoint(path);
  for (const std::uint64_t number : {~0ull, ~0ull - 7, 1ull << 63, 1ull << 61, 0x0123456789ABCDEFull})
    for (std::size_t at = 0; at + sizeof number <= whole.size(); ++at) {
      std::string damaged = whole;
      std::memcpy(damaged.data() + at, &number, sizeof number);
      test::write_bytes(path, damaged);
      CAPTURE(at);
      CHECK(test::contains(complaint_about_file(path), where(path)));
    }
}

TEST_CASE("checkpoint: a length that cannot be is refused even where all CRCs are right") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  CheckpointWriter(path, scene).commit();
  const std::string start = test::read_bytes(path).substr(0, 8 + 4 + 4 + 8 + std::strlen(scene) + 4);
  const auto complaint = [&](std::uint64_t name_length, std::uint64_t element_size, std::uint64_t count) {
    dmp::io::detail::Record section;
    section << dmp::io::detail::section_mark << name_length << element_size << count << std::string_view("x");
    test::write_bytes(path, start + std::move(section).closed() + "data");
    return complaint_about_file(path);
  };
  CHECK(test::contains(complaint(1, 8, std::uint64_t{1} << 40), "truncated or damaged"));
  CHECK(test::contains(complaint(1, std::uint64_t{1} << 63, 2), "damaged: section 'x' is longer than any file"));
  CHECK(test::contains(complaint(1, 0, 2), "damaged: section 'x' has elements of no size"));
  CHECK(test::contains(complaint(~std::uint64_t{0}, 1, 2), "truncated or damaged"));
}

TEST_CASE("checkpoint: damage is reported with the section it is in") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  std::string bytes = small_checkpoint(path);
  const double value = 2.5;
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  REQUIRE(at != std::string::npos);
  bytes[at + 7] = '\x41';
  test::write_bytes(path, bytes);
  CHECK(complaint_about_file(path) == where(path) + "damaged: CRC of section 'density' does not match");
}

TEST_CASE("checkpoint: that of another scene is refused, both signatures quoted") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  small_checkpoint(path);
  CHECK(complaint_about_file(path, "poiseuille flow") ==
        where(path) + "is the checkpoint of another scene: its signature is 'dam break 2D, 10 particles', expected 'poiseuille flow'");
}

TEST_CASE("checkpoint: a missing file, a folder, another kind of file, another version and another byte order are told apart") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  CHECK(complaint_about_file(path) == where(path) + "cannot open: No such file or directory");
  CHECK(test::contains(complaint_about_file(folder.path()), where(folder.path()) + "cannot open: "));
  test::write_bytes(path, "time [s],front [m]\n0,1\n");
  CHECK(complaint_about_file(path) == where(path) + "is not a checkpoint");
  const std::string whole = small_checkpoint(path);
  std::string other = whole;
  std::reverse(other.begin() + 8, other.begin() + 12);
  test::write_bytes(path, other);
  CHECK(complaint_about_file(path) == where(path) + "was written on a machine of the other byte order");
  other = whole;
  const std::uint32_t version = 99;
  std::memcpy(other.data() + 12, &version, sizeof version);
  test::write_bytes(path, other);
  CHECK(complaint_about_file(path) == where(path) + "has format version 99, this program reads version 2");
}

TEST_CASE("checkpoint: a pipe, a device and a large file of another kind are refused at once, without waiting and without being read") {
  const test::TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(test::contains(complaint_about_file(folder / "pipe"), where(folder / "pipe") + "cannot open: "));
  CHECK(test::contains(complaint_about_file("/dev/zero"), where("/dev/zero") + "cannot open: "));
  test::write_bytes(folder / "large", "PK\x03\x04 something else");
  std::error_code no_sparse_files;
  std::filesystem::resize_file(folder / "large", std::uintmax_t{1} << 42, no_sparse_files);
  CHECK(complaint_about_file(folder / "large") == where(folder / "large") + "is not a checkpoint");
}

TEST_CASE("checkpoint: a section that is missing, or of elements of another size, is refused") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  small_checkpoint(path);
  const CheckpointReader checkpoint(path, scene);
  CHECK(test::error_of<CheckpointError>([&] { static_cast<void>(checkpoint.read<double>("velocity")); }) ==
        where(path) + "has no section 'velocity'; it has 'density', 'id', 'none'");
  CHECK(test::error_of<CheckpointError>([&] { static_cast<void>(checkpoint.read<float>("density")); }) ==
        where(path) + "section 'density' has elements of 8 bytes, asked for elements of 4");
}

TEST_CASE("checkpoint: a section added twice, and anything after commit, is refused") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  CheckpointWriter checkpoint(path, scene);
  checkpoint.add("id", std::array{1});
  CHECK(test::error_of<CheckpointError>([&] { checkpoint.add("id", std::array{1}); }) == where(path) + "section 'id' is added twice");
  checkpoint.commit();
  CHECK(complaint_about_file(path).empty());
  CHECK(test::error_of<CheckpointError>([&] { checkpoint.add("more", std::array{1}); }) ==
        where(path) + "cannot add section 'more' after commit or a failure");
  CHECK(test::error_of<CheckpointError>([&] { checkpoint.commit(); }) == where(path) + "cannot commit after commit or a failure");
}

TEST_CASE("checkpoint: a run killed while it writes leaves the former checkpoint whole; the part it leaves is harmless") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  const std::string former = small_checkpoint(path);
  const ::pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {  // no destructor runs at _exit, as when killed
    CheckpointWriter checkpoint(path, scene);
    checkpoint.add("density", std::vector<double>(100000, 1.0));
    ::_exit(0);
  }
  int status = 1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(status == 0);
  CHECK(std::filesystem::exists(path.string() + ".part"));
  CHECK(test::read_bytes(path) == former);
  CHECK(complaint_about_file(path).empty());
  CHECK(small_checkpoint(path) == former);
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
}

TEST_CASE("checkpoint: one that is given up, or for which the disk is too small, leaves the former one and no part") {
  const test::TemporaryFolder folder;
  const auto path = folder / "checkpoint";
  const std::string former = small_checkpoint(path);
  {
    CheckpointWriter checkpoint(path, scene);
    checkpoint.add("density", std::vector<double>(10, 1.0));
  }
  CHECK(test::read_bytes(path) == former);
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  if (!std::filesystem::exists("/dev/full")) return;
  for (const std::size_t count : {std::size_t{1}, std::size_t{100000}}) {  // found at commit, and on the way
    std::filesystem::create_symlink("/dev/full", path.string() + ".part");
    const std::string complaint = test::error_of<CheckpointError>([&] {
      CheckpointWriter checkpoint(path, scene);
      checkpoint.add("density", std::vector<double>(count, 1.0));
      checkpoint.commit();
    });
    CHECK(complaint == where(path) + "io: cannot write '" + path.string() + ".part': No space left on device");
    CHECK(test::read_bytes(path) == former);
  }
}

TEST_CASE("checkpoint: a place that cannot be written is refused at once") {
  const test::TemporaryFolder folder;
  test::write_bytes(folder / "file", "");
  const auto path = folder / "file/checkpoint";
  CHECK(test::error_of<CheckpointError>([&] { const CheckpointWriter checkpoint(path, scene); }) ==
        where(path) + "io: cannot write '" + path.string() + ".part': Not a directory");
}
