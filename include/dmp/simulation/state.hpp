#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/simulation_error.hpp>
#include <dmp/io/checkpoint.hpp>
#include <dmp/particles/view.hpp>

/// The state of a scene as plain numbers: checked, copied, written and read without knowing the types of its groups.
namespace dmp::simulation {

/// When a state is.
struct Clock {
  double time = 0.0;            ///< [s]
  std::uint64_t step = 0;       ///< since the very start
  double time_step = 0.0;       ///< [s] of the step under way, 0 before the first
  double base_time = 0.0;       ///< [s] when this time step was chosen: time = base_time + (step - base_step) time_step
  std::uint64_t base_step = 0;  ///< step at that time
  std::uint64_t automatic = 0;  ///< 1 if this time step was chosen from the laws' bounds
  std::uint64_t substeps = 0;   ///< of sub-stepped bonds in a step; 0: not chosen yet

  /// From here on steps of `dt` [s]. The same step again changes nothing, so that a run in two parts does the arithmetic of one.
  void choose(double dt) noexcept {
    if (dt == time_step) return;
    time_step = dt;
    base_time = time;
    base_step = step;
  }
  void tick() noexcept {
    ++step;
    time = base_time + static_cast<double>(step - base_step) * time_step;
  }
};

/// A run that went wrong, with no single particle to blame.
[[nodiscard]] inline SimulationError failure(const std::string& what_happened, const Clock& clock) {
  return {what_happened, {clock.time, clock.step, "", -1, "", 0.0}};
}

/// Names dimension, integrator, groups, mobilities and columns: a checkpoint of another composition does not fit.
[[nodiscard]] inline std::string signature(int dimension, std::string_view integrator, const std::vector<particles::GroupView>& groups) {
  std::string text = std::to_string(dimension) + "D, " + std::string(integrator);
  for (const auto& group : groups) {
    text += "; " + group.name + " (" + std::string(group.mobility) + "):";
    for (const auto& column : group.columns) text += " " + std::string(column.name);
  }
  return text;
}

namespace detail {
/// Whether all values are finite, and positive if they must be. Eight at a time, each with its own sum: no waiting for the one before.
[[nodiscard]] inline bool are_fine(const particles::ColumnView& column) noexcept {
  constexpr std::size_t width = 8;
  double probe[width]{}, least[width];  // probes stay 0 as long as all values are finite
  std::fill(least, least + width, 1.0);
  const auto look = [&](std::size_t k, std::size_t lane) {
    probe[lane] += 0.0 * column.values[k];
    least[lane] = column.values[k] < least[lane] ? column.values[k] : least[lane];
  };
  std::size_t k = 0;
  for (; k + width <= column.values.size(); k += width)
    for (std::size_t lane = 0; lane < width; ++lane) look(k + lane, lane);
  for (; k < column.values.size(); ++k) look(k, 0);
  return std::all_of(probe, probe + width, [](double p) { return p == 0.0; }) &&
         (!column.is_positive || *std::min_element(least, least + width) > 0.0);
}
}  // namespace detail

/// What is wrong with a state: the first value that is not finite, or not positive though it must be, and the first particle outside
/// lower .. upper [m] (infinite bounds: none). Empty `what` when nothing is.
struct Fault {
  std::string what;
  std::string group;
  std::int64_t particle = -1;
  std::string field;
  double value = 0.0;
};

[[nodiscard]] inline Fault find_fault(const std::vector<particles::GroupView>& groups, std::span<const double> lower,
                                      std::span<const double> upper) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool unbounded =
      *std::max_element(lower.begin(), lower.end()) == -infinity && *std::min_element(upper.begin(), upper.end()) == infinity;
  for (const auto& group : groups) {
    if (group.id.empty()) continue;  // bonds: what goes wrong with them shows in their particles
    const auto fault = [&](const char* what, const particles::ColumnView& column, std::size_t k) {
      return Fault{what, group.name, static_cast<std::int64_t>(group.id[k / static_cast<std::size_t>(column.components)]),
                   std::string(column.name), column.values[k]};
    };
    for (const auto& column : group.columns) {
      if (detail::are_fine(column)) continue;
      for (std::size_t k = 0; k < column.values.size(); ++k) {
        if (!(column.values[k] - column.values[k] == 0.0)) return fault("must be finite", column, k);
        if (column.is_positive && !(column.values[k] > 0.0)) return fault("must be > 0", column, k);
      }
    }
    if (unbounded) continue;
    const auto& position = group.columns.front();
    for (std::size_t k = 0; k < position.values.size(); k += lower.size())
      for (std::size_t d = 0; d < lower.size(); ++d)
        if (!(position.values[k + d] >= lower[d] && position.values[k + d] <= upper[d]))
          return fault("must lie in the box", position, k + d);
  }
  return {};
}

/// Throws SimulationError if there is a fault.
inline void require_none(const Fault& found, const Clock& clock) {
  if (!found.what.empty())
    throw SimulationError("a value " + found.what, {clock.time, clock.step, found.group, found.particle, found.field, found.value});
}

/// Groups must have names of their own, and no value be at `fault`. Throws ParameterError.
inline void check_groups(const std::vector<particles::GroupView>& groups, const Fault& fault) {
  for (std::size_t a = 0; a < groups.size(); ++a)
    for (std::size_t b = a + 1; b < groups.size(); ++b)
      if (groups[a].name == groups[b].name)
        throw ParameterError("scene: the names of groups must differ, got " + groups[a].name + " twice");
  if (!fault.what.empty())
    throw ParameterError("scene: group " + fault.group + ", particle " + std::to_string(fault.particle) + ": " + fault.field + " " +
                         fault.what + ", got " + to_text(fault.value));
}

/// A copy of all columns.
struct Snapshot {
  Clock clock;
  std::vector<std::vector<double>> columns;
  std::vector<std::vector<std::uint32_t>> id;

  void take(const std::vector<particles::GroupView>& groups, const Clock& at) {
    clock = at;
    std::size_t column = 0;
    id.resize(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      id[g].assign(groups[g].id.begin(), groups[g].id.end());
      for (const auto& view : groups[g].columns) {
        if (columns.size() <= column) columns.emplace_back();
        columns[column++].assign(view.values.begin(), view.values.end());
      }
    }
  }
  [[nodiscard]] bool empty() const noexcept { return columns.empty(); }
};

namespace detail {
inline void write_clock(io::CheckpointWriter& writer, const Clock& clock) {
  const std::array<double, 3> times{clock.time, clock.time_step, clock.base_time};
  const std::array<std::uint64_t, 4> steps{clock.step, clock.base_step, clock.automatic, clock.substeps};
  writer.add("clock.times", std::span<const double>(times));
  writer.add("clock.steps", std::span<const std::uint64_t>(steps));
}
[[nodiscard]] inline std::string section(const particles::GroupView& group, std::string_view what) {
  return group.name + "." + std::string(what);
}
}  // namespace detail

inline void write_checkpoint(const std::string& path, const std::string& signature, const std::vector<particles::GroupView>& groups,
                             const Clock& clock) {
  io::CheckpointWriter writer(path, signature);
  detail::write_clock(writer, clock);
  for (const auto& group : groups) {
    for (const auto& column : group.columns) writer.add(detail::section(group, column.name), std::span<const double>(column.values));
    writer.add(detail::section(group, "id"), std::span<const std::uint32_t>(group.id));
  }
  writer.commit();
}

/// The same file from a snapshot.
inline void write_checkpoint(const std::string& path, const std::string& signature, const std::vector<particles::GroupView>& groups,
                             const Snapshot& snapshot) {
  io::CheckpointWriter writer(path, signature);
  detail::write_clock(writer, snapshot.clock);
  std::size_t next = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const auto& column : groups[g].columns)
      writer.add(detail::section(groups[g], column.name), std::span<const double>(snapshot.columns[next++]));
    writer.add(detail::section(groups[g], "id"), std::span<const std::uint32_t>(snapshot.id[g]));
  }
  writer.commit();
}

/// Fills the groups from a checkpoint; their particle numbers must be those of the file. Nothing is changed when something does not fit, or
/// when a value is not finite, or not positive though it must be.
[[nodiscard]] inline Clock read_checkpoint(const std::string& path, const std::string& signature,
                                           const std::vector<particles::GroupView>& groups) {
  const io::CheckpointReader reader(path, signature);
  const auto require = [&path](bool holds, const std::string& rule, const std::string& got) {
    if (!holds) throw io::CheckpointError("io::checkpoint: '" + path + "': " + rule + ", got " + got);
  };
  const auto read = [&]<class T>(const std::string& section, std::size_t wanted, std::type_identity<T>) {
    auto values = reader.read<T>(section);
    require(values.size() == wanted, "section " + section + " must hold " + std::to_string(wanted) + " numbers",
            std::to_string(values.size()));
    return values;
  };
  const std::type_identity<double> numbers;
  const std::type_identity<std::uint64_t> counts;
  const auto time = read("clock.times", 3, numbers);
  const auto step = read("clock.steps", 4, counts);
  const Clock clock{time[0], step[0], time[1], time[2], step[1], step[2], step[3]};
  for (const double t : time) require(t - t == 0.0, "clock.times must be finite", to_text(t));
  require(clock.time_step >= 0.0, "the time step must be >= 0", to_text(clock.time_step));
  require(clock.base_step <= clock.step, "the step at which the time step was chosen must be <= " + std::to_string(clock.step),
          std::to_string(clock.base_step));
  require(clock.substeps <= 1000000, "sub-steps must be <= 1000000", std::to_string(clock.substeps));

  std::vector<std::vector<double>> columns;
  std::vector<std::vector<std::uint32_t>> ids;
  std::vector<particles::GroupView> found = groups;
  for (auto& group : found) {
    for (auto& column : group.columns) {
      columns.push_back(read(detail::section(group, column.name), column.values.size(), numbers));
      column.values = columns.back();
    }
    ids.push_back(read(detail::section(group, "id"), group.id.size(), std::type_identity<std::uint32_t>{}));
    group.id = ids.back();
  }
  constexpr std::array anywhere{std::numeric_limits<double>::infinity()};
  constexpr std::array from{-anywhere[0]};
  const Fault fault = find_fault(found, from, anywhere);
  require(fault.what.empty(),
          "group " + fault.group + ", particle " + std::to_string(fault.particle) + ": " + fault.field + " " + fault.what,
          to_text(fault.value));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::size_t c = 0; c < groups[g].columns.size(); ++c) {
      const auto values = found[g].columns[c].values;
      std::copy_n(values.data(), values.size(), groups[g].columns[c].values.data());
    }
    std::copy_n(found[g].id.data(), found[g].id.size(), groups[g].id.data());
  }
  return clock;
}

}  // namespace dmp::simulation
