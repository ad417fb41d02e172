// Where the bound of the time step of each law is, and where a run in fact blows up, as Markdown tables: see docs/stability.md. The scenes
// are those of the tests: tests/support/stability.hpp. Each table stands below a line "table: NAME".
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "support/stability.hpp"

using namespace test::stability;
using integrator::ExtrapolatedVerlet, integrator::LammpsVerlet, integrator::Leapfrog, integrator::SymplecticEuler;

namespace {

constexpr std::uint64_t steps = 4000;

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
/// Blow-up over bound, as text.
std::string ratio(const Case& c) {
  const double found = largest_stable(c, steps);
  return found <= 0.5 ? "< 0.5" : found > 100.0 ? "> 100" : number("%.2f", found);
}

void print_laws(const char* name, const std::vector<Case>& cases) {
  std::printf("table: %s\n| law | scene | bound [s] | whose | blow-up [s] | blow-up / bound | stopped by an error at | why not sharp |\n",
              name);
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const auto& c : cases) {
    const double found = largest_stable(c, steps);
    const Outcome past = c.run(c.stopped * c.stated, steps);
    std::printf("| %s | %s | %.4g | %s | %.4g | %.2f | %.1f of the bound, step %llu | %s |\n", c.law.c_str(), c.scene.c_str(), c.stated,
                c.bound_by.c_str(), found * c.stated, found, c.stopped, static_cast<unsigned long long>(past.where.step),
                found >= 1.505 ? c.why.c_str() : "");
    std::fflush(stdout);
  }
}

template <class Integrator>
void print_integrator(const char* name) {
  std::printf("| %s |", name);
  for (const auto& c : {sound<Integrator>(), morris<Integrator>(), molteni_colagrossi<Integrator>(), heat<Integrator>("", "", support),
                        springs<Integrator>(), dashpots<Integrator>(), drag<Integrator>()})
    std::printf(" %s |", ratio(c).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

template <class K>
void print_kernel(const char* name) {
  std::printf("| %s, %dD |", name, K::dimension);
  for (const double h : {1.5, 2.0, 2.6, 3.0})
    std::printf(" %s |", ratio(fluid<ExtrapolatedVerlet>("", "", flow<K>(h), {.side = K::dimension == 3 ? 6 : 8})).c_str());
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main() {
  use_threads(1);
  print_laws("fluids", fluids<ExtrapolatedVerlet>());
  print_laws("beads", beads<Leapfrog>());
  auto several = together<ExtrapolatedVerlet>();
  for (const auto& c : liquid_with_springs<ExtrapolatedVerlet>()) several.push_back(c);
  for (auto c : liquid_with_springs<Leapfrog>()) {
    c.scene += ", Leapfrog";
    several.push_back(c);
  }
  print_laws("together", several);
  std::printf("table: integrators\n| integrator | sound | Morris | density diffusion | heat | springs | dashpots | drag |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  print_integrator<ExtrapolatedVerlet>("ExtrapolatedVerlet");
  print_integrator<Leapfrog>("Leapfrog");
  print_integrator<SymplecticEuler>("SymplecticEuler");
  print_integrator<LammpsVerlet>("LammpsVerlet");
  std::printf("table: kernels\n| kernel | h = 1.5 spacings | 2.0 | 2.6 | 3.0 |\n|---|---|---|---|---|\n");
  print_kernel<kernel::Lucy<2>>("Lucy");
  print_kernel<kernel::CubicSpline<2>>("CubicSpline");
  print_kernel<kernel::Quartic<2>>("Quartic");
  print_kernel<kernel::WendlandC2<2>>("WendlandC2");
  print_kernel<kernel::WendlandC4<2>>("WendlandC4");
  print_kernel<kernel::WendlandC2<1>>("WendlandC2");
  print_kernel<kernel::WendlandC2<3>>("WendlandC2");
}
