#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/vector.hpp>
#include <dmp/io/detail/file.hpp>

namespace dmp::io {

/// One quantity of all points: `components` numbers per point, point by point. Two components are padded to three, for ParaView.
struct PointData {
  std::string name;                ///< shown by ParaView; with the unit, if you like: "density [kg/m^3]"
  std::span<const double> values;  ///< the caller's, only looked at
  int components = 1;              ///< 1 scalar, 2 or 3 vector, 6 symmetric or 9 general tensor
};

/// What write_vtp writes. Spans are the caller's, only looked at.
template <int Dim, std::integral Id = std::uint32_t>
struct PointCloud {
  std::span<const Vector<Dim>> positions;  ///< [m]; missing directions are written as 0
  std::span<const Id> ids = {};            ///< point data "id"; none if empty
  std::vector<PointData> data = {};
};

namespace detail {

[[nodiscard]] inline std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '&') result += "&amp;";
    else if (letter == '<') result += "&lt;";
    else if (letter == '>') result += "&gt;";
    else if (letter == '"') result += "&quot;";
    else result += letter;
  }
  return result;
}

[[nodiscard]] inline bool fits_xml(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char letter) { return static_cast<unsigned char>(letter) < 0x20; });
}

template <class T>
[[nodiscard]] std::string vtk_type() {
  if constexpr (std::floating_point<T>) return "Float" + std::to_string(8 * sizeof(T));
  else return (std::is_signed_v<T> ? "Int" : "UInt") + std::to_string(8 * sizeof(T));
}

inline constexpr const char* vtk_byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// The appended data of a VTK file: blocks of a 64-bit byte count and the bytes, found by their offset from the first one.
class AppendedBlocks {
 public:
  /// The <DataArray> of a block of numbers of a type with `bytes` each, which write() must then write in the same order.
  std::string announce(std::string_view type, std::size_t bytes, std::string_view name, std::size_t tuples, int components = 1) {
    std::string element = "        <DataArray type=\"";
    element.append(type).append("\" Name=\"").append(xml_escaped(name)).append("\" NumberOfComponents=\"");
    element.append(std::to_string(components)).append("\" format=\"appended\" offset=\"").append(std::to_string(offset_)).append("\"/>\n");
    offset_ += sizeof(std::uint64_t) + tuples * static_cast<std::size_t>(components) * bytes;
    return element;
  }
  static void write(WholeFile& file, std::span<const std::byte> values) {
    const std::uint64_t bytes = values.size();
    file.write(&bytes, sizeof bytes);
    file.write(values.data(), values.size());
  }

 private:
  std::uint64_t offset_ = 0;
};

/// A PointCloud without its types: `dimension` coordinates per point, and ids as bytes.
struct Points {
  std::size_t count;
  int dimension;
  std::span<const double> coordinates;
  std::size_t ids;  // as many as points, or none
  std::string id_type;
  std::span<const std::byte> id_bytes;
  const std::vector<PointData>& data;
};

inline void require_consistent(const std::filesystem::path& path, const Points& cloud) {
  const std::string who = "io::write_vtp: " + quoted(path) + ": ";
  const std::size_t points = cloud.count;
  if (cloud.ids > 0 && cloud.ids != points)
    throw ParameterError(who + "ids must be as many as the " + std::to_string(points) + " positions, got " + std::to_string(cloud.ids));
  std::vector<std::string_view> names{"id"};
  for (const PointData& data : cloud.data) {
    if (data.name.empty() || !fits_xml(data.name))
      throw ParameterError(who + "a name must not be empty nor hold control characters, got '" + data.name + "'");
    if (std::find(names.begin(), names.end(), data.name) != names.end())
      throw ParameterError(who + "a name must occur only once and not be 'id', got '" + data.name + "'");
    names.push_back(data.name);
    if (data.components < 1)
      throw ParameterError(who + "'" + data.name + "' must have components >= 1, got " + std::to_string(data.components));
    const std::size_t expected = points * static_cast<std::size_t>(data.components);
    if (data.values.size() != expected)
      throw ParameterError(who + "'" + data.name + "' must have " + std::to_string(expected) + " values (" + std::to_string(points) +
                           " points of " + std::to_string(data.components) + "), got " + std::to_string(data.values.size()));
  }
}

[[nodiscard]] constexpr int components_written(int components) noexcept { return components == 2 ? 3 : components; }

inline void write_points(const std::filesystem::path& path, const Points& cloud) {
  require_consistent(path, cloud);
  const std::size_t points = cloud.count;
  const std::string count = std::to_string(points);
  AppendedBlocks blocks;
  std::string head = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"") + vtk_byte_order +
                     "\" header_type=\"UInt64\">\n  <PolyData>\n    <Piece NumberOfPoints=\"" + count + "\" NumberOfVerts=\"" + count +
                     "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n";
  head += "      <PointData>\n";
  if (cloud.ids > 0) head += blocks.announce(cloud.id_type, cloud.id_bytes.size() / points, "id", points);
  const auto numbers = [&blocks, points](std::string_view name, int components) {
    return blocks.announce("Float64", sizeof(double), name, points, components_written(components));
  };
  for (const PointData& data : cloud.data) head += numbers(data.name, data.components);
  head += "      </PointData>\n      <Points>\n";
  head += numbers("Points", 3);
  head += "      </Points>\n      <Verts>\n";
  for (const char* const name : {"connectivity", "offsets"}) head += blocks.announce("Int64", sizeof(std::int64_t), name, points);
  head += "      </Verts>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_";

  WholeFile file(path);
  file.write(head);
  if (cloud.ids > 0) blocks.write(file, cloud.id_bytes);
  std::vector<double> padded(3 * points);
  const auto write_padded = [&](std::span<const double> values, int components) {
    const auto given = static_cast<std::size_t>(components);
    for (std::size_t i = 0; i < points; ++i)
      for (std::size_t d = 0; d < 3; ++d) padded[3 * i + d] = d < given ? values[given * i + d] : 0.0;
    blocks.write(file, std::as_bytes(std::span(padded)));
  };
  for (const PointData& data : cloud.data) {
    if (data.components == 2) write_padded(data.values, 2);
    else blocks.write(file, std::as_bytes(data.values));
  }
  write_padded(cloud.coordinates, cloud.dimension);
  std::vector<std::int64_t> index(points);
  for (const std::int64_t first : {0, 1}) {  // connectivity 0, 1, ...; offsets, the end of each vertex in it, 1, 2, ...
    for (std::size_t i = 0; i < points; ++i) index[i] = static_cast<std::int64_t>(i) + first;
    blocks.write(file, std::as_bytes(std::span(index)));
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace detail

/// Writes points for ParaView: VTK XML PolyData (.vtp), version 1.0, raw appended binary data, one vertex per point. The file is there
/// whole or not at all. ParameterError if the spans do not fit together, WriteError if the disk does not take it.
///   write_vtp(results / "water_0001.vtp", PointCloud<2>{.positions = x, .ids = id, .data = {{.name = "density", .values = rho}}});
template <int Dim, class Id>
void write_vtp(const std::filesystem::path& path, const PointCloud<Dim, Id>& cloud) {
  const std::span<const double> coordinates(reinterpret_cast<const double*>(cloud.positions.data()), Dim * cloud.positions.size());
  detail::write_points(path, {cloud.positions.size(), Dim, coordinates, cloud.ids.size(), detail::vtk_type<Id>(), std::as_bytes(cloud.ids),
                              cloud.data});
}

/// The index of a run's files by time (.pvd), which ParaView opens as one animation of all groups. It is rewritten whole after each
/// addition, so it can be opened while the run goes on.
class TimeSeries {
 public:
  /// Begins a new index; a former one of that name is replaced.
  explicit TimeSeries(std::filesystem::path path) : path_(std::move(path)) { write(); }

  /// `file` is the path of a file already written, as given to write_vtp; the index names it relative to its own folder.
  void add(double time, const std::string& group, const std::filesystem::path& file) {
    if (!(time - time == 0.0)) throw ParameterError("io::TimeSeries: time must be finite [s], got " + to_text(time));
    const std::string name = relative_to_index(file).generic_string();
    if (name.empty() || !detail::fits_xml(name) || !detail::fits_xml(group))
      throw ParameterError("io::TimeSeries: group and file must not hold control characters, nor the file be empty, got '" + group +
                           "', '" + name + "'");
    const auto known = std::find(groups_.begin(), groups_.end(), group);
    const auto part = known - groups_.begin();
    if (known == groups_.end()) groups_.push_back(group);
    entries_ += "    <DataSet timestep=\"" + to_text(time) + "\" group=\"\" part=\"" + std::to_string(part) + "\" name=\"" +
                detail::xml_escaped(group) + "\" file=\"" + detail::xml_escaped(name) + "\"/>\n";
    write();
  }

 private:
  [[nodiscard]] std::filesystem::path relative_to_index(const std::filesystem::path& file) const {
    const auto folder = std::filesystem::absolute(path_).lexically_normal().parent_path();
    return std::filesystem::absolute(file).lexically_normal().lexically_relative(folder);
  }
  void write() const {
    detail::WholeFile file(path_);
    file.write(std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"") + detail::vtk_byte_order +
               "\">\n  <Collection>\n");
    file.write(entries_);
    file.write("  </Collection>\n</VTKFile>\n");
    file.commit();
  }

  std::filesystem::path path_;
  std::vector<std::string> groups_;
  std::string entries_;
};

}  // namespace dmp::io
