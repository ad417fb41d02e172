#pragma once
#include <dmp/core/components.hpp>
#include <dmp/core/require.hpp>
#include <dmp/core/required.hpp>

namespace dmp::forcing {

/// Linear drag towards rest in the laboratory frame, force -gamma v [N]. Not Galilean invariant. (LAMMPS: fix viscous.)
struct Drag {
  Required<double> coefficient;  ///< gamma [N s/m] per particle, >= 0

  [[nodiscard]] auto acceleration(const auto& subject) const noexcept { return (-coefficient / subject.mass) * subject.velocity; }
  [[nodiscard]] double damping_rate(double mass) const noexcept { return coefficient / mass; }
};

inline void validate(const Drag& law) { require_not_negative("forcing::Drag: coefficient", law.coefficient, "N s/m"); }

}  // namespace dmp::forcing
