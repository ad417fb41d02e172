// The command that the must-fail cases are compiled with compiles this.
#include <dmp/core/vector.hpp>
#include <dmp/kernel/concept.hpp>
#include <dmp/kernel/lucy.hpp>

static_assert(dmp::kernel::explain_kernel<dmp::kernel::Lucy<3>>());

int main() { return dmp::kernel::Lucy<3>{.support_radius = 1.0}.value(1.0) == 0.0 ? 0 : 1; }
