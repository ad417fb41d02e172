#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <dmp/core/require.hpp>

namespace dmp {

/// A run that went wrong. The text names the time, step, group, particle, field and value; the members hold them for a program.
struct SimulationError : std::runtime_error {
  struct Where {
    double time = 0.0;         ///< [s]
    std::uint64_t step = 0;
    std::string group;         ///< empty when the whole scene is meant
    std::int64_t particle = -1;  ///< id, -1 when no single particle is meant
    std::string field;
    double value = 0.0;
  };

  SimulationError(const std::string& what_happened, Where location)
      : std::runtime_error(text(what_happened, location)), where(std::move(location)) {}
  /// The same error, of which there is more to say.
  SimulationError(const SimulationError& error, const std::string& more) : std::runtime_error(error.what() + more), where(error.where) {}
  Where where;

 private:
  static std::string text(const std::string& what_happened, const Where& where) {
    std::string result = "dmp: " + what_happened + " at t = " + to_text(where.time) + " s, step " + std::to_string(where.step);
    if (!where.group.empty()) result += ", group " + where.group;
    if (where.particle >= 0) result += ", particle " + std::to_string(where.particle);
    if (!where.field.empty()) result += ", " + where.field + " = " + to_text(where.value);
    return result;
  }
};

}  // namespace dmp
