#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <type_traits>
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
    scene.engine().for_each_group([&](auto& group) {
      const particles::GroupView view = group.view();
      const std::vector<Derived> more = derived(scene, group);
      const auto path = path_of(view);
      io::write_vtp(path, io::PointCloud<std::remove_cvref_t<Scene>::dimension>{
                              .positions = group.positions(), .ids = view.id, .data = data_of(view, more)});
      series_->add(scene.time(), view.name, path);
    });
    ++frame_;
  }

 private:
  /// What material laws make of the state of each particle: pressure, temperature, viscosity, ...
  struct Derived {
    std::string name;
    std::vector<double> values;
  };
  template <class Field>
  [[nodiscard]] static double value_of(const auto& particle) {
    if constexpr (std::is_same_v<Field, field::PressureTerm>) return particle.pressure_term * square(particle.density);
    else return Field::of(particle);
  }
  template <class Scene, class Group>
  [[nodiscard]] static std::vector<Derived> derived(const Scene& scene, const Group& group) {
    std::vector<Derived> result;
    for_each_field(typename Group::Layout::derived{}, [&]<class Field>(Field) {
      constexpr bool is_pressure = std::is_same_v<Field, field::PressureTerm>;
      Derived one{is_pressure ? "pressure [Pa]" : std::string(Field::name) + " [" + std::string(Field::unit) + "]", {}};
      for (std::size_t i = 0; i < group.size(); ++i) {
        one.values.push_back(value_of<Field>(scene.engine().prepared(group, i, 0.0)));
      }
      result.push_back(std::move(one));
    });
    return result;
  }
  /// All columns but the position, and what is derived from them.
  [[nodiscard]] static std::vector<io::PointData> data_of(const particles::GroupView& view, const std::vector<Derived>& derived) {
    std::vector<io::PointData> data;
    for (std::size_t column = 1; column < view.columns.size(); ++column) {
      const auto& values = view.columns[column];
      data.push_back({std::string(values.name) + " [" + std::string(values.unit) + "]", values.values, values.components});
    }
    for (const auto& one : derived) data.push_back({one.name, one.values, 1});
    return data;
  }
  [[nodiscard]] std::filesystem::path path_of(const particles::GroupView& view) const {
    char number[16];
    std::snprintf(number, sizeof number, "_%04d.vtp", frame_);
    return folder_ / (view.name + number);
  }

  io::OutputFolder folder_;
  std::shared_ptr<io::TimeSeries> series_;
  int frame_ = 0;
};

}  // namespace dmp::simulation
