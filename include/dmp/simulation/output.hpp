#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/math.hpp>
#include <dmp/io/output_folder.hpp>
#include <dmp/io/vtk.hpp>
#include <dmp/simulation/scene.hpp>

namespace dmp::simulation {

/// Observer that writes all groups for ParaView: <group>_0000.vtp with every column, the pressure where there is one, and the ids; and
/// the index <name>.pvd that opens them all as one animation.
///   scene.every(0.01, VtkOutput(folder, "dam_break"));
class VtkOutput {
 public:
  VtkOutput(const io::OutputFolder& folder, const std::string& name)
      : folder_(folder), series_(std::make_shared<io::TimeSeries>(folder / (name + ".pvd"))) {}

  template <class Scene>
  void operator()(Scene& scene) {
    scene.engine().for_each_group([&](auto& group) { write(group, pressures(scene, group), scene.time()); });
    ++frame_;
  }

 private:
  template <class Scene, class Group>
  [[nodiscard]] static std::vector<double> pressures(const Scene& scene, const Group& group) {
    std::vector<double> pressure;
    if constexpr (contains<field::PressureTerm, typename Group::Layout::prepared>)
      for (std::size_t i = 0; i < group.size(); ++i) {
        const auto particle = scene.engine().prepared(group, i, 0.0);
        pressure.push_back(particle.pressure_term * square(particle.density));
      }
    return pressure;
  }
  template <class Group>
  void write(Group& group, const std::vector<double>& pressure, double time) {
    io::PointCloud<Group::Dim> cloud{.positions = group.positions(), .ids = group.id};
    const auto view = group.view();
    for (std::size_t column = 1; column < view.columns.size(); ++column) {
      const auto& values = view.columns[column];
      cloud.data.push_back({std::string(values.name) + " [" + std::string(values.unit) + "]", values.values, values.components});
    }
    if (!pressure.empty()) cloud.data.push_back({"pressure [Pa]", pressure, 1});
    char number[16];
    std::snprintf(number, sizeof number, "_%04d.vtp", frame_);
    const auto path = folder_ / (group.name + number);
    io::write_vtp(path, cloud);
    series_->add(time, group.name, path);
  }

  io::OutputFolder folder_;
  std::shared_ptr<io::TimeSeries> series_;
  int frame_ = 0;
};

}  // namespace dmp::simulation
