// geometry::read_points: any bytes are refused with a ParameterError that names the file, or are finite points, which written again are
// read as the same points.
#include <string>
#include <dmp/geometry/point_file.hpp>
#include "fuzz/fuzz.hpp"

namespace {

template <int Dim>
void read_twice(const fuzz::MemoryFile& file, const std::uint8_t* data, std::size_t size) {
  file.write(data, size);
  dmp::geometry::Points<Dim> points;
  try {
    points = dmp::geometry::read_points<Dim>(file.path());
  } catch (const dmp::ParameterError& error) {
    const std::string text = error.what();
    fuzz::require(text.starts_with("geometry::read_points: '" + file.path() + "'"), "an error must name the file");
    fuzz::require(text.size() < 500 && text.find('\0') == std::string::npos, "an error must be short and of one piece");
    return;
  }
  std::string again;
  for (const auto& point : points.positions)
    for (int d = 0; d < Dim; ++d) again += dmp::to_text(point[d]) + (d + 1 < Dim ? " " : "\n");
  file.write(again.data(), again.size());
  fuzz::require(dmp::geometry::read_points<Dim>(file.path()).positions == points.positions, "points must come back as they were");
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  static const std::string start = "# x y [m]\n1.5, -2e-3\n+.5\t7\r\n\n1 2 # here\n";
  return fuzz::mutate(data, size, max_size, seed, start, [](std::uint8_t*, std::size_t) {});
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::MemoryFile file;
  read_twice<2>(file, data, size);
  read_twice<3>(file, data, size);
  return 0;
}
