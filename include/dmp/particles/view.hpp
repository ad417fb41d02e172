#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmp::particles {

/// A column without its type, for output, checks and checkpoints, which need no speed and should not be compiled once per scene.
struct ColumnView {
  std::string_view name, unit;
  int components;            ///< numbers per particle
  std::span<double> values;  ///< components * particles
  bool is_positive;          ///< only values > 0 make sense
};

/// A group without its type.
struct GroupView {
  std::string name;
  std::string_view mobility;
  bool evolves;  ///< anything of it changes during a run
  std::span<std::uint32_t> id;
  std::vector<ColumnView> columns;  ///< the first one is the position
};

}  // namespace dmp::particles
