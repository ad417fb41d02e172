// expect: dmp: not a Kernel: no `T radial_factor(T r) const`, (1/r) dW/dr [m^-(Dim+2)]
#include <dmp/kernel/concept.hpp>

namespace {
struct Hat {
  static constexpr int dimension = 1;
  double support_radius;
  template <class T>
  T value(const T& r) const {
    return (support_radius - r) * (1.0 / (support_radius * support_radius));
  }
};
void validate(const Hat&) {}
}  // namespace

static_assert(dmp::kernel::explain_kernel<Hat>());
