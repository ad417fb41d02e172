#include <cmath>
#include <cstdio>
#include <numbers>
#include <dmp/kernel/lucy.hpp>

int main() {
  const dmp::kernel::Lucy<2> kernel{.support_radius = 1.0};
  std::printf("W(0) = %.17g\n", kernel.value(0.0));
  return std::abs(kernel.value(0.0) - 5.0 / std::numbers::pi) < 1e-15 ? 0 : 1;
}
