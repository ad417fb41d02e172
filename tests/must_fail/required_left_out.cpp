// expect: Required<double>
#include <dmp/bond/kelvin_voigt.hpp>

const dmp::bond::KelvinVoigt bond{.stiffness = 10.0};
