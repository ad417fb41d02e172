#include <doctest/doctest.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>
#include <dmp/io/vtk.hpp>
#include "io/temporary_folder.hpp"
#include "io/xml.hpp"

using dmp::Vector;
using dmp::io::PointCloud;
using dmp::io::PointData;
using dmp::io::TimeSeries;
using dmp::io::WriteError;
using dmp::io::write_vtp;

namespace {

/// A .vtp file as a reader sees it: the XML without the raw data, and each array found by its offset.
struct Vtp {
  explicit Vtp(const std::filesystem::path& path) : Vtp(test::read_bytes(path), 0) {}

  template <class T>
  [[nodiscard]] std::vector<T> array(const std::string& parent, const std::string& name, const std::string& type, int components) const {
    for (const auto& element : xml.all("DataArray")) {
      if (element.attributes.at("Name") != name || element.parent != parent) continue;
      REQUIRE(element.attributes.at("type") == type);
      REQUIRE(element.attributes.at("format") == "appended");
      REQUIRE(element.attributes.at("NumberOfComponents") == std::to_string(components));
      const std::size_t offset = std::stoull(element.attributes.at("offset"));
      std::uint64_t bytes = 0;
      REQUIRE(offset + sizeof bytes <= data.size());
      std::memcpy(&bytes, data.data() + offset, sizeof bytes);
      REQUIRE(offset + sizeof bytes + bytes <= data.size());
      REQUIRE(bytes % sizeof(T) == 0);
      std::vector<T> values(bytes / sizeof(T));
      if (bytes > 0) std::memcpy(values.data(), data.data() + offset + sizeof bytes, bytes);
      return values;
    }
    FAIL("no array '" << name << "' in " << parent);
    return {};
  }

  std::string data;
  test::Xml xml;

 private:
  static constexpr const char* begin = "<AppendedData encoding=\"raw\">\n_";
  static constexpr const char* end = "\n  </AppendedData>\n</VTKFile>\n";
  Vtp(const std::string& bytes, int)
      : data(bytes.substr(begin_of_data(bytes), bytes.size() - begin_of_data(bytes) - std::strlen(end))),
        xml(bytes.substr(0, begin_of_data(bytes) - 1) + bytes.substr(begin_of_data(bytes) + data.size())) {}
  static std::size_t begin_of_data(const std::string& bytes) { return bytes.find(begin) + std::strlen(begin); }
};

}  // namespace

TEST_CASE("vtp: positions, ids and data come back bit for bit; 2D is padded with zeros; each point is one vertex") {
  const test::TemporaryFolder folder;
  const std::vector<Vector<2>> x{{0.1, -0.2}, {1e300, 5e-324}, {3.0, std::nan("")}};
  const std::vector<std::uint32_t> ids{7, 0, 4294967295u};
  const std::vector<double> density{1.0, 2.0, std::numeric_limits<double>::infinity()}, velocity{1, 2, 3, 4, 5, 6}, stress(18, 0.25);
  write_vtp(folder / "water.vtp", PointCloud<2>{.positions = x,
                                                .ids = ids,
                                                .data = {{.name = "density <\"a\" & b> [kg/m^3]", .values = density},
                                                         {.name = "velocity", .values = velocity, .components = 2},
                                                         {.name = "stress", .values = stress, .components = 6}}});
  const Vtp file(folder / "water.vtp");
  const auto positions = file.array<double>("Points", "Points", "Float64", 3);
  REQUIRE(positions.size() == 9);
  const std::vector<double> expected{0.1, -0.2, 0.0, 1e300, 5e-324, 0.0, 3.0, std::nan(""), 0.0};
  CHECK(std::memcmp(positions.data(), expected.data(), 9 * sizeof(double)) == 0);
  CHECK(file.array<std::uint32_t>("PointData", "id", "UInt32", 1) == ids);
  CHECK(file.array<double>("PointData", "density <\"a\" & b> [kg/m^3]", "Float64", 1) == density);
  CHECK(file.array<double>("PointData", "velocity", "Float64", 3) == std::vector<double>{1, 2, 0, 3, 4, 0, 5, 6, 0});
  CHECK(file.array<double>("PointData", "stress", "Float64", 6) == stress);
  CHECK(file.array<std::int64_t>("Verts", "connectivity", "Int64", 1) == std::vector<std::int64_t>{0, 1, 2});
  CHECK(file.array<std::int64_t>("Verts", "offsets", "Int64", 1) == std::vector<std::int64_t>{1, 2, 3});

  const auto root = file.xml.elements.front();
  CHECK(root.name == "VTKFile");
  CHECK(root.attributes.at("type") == "PolyData");
  CHECK(root.attributes.at("version") == "1.0");
  CHECK(root.attributes.at("header_type") == "UInt64");
  const std::uint16_t probe = 1;
  CHECK(root.attributes.at("byte_order") == (*reinterpret_cast<const unsigned char*>(&probe) == 1 ? "LittleEndian" : "BigEndian"));
  const auto piece = file.xml.all("Piece").front().attributes;
  CHECK(piece.at("NumberOfPoints") == "3");
  CHECK(piece.at("NumberOfVerts") == "3");
  for (const char* none : {"NumberOfLines", "NumberOfStrips", "NumberOfPolys"}) CHECK(piece.at(none) == "0");

  std::size_t bytes = 0;  // the blocks lie without gap
  for (const auto& element : file.xml.all("DataArray")) {
    CHECK(std::stoull(element.attributes.at("offset")) == bytes);
    std::uint64_t block = 0;
    std::memcpy(&block, file.data.data() + bytes, sizeof block);
    bytes += sizeof block + block;
  }
  CHECK(bytes == file.data.size());
}

TEST_CASE("vtp: 1D and 3D positions, 64-bit ids, no ids, no points") {
  const test::TemporaryFolder folder;
  const std::vector<Vector<1>> line{Vector<1>{1.5}, Vector<1>{2.5}};
  const std::vector<std::int64_t> ids{-1, 1LL << 40};
  write_vtp(folder / "line.vtp", PointCloud<1, std::int64_t>{.positions = line, .ids = ids});
  CHECK(Vtp(folder / "line.vtp").array<double>("Points", "Points", "Float64", 3) == std::vector<double>{1.5, 0, 0, 2.5, 0, 0});
  CHECK(Vtp(folder / "line.vtp").array<std::int64_t>("PointData", "id", "Int64", 1) == ids);

  const std::vector<Vector<3>> body{{1, 2, 3}};
  write_vtp(folder / "body.vtp", PointCloud<3>{.positions = body});
  CHECK(Vtp(folder / "body.vtp").array<double>("Points", "Points", "Float64", 3) == std::vector<double>{1, 2, 3});
  CHECK(Vtp(folder / "body.vtp").xml.all("DataArray").size() == 3);

  write_vtp(folder / "empty.vtp", PointCloud<3>{.positions = {}, .data = {{.name = "density", .values = {}}}});
  CHECK(Vtp(folder / "empty.vtp").array<double>("Points", "Points", "Float64", 3).empty());
  CHECK(Vtp(folder / "empty.vtp").xml.all("Piece").front().attributes.at("NumberOfPoints") == "0");
}

TEST_CASE("vtp: data that do not fit together are refused with the file's name, and nothing is written") {
  const test::TemporaryFolder folder;
  const auto path = folder / "water.vtp";
  const std::vector<Vector<2>> x{{0, 0}, {1, 1}};
  const std::vector<double> three{1, 2, 3}, two{1, 2};
  const std::vector<std::uint32_t> one_id{1};
  const auto complaint = [&](const PointCloud<2>& cloud) { return test::error_of<dmp::ParameterError>([&] { write_vtp(path, cloud); }); };
  const std::string who = "io::write_vtp: '" + path.string() + "': ";
  CHECK(complaint({.positions = x, .ids = one_id}) == who + "ids must be as many as the 2 positions, got 1");
  CHECK(complaint({.positions = x, .data = {{.name = "p", .values = three}}}) == who + "'p' must have 2 values (2 points of 1), got 3");
  CHECK(complaint({.positions = x, .data = {{.name = "v", .values = two, .components = 2}}}) ==
        who + "'v' must have 4 values (2 points of 2), got 2");
  CHECK(complaint({.positions = x, .data = {{.name = "p", .values = two, .components = 0}}}) ==
        who + "'p' must have components >= 1, got 0");
  CHECK(complaint({.positions = x, .data = {{.name = "p", .values = two}, {.name = "p", .values = two}}}) ==
        who + "a name must occur only once and not be 'id', got 'p'");
  CHECK(complaint({.positions = x, .data = {{.name = "id", .values = two}}}) ==
        who + "a name must occur only once and not be 'id', got 'id'");
  CHECK(complaint({.positions = x, .data = {{.name = "", .values = two}}}) ==
        who + "a name must not be empty nor hold control characters, got ''");
  CHECK(complaint({.positions = x, .data = {{.name = "a\nb", .values = two}}}) ==
        who + "a name must not be empty nor hold control characters, got 'a\nb'");
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("vtp: when the disk is full the error names file and reason, and a former file stays as it was") {
  const test::TemporaryFolder folder;
  const auto path = folder / "water.vtp";
  const std::vector<Vector<2>> x(10000, Vector<2>{1, 2});
  CHECK(test::error_of<WriteError>([&] { write_vtp(folder / "missing/a.vtp", PointCloud<2>{.positions = x}); }) ==
        "io: cannot write '" + (folder / "missing/a.vtp.part").string() + "': No such file or directory");
  CHECK(test::error_of<WriteError>([&] { write_vtp(folder.path(), PointCloud<2>{.positions = x}); }) ==
        "io: cannot write '" + folder.path().string() + "': it exists and is not a regular file");
  if (!std::filesystem::exists("/dev/full")) return;
  test::write_bytes(path, "former");
  for (const std::size_t count : {std::size_t{1}, x.size()}) {  // found at the end, and on the way
    std::filesystem::create_symlink("/dev/full", folder / "water.vtp.part");
    CHECK(test::error_of<WriteError>([&] { write_vtp(path, PointCloud<2>{.positions = std::span(x).first(count)}); }) ==
          "io: cannot write '" + path.string() + ".part': No space left on device");
    CHECK(test::read_bytes(path) == "former");
    CHECK_FALSE(std::filesystem::is_symlink(folder / "water.vtp.part"));
  }
}

TEST_CASE("time series: the index is well formed after each addition, and names time, group and file relative to itself") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "frames");
  TimeSeries series(folder / "run.pvd");
  CHECK(test::Xml(test::read_bytes(folder / "run.pvd")).all("DataSet").empty());
  struct Entry {
    double time;
    std::string group, part, file;
  };
  const std::vector<Entry> entries{{0.0, "water", "0", "frames/water_0.vtp"},
                                   {0.0, "wall & <lid>", "1", "wall_0.vtp"},
                                   {0.1, "water", "0", "frames/water \"1\".vtp"},
                                   {0.30000000000000004, "wall & <lid>", "1", "wall_1.vtp"}};
  for (std::size_t n = 0; n < entries.size(); ++n) {
    series.add(entries[n].time, entries[n].group, folder / entries[n].file);
    const test::Xml xml(test::read_bytes(folder / "run.pvd"));
    CHECK(xml.elements.front().attributes.at("type") == "Collection");
    const auto sets = xml.all("DataSet");
    REQUIRE(sets.size() == n + 1);
    for (std::size_t i = 0; i <= n; ++i) {
      CHECK(sets[i].parent == "Collection");
      CHECK(std::stod(sets[i].attributes.at("timestep")) == entries[i].time);
      CHECK(sets[i].attributes.at("name") == entries[i].group);
      CHECK(sets[i].attributes.at("part") == entries[i].part);
      CHECK(sets[i].attributes.at("file") == entries[i].file);
    }
  }
  CHECK_FALSE(std::filesystem::exists(folder / "run.pvd.part"));
  const TimeSeries again(folder / "run.pvd");
  CHECK(test::Xml(test::read_bytes(folder / "run.pvd")).all("DataSet").empty());
}

TEST_CASE("time series: an addition that fails leaves the index on disk whole; what no index can hold is refused") {
  const test::TemporaryFolder folder;
  TimeSeries series(folder / "run.pvd");
  series.add(0.0, "water", folder / "a.vtp");
  const std::string whole = test::read_bytes(folder / "run.pvd");
  CHECK(test::error_of<dmp::ParameterError>([&] { series.add(std::nan(""), "water", folder / "b.vtp"); }) ==
        "io::TimeSeries: time must be finite [s], got nan");
  CHECK(test::error_of<dmp::ParameterError>([&] { series.add(1.0, "wa\nter", folder / "b.vtp"); }) ==
        "io::TimeSeries: group and file must not hold control characters, nor the file be empty, got 'wa\nter', 'b.vtp'");
  if (std::filesystem::exists("/dev/full")) {
    std::filesystem::create_symlink("/dev/full", folder / "run.pvd.part");
    CHECK(test::error_of<WriteError>([&] { series.add(1.0, "water", folder / "b.vtp"); }) ==
          "io: cannot write '" + (folder / "run.pvd.part").string() + "': No space left on device");
  }
  CHECK(test::read_bytes(folder / "run.pvd") == whole);
}
