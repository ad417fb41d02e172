// expect: dmp: not a Forcing: no `Components<Dim, double> acceleration(const Subject& subject) const` [m/s^2]
#include <dmp/forcing/concept.hpp>
#include <dmp/forcing/constant.hpp>

static_assert(dmp::forcing::explain_forcing<dmp::forcing::Constant<3>, 2>());
