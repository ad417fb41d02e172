#pragma once

/// The library's only macro, and the only place where the version is written: CMake, the package files and the parts below read it.
#define DMP_VERSION "0.1.0"

namespace dmp {

/// The n-th number of DMP_VERSION, from 0.
[[nodiscard]] consteval int version_part(int n) {
  int part = 0;
  for (const char character : DMP_VERSION) {
    if (character >= '0' && character <= '9') {
      part = 10 * part + (character - '0');
    } else {  // a dot, or the end
      if (n-- == 0) return part;
      part = 0;
    }
  }
  return part;
}

inline constexpr int version_major = version_part(0);
inline constexpr int version_minor = version_part(1);
inline constexpr int version_patch = version_part(2);

}  // namespace dmp
